// SPDX-License-Identifier: MIT
// Random points and separators.
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "cdt/point.h"

namespace loft::fields {

/// Where random points are.
enum class PointGround {
  grid,      ///< integers: much is on one line, or at one place
  plane,     ///< anywhere between -1 and 1
  far_away,  ///< the same, far from the origin
  one_line,  ///< all on one line
};
inline constexpr std::array point_grounds{PointGround::grid, PointGround::plane,
                                          PointGround::far_away, PointGround::one_line};

inline cdt::Point random_place(std::mt19937_64& random, PointGround ground) {
  const auto whole = [&](int most) {
    return static_cast<double>(std::uniform_int_distribution<int>(-most, most)(random));
  };
  const auto any = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  switch (ground) {
    case PointGround::grid:
      return {whole(5), whole(5)};
    case PointGround::plane:
      return {any(), any()};
    case PointGround::far_away:
      return {1e9 + any(), -3e7 + any()};
    case PointGround::one_line:
      break;
  }
  const double x = whole(9);
  return {x, 2 * x + 1};
}

/// A line of two to six points, now and then of up to 60, none of which repeats the one before it.
inline std::vector<cdt::Point> random_separator(std::mt19937_64& random, PointGround ground) {
  const std::size_t count = 2 + random() % (random() % 8 == 0 ? 59 : 5);
  std::vector<cdt::Point> points;
  while (points.size() < count) {
    const cdt::Point p = random_place(random, ground);
    if (points.empty() || p != points.back()) points.push_back(p);
  }
  return points;
}

}  // namespace loft::fields
