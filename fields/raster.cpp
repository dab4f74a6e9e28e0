// SPDX-License-Identifier: MIT
#include "fields/raster.h"

#include <limits>
#include <optional>
#include <vector>

#include "fields/patch.h"

namespace loft::fields {

namespace {

/// Goes from place to place, and keeps the triangle where it is.
class Stroller {
 public:
  Stroller(const Field& field, Smoothness smoothness) : field_(field), smoothness_(smoothness) {}

  [[nodiscard]] double value(Point p) {
    const cdt::Location place = field_.mesh().locate(p, at_);
    at_ = place.edge;
    if (place.kind != cdt::Location::Kind::triangle)
      return field_.value(p, smoothness_).value_or(std::numeric_limits<double>::quiet_NaN());
    if (const TriangleId t = Triangulation::triangle(place.edge); t != triangle_) {
      triangle_ = t;
      patch_.emplace(field_, t, smoothness_);
    }
    return patch_->has_values() ? patch_->value(p) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  const Field& field_;
  Smoothness smoothness_;
  EdgeId at_;
  TriangleId triangle_;
  std::optional<Patch> patch_;
};

}  // namespace

void rasterize(const Field& field, const Grid& grid, Smoothness smoothness,
               const std::function<void(std::size_t row, std::span<const double> values)>& visit) {
  std::vector<double> values(grid.columns);
  Stroller stroller(field, smoothness);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    // To and fro, so that the next row begins nearby.
    const bool is_back = row % 2 != 0;
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const std::size_t column = is_back ? grid.columns - 1 - i : i;
      values[column] = stroller.value(grid.place(row, column));
    }
    visit(row, values);
  }
}

}  // namespace loft::fields
