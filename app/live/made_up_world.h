// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "overlay/polygon.h"

namespace loft::app {

struct MadeUpCountry {
  std::string name;
  std::vector<overlay::Ring> parts;
};

/// Countries whose borders fit to the last bit, with a coast and islands; the same each time.
[[nodiscard]] std::vector<MadeUpCountry> made_up_world();

}  // namespace loft::app
