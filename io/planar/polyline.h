// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"

namespace loft::io {

/// Points joined in their order: what becomes a constraint of a triangulation.
struct Polyline {
  std::vector<cdt::Point> points;  ///< one at least; closed ones do not repeat the first
  cdt::Ends ends = cdt::open;
  std::string name = {};  ///< may be shared: the rings of one country; empty where there is none

  friend bool operator==(const Polyline&, const Polyline&) = default;
};

}  // namespace loft::io
