// SPDX-License-Identifier: MIT
#include "tests/reconstruct/exact_area.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

namespace loft::stacks {

namespace {

using Rational = boost::multiprecision::cpp_rational;
using cdt::Point;

/// A side that is not level, from its lower end up.
template <class Number>
struct Side {
  Number x;  // at the lower end
  Number low;
  Number high;
  Number slope;  // x for y
  int turn;      // +1: the contour runs upwards here

  [[nodiscard]] Number at(const Number& y) const { return x + slope * (y - low); }
};

template <class Number>
std::vector<Side<Number>> sides_of(std::span<const Contour> contours) {
  std::vector<Side<Number>> sides;
  for (const Contour& contour : contours) {
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      Point a = contour.points[i];
      Point b = contour.points[(i + 1) % contour.points.size()];
      if (a.y == b.y) continue;
      const int turn = a.y < b.y ? 1 : -1;
      if (turn < 0) std::swap(a, b);
      const Number slope = (Number(b.x) - Number(a.x)) / (Number(b.y) - Number(a.y));
      sides.push_back({Number(a.x), Number(a.y), Number(b.y), slope, turn});
    }
  }
  return sides;
}

/// All heights between which no two sides cross.
template <class Number>
std::vector<Number> levels(const std::vector<Side<Number>>& sides) {
  std::vector<Number> all;
  for (const Side<Number>& side : sides) all.insert(all.end(), {side.low, side.high});
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Number low = std::max(sides[i].low, sides[j].low);
      const Number high = std::min(sides[i].high, sides[j].high);
      if (low >= high || sides[i].slope == sides[j].slope) continue;
      const Number y =
          low + (sides[j].at(low) - sides[i].at(low)) / (sides[i].slope - sides[j].slope);
      if (y > low && y < high) all.push_back(y);
    }
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Of what is inside between two levels.
template <class Number>
Number strip(const std::vector<Side<Number>>& sides, const Number& low, const Number& high,
             Fill fill) {
  const Number middle = (low + high) / 2;
  std::vector<std::pair<Number, int>> crossed;
  for (const Side<Number>& side : sides)
    if (side.low <= low && side.high >= high) crossed.emplace_back(side.at(middle), side.turn);
  std::ranges::sort(crossed);
  Number width = 0;
  int winding = 0;
  int count = 0;
  for (std::size_t i = 0; i + 1 < crossed.size(); ++i) {
    winding += crossed[i].second;
    ++count;
    const bool is_inside = fill == Fill::nonzero ? winding != 0 : count % 2 == 1;
    if (is_inside) width += crossed[i + 1].first - crossed[i].first;
  }
  return width * (high - low);
}

template <class Number>
Number area(std::span<const Contour> contours, Fill fill) {
  const std::vector<Side<Number>> sides = sides_of<Number>(contours);
  const std::vector<Number> at = levels<Number>(sides);
  Number result = 0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) result += strip(sides, at[i], at[i + 1], fill);
  return result;
}

template <class Number>
Number area(const Region& region) {
  Number twice = 0;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point a = region.points[loop[k]];
      const Point b = region.points[loop[(k + 1) % loop.size()]];
      twice += Number(a.x) * Number(b.y) - Number(a.y) * Number(b.x);
    }
  }
  return twice / 2;
}

double squared_extent(std::span<const Contour> contours) {
  double extent = 0;
  for (const Contour& contour : contours)
    for (const Point& p : contour.points) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
  return extent * extent;
}

template <class Number>
double relative_error(const Region& region, std::span<const Contour> contours, Fill fill) {
  const Number off = area<Number>(region) - area<Number>(contours, fill);
  const double scale = squared_extent(contours);
  return scale == 0 ? 0 : std::abs(static_cast<double>(off)) / scale;
}

}  // namespace

double area_error(const Region& region, std::span<const Contour> contours, Fill fill) {
  // An area changes little where sides and levels move by rounding: rationals, which take a
  // hundred times as long, are asked only where there may be something to say.
  const double near = relative_error<long double>(region, contours, fill);
  return near < 1e-14 ? near : relative_error<Rational>(region, contours, fill);
}

}  // namespace loft::stacks
