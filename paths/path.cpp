// SPDX-License-Identifier: MIT
#include "paths/path.h"

#include <array>

namespace loft::paths {

std::string_view name_of(Status status) {
  constexpr std::array<std::string_view, 5> names{"found", "unreachable", "start blocked",
                                                  "goal blocked", "gave up"};
  return names[static_cast<std::size_t>(status)];
}

}  // namespace loft::paths
