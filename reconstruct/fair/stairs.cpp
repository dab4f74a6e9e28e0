// SPDX-License-Identifier: MIT
#include "reconstruct/fair/stairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace loft {

namespace {

using cdt::Point;

/// Steps are as long as the shortest edge, but for that share: pixels are placed with rounding.
constexpr double tolerance = 1e-6;

class ContourEdges {
 public:
  explicit ContourEdges(std::span<const Point> points) : points_(points) {}

  [[nodiscard]] bool is_step(std::size_t i, double unit) const {
    const Point before = way(i + points_.size() - 1);
    const Point here = way(i);
    const Point after = way(i + 1);
    const bool is_level = here.y == 0 && before.x == 0 && after.x == 0;
    const bool is_upright = here.x == 0 && before.y == 0 && after.y == 0;
    if (is_level == is_upright || length(i) > (1 + tolerance) * unit) return false;
    return is_level ? before.y * after.y > 0 : before.x * after.x > 0;
  }
  [[nodiscard]] double length(std::size_t i) const { return std::hypot(way(i).x, way(i).y); }

 private:
  [[nodiscard]] Point way(std::size_t i) const {
    const Point from = points_[i % points_.size()];
    const Point to = points_[(i + 1) % points_.size()];
    return {to.x - from.x, to.y - from.y};
  }

  std::span<const Point> points_;
};

}  // namespace

void Stairs::add(const Slice& slice) {
  for (const Contour& contour : slice.contours) {
    const ContourEdges edges(contour.points);
    double unit = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < contour.points.size(); ++i)
      if (edges.length(i) > 0) unit = std::min(unit, edges.length(i));
    for (std::size_t i = 0; i < contour.points.size(); ++i)
      steps_ += edges.is_step(i, unit) ? 1U : 0U;
    edges_ += contour.points.size();
  }
}

}  // namespace loft
