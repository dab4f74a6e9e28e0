// SPDX-License-Identifier: MIT
#include "fields/raster.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "fields/patch.h"

namespace loft::fields {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The patches of the triangles where it was of late, each at a place that follows from its id: a
/// row goes through many that the row before went through.
class RecentPatches {
 public:
  RecentPatches(const Field& field, Smoothness smoothness, std::size_t columns)
      : field_(field),
        smoothness_(smoothness),
        mask_(std::bit_ceil(std::clamp<std::size_t>(2 * columns, 1, most)) - 1),
        triangles_(mask_ + 1),
        patches_(mask_ + 1) {}

  /// Valid until the next call.
  [[nodiscard]] const Patch& of(TriangleId t) {
    const std::size_t at = t.index() & mask_;
    if (triangles_[at] != t) {
      triangles_[at] = t;
      patches_[at].emplace(field_, t, smoothness_);
    }
    return *patches_[at];
  }

 private:
  static constexpr std::size_t most = 4096;

  const Field& field_;
  Smoothness smoothness_;
  std::size_t mask_;
  std::vector<TriangleId> triangles_;
  std::vector<std::optional<Patch>> patches_;
};

/// Goes from place to place, and keeps the triangle where it is.
class Stroller {
 public:
  Stroller(const Field& field, Smoothness smoothness, std::size_t columns)
      : field_(field), smoothness_(smoothness), patches_(field, smoothness, columns) {}

  [[nodiscard]] double value(Point p) {
    if (patch_ != nullptr) {
      const EdgeId towards = patch_->edge_towards(p);
      if (towards.is_none()) return value_in_triangle(p);
      at_ = field_.mesh().twin(towards);
      if (goes_to(p)) return value_in_triangle(p);
    }
    const cdt::Location place = field_.mesh().locate(p, at_);
    const bool is_inside = place.kind == cdt::Location::Kind::triangle;
    at_ = place.edge;
    patch_ = is_inside ? &patches_.of(Triangulation::triangle(at_)) : nullptr;
    return is_inside ? value_in_triangle(p) : field_.value(p, smoothness_).value_or(nothing);
  }

 private:
  /// Whether a place is inside one of the next few triangles, which at_ and patch_ are then.
  [[nodiscard]] bool goes_to(Point p) {
    const Triangulation& mesh = field_.mesh();
    Point a = mesh.point(mesh.from(at_));
    Point b = mesh.point(mesh.to(at_));
    if (cdt::orient(a, b, p) <= 0) return false;
    constexpr int most_steps = 4;
    for (int step = 0; step < most_steps && mesh.apex(at_) != Triangulation::infinite; ++step) {
      const Point c = mesh.point(mesh.apex(at_));
      const int beside_next = cdt::orient(b, c, p);
      const int beside_previous = cdt::orient(c, a, p);
      if (beside_next > 0 && beside_previous > 0) {
        patch_ = &patches_.of(Triangulation::triangle(at_));
        return true;
      }
      if (beside_next == 0 || beside_previous == 0) return false;
      const bool is_next = beside_next < 0;
      at_ = mesh.twin(is_next ? Triangulation::next(at_) : Triangulation::prev(at_));
      (is_next ? a : b) = c;
    }
    return false;
  }
  [[nodiscard]] double value_in_triangle(Point p) const {
    return patch_->has_values() ? patch_->value(p) : nothing;
  }

  const Field& field_;
  Smoothness smoothness_;
  RecentPatches patches_;
  EdgeId at_;
  const Patch* patch_ = nullptr;
};

}  // namespace

void rasterize(const Field& field, const Grid& grid, Smoothness smoothness,
               const std::function<void(std::size_t row, std::span<const double> values)>& visit) {
  std::vector<double> values(grid.columns);
  Stroller stroller(field, smoothness, grid.columns);
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
