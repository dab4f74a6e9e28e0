// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "fields/field.h"
#include "overlay/polygon.h"

namespace loft::fields {

/// A line on which the linear surface has one value, what is higher on its left.
struct Isoline {
  double level = 0;
  bool is_closed = false;
  std::vector<Point> points;  ///< each on an edge of the triangulation; of a closed one, each once

  friend bool operator==(const Isoline&, const Isoline&) = default;
};

/// The isolines of some levels: as far as they go on, to themselves, or to the hull, a wall or a
/// barrier, none of which they cross. What is exactly at a level counts as higher. Sorted by level,
/// then by points; closed ones begin at their smallest. Cost: O(triangles log levels + points).
[[nodiscard]] std::vector<Isoline> isolines(const Field& field, std::span<const double> levels);

/// Where the linear surface is at `low` or higher and below `high`.
struct Band {
  double low = 0;
  double high = 0;
  overlay::MultiPolygon polygons;
};

/// The bands between each level and the next. On both sides of a wall each goes to where the
/// surface there leaves it. Infinite levels are fine. Precondition: the levels rise. Cost:
/// O(triangles log levels), and for each band what it costs to put its border in order.
[[nodiscard]] std::vector<Band> bands(const Field& field, std::span<const double> levels);

}  // namespace loft::fields
