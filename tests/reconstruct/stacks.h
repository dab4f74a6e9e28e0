// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "reconstruct/slice.h"

namespace loft::stacks {

inline Contour circle(std::size_t n, double radius, cdt::Point centre = {}, double turn = 0) {
  Contour contour;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle =
        turn + 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    contour.points.push_back(
        {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return contour;
}

inline Contour square(double half, cdt::Point centre = {}) {
  return {{{centre.x - half, centre.y - half},
           {centre.x + half, centre.y - half},
           {centre.x + half, centre.y + half},
           {centre.x - half, centre.y + half}},
          {}};
}

/// A sphere of radius 1 cut at `count` heights, half a gap away from its poles.
inline std::vector<Slice> sphere(std::size_t count, std::size_t points) {
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = -1 + (static_cast<double>(i) + 0.5) * 2 / static_cast<double>(count);
    slices.push_back({z, {circle(points, std::sqrt(1 - z * z))}});
  }
  return slices;
}

/// A torus with its axis along y: one disc that splits in two on the way up, and two that join.
/// Cut at `count` heights; about 4 * `points` points a slice.
class Torus {
 public:
  static constexpr double ring = 2;
  static constexpr double tube = 0.8;
  static constexpr double volume = 2 * std::numbers::pi * std::numbers::pi * ring * tube * tube;

  static std::vector<Slice> slices(std::size_t count, std::size_t points) {
    std::vector<Slice> slices;
    for (std::size_t i = 0; i < count; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      slices.push_back(Torus((ring + tube) * (2 * share - 1), points).slice());
    }
    return slices;
  }

 private:
  Torus(double z, std::size_t points) : z_(z), points_(points) {}

  /// The x > 0 where the outer (sign 1) or inner (-1) side of the tube is cut, at depth y.
  [[nodiscard]] double side(double y, double sign) const {
    const double radius = ring + sign * std::sqrt(std::max(tube * tube - y * y, 0.0));
    return std::sqrt(std::max(radius * radius - z_ * z_, 0.0));
  }

  /// Points of a side of the right or left half, without the last one.
  void add_arc(Contour& contour, double half, double sign, double from, double to) const {
    const double begin = std::asin(from / tube);
    const double end = std::asin(to / tube);
    for (std::size_t k = 0; k < points_; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(points_);
      const double y = tube * std::sin(begin + share * (end - begin));
      contour.points.push_back({half * side(y, sign), y});
    }
  }

  [[nodiscard]] Slice slice() const {
    Slice slice{z_, {}};
    const double height = std::abs(z_);
    const double widest =
        height > ring ? std::sqrt(tube * tube - (height - ring) * (height - ring)) : tube;
    Contour right;
    add_arc(right, 1, 1, -widest, widest);
    if (height >= ring) {  // one oval
      add_arc(right, -1, 1, widest, -widest);
    } else if (height > ring - tube) {  // two that have grown together, with a dent on each side
      const double dent = std::sqrt(tube * tube - (ring - height) * (ring - height));
      add_arc(right, 1, -1, tube, dent);
      add_arc(right, -1, -1, dent, tube);
      add_arc(right, -1, 1, tube, -tube);
      add_arc(right, -1, -1, -tube, -dent);
      add_arc(right, 1, -1, -dent, -tube);
    } else {  // two ovals
      add_arc(right, 1, -1, tube, -tube);
      Contour left = right;
      for (cdt::Point& p : left.points) p.x = -p.x;
      slice.contours.push_back(left);
    }
    slice.contours.push_back(right);
    return slice;
  }

  double z_;
  std::size_t points_;
};

/// One disc below, two above that move apart.
inline std::vector<Slice> y_branch(std::size_t count, std::size_t points) {
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    const double apart = 3 * share - 1;  // of the axes, in radii
    if (apart <= 0) {
      slices.push_back({4 * share, {circle(points, 1)}});
    } else if (apart <= 1) {  // the outline of both discs
      Contour contour;
      const double open = std::acos(apart);
      for (const double half : {1.0, -1.0}) {
        for (std::size_t k = 0; k < points; ++k) {
          const double angle = (open - std::numbers::pi) + 2 * (std::numbers::pi - open) *
                                                               (static_cast<double>(k) + 0.5) /
                                                               static_cast<double>(points);
          contour.points.push_back({half * (apart + std::cos(angle)), half * std::sin(angle)});
        }
      }
      slices.push_back({4 * share, {contour}});
    } else {
      slices.push_back(
          {4 * share, {circle(points, 1, {apart, 0}), circle(points, 1, {-apart, 0})}});
    }
  }
  return slices;
}

/// Contours that cross themselves and one another, on a coarse grid or with arbitrary coordinates.
inline Slice random_slice(double z, std::mt19937_64& random, bool on_grid) {
  Slice slice{z, {}};
  slice.contours.resize(1 + random() % 4);
  for (Contour& contour : slice.contours) {
    contour.points.resize(3 + random() % 6);
    for (cdt::Point& p : contour.points) {
      const auto coordinate = [&] {
        return on_grid ? static_cast<double>(random() % 7)
                       : static_cast<double>(random() % 100000) / 99991.0;
      };
      p.x = coordinate();
      p.y = coordinate();
    }
  }
  return slice;
}

/// The pixels of a random mask as unit squares: corner contacts and shared edges everywhere.
inline Slice random_mask(double z, std::mt19937_64& random, int size, double density) {
  Slice slice{z, {}};
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y)
      if (std::uniform_real_distribution<double>()(random) < density)
        slice.contours.push_back(square(0.5, {x + 0.5, y + 0.5}));
  return slice;
}

}  // namespace loft::stacks
