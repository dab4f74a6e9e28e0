// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "cdt/predicates.h"
#include "fields/field.h"

namespace loft::fields {

/// The surface over one triangle: flat, or Clough and Tocher's (1965): three cubic polynomials that
/// meet at its middle, with what changes across an edge linear along it. Where features meet at an
/// angle, the gradients on their sides could only be the same if the surface had no crease; so each
/// side keeps its own, and a rational term makes the values on the feature equal on both.
class Patch {
 public:
  /// Precondition: the triangle is finite.
  Patch(const Field& field, TriangleId t, Smoothness smoothness);

  /// Whether all corners have a value.
  [[nodiscard]] bool has_values() const { return has_values_; }
  /// An edge that a place is on or beyond; none if it is inside the triangle. Exact.
  [[nodiscard]] EdgeId edge_towards(Point p) const {
    if (cdt::orient(corners_[0], corners_[1], p) <= 0) return first_;
    if (cdt::orient(corners_[1], corners_[2], p) <= 0) return Triangulation::next(first_);
    if (cdt::orient(corners_[2], corners_[0], p) <= 0) return Triangulation::prev(first_);
    return {};
  }
  /// At a place in the triangle, or so near that rounding may have put it outside.
  [[nodiscard]] double value(Point p) const;
  [[nodiscard]] Vector gradient(Point p) const;

 private:
  using Weights = std::array<double, 3>;  // of the corners: barycentric coordinates
  using Gradients = std::array<Vector, 3>;

  /// A term along a crease from one corner to another, of which the third is opposite.
  struct Bump {
    double height;  // at the first corner, as a slope
    unsigned first;
    unsigned second;
  };
  /// A cubic polynomial over a third of the triangle, as Bézier has it: i and j are its corners,
  /// m the triangle's middle.
  struct Third {
    double iii, iij, ijj, jjj, iim, ijm, jjm, imm, jmm, mmm;
  };

  [[nodiscard]] Weights weights(Point p) const;
  void bend(const Field& field);
  void add_bumps(const Field& field, EdgeId e, unsigned corner, const Gradients& gradients);
  [[nodiscard]] double bent_value(const Weights& w) const;
  /// By weights.
  [[nodiscard]] std::array<double, 3> bent_slopes(const Weights& w) const;
  [[nodiscard]] Vector gradient_of(const std::array<double, 3>& slopes) const;

  std::array<Point, 3> corners_{};  // counter-clockwise, from the smallest
  std::array<double, 3> values_{};
  double inverse_area_ = 0;  // 1 over twice that of the triangle
  EdgeId first_;             // from the smallest corner
  bool has_values_ = true;
  bool is_bent_ = false;
  std::array<Third, 3> thirds_;  // beside the edge from a corner to the next
  std::array<Bump, 6> bumps_;
  unsigned bump_count_ = 0;
};

}  // namespace loft::fields
