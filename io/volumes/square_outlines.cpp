// SPDX-License-Identifier: MIT
#include "io/volumes/square_outlines.h"

#include <algorithm>
#include <utility>

#include "reconstruct/fair/relax.h"

namespace loft::io {

namespace {

constexpr double margin = 1.0 / 64;  // from the sides of squares and halves

}  // namespace

void SquareOutlines::add(std::uint32_t x, std::uint32_t y, Half half) {
  const std::uint64_t second = half == Half::upper_right || half == Half::upper_left ? 1 : 0;
  const std::uint64_t key = (std::uint64_t{y} << 32U | x) << 1U | second;
  const auto [found, is_new] =
      number_.try_emplace(key, static_cast<std::uint32_t>(net_.points.size()));
  if (is_new) {
    net_.points.push_back({x - 0.5, y - 0.5});
    halves_.push_back(half);
  }
  net_.loop_vertices.push_back(found->second);
}

cdt::Point SquareOutlines::inside(std::uint32_t point, cdt::Point wanted) const {
  const cdt::Point middle = net_.points[point];
  const Half half = halves_[point];
  cdt::Point low{middle.x - 0.5 + margin, middle.y - 0.5 + margin};
  cdt::Point high{middle.x + 0.5 - margin, middle.y + 0.5 - margin};
  if (half == Half::lower_left || half == Half::upper_left) high.x = middle.x - margin;
  if (half == Half::lower_right || half == Half::upper_right) low.x = middle.x + margin;
  if (half == Half::lower_left || half == Half::lower_right) high.y = middle.y - margin;
  if (half == Half::upper_left || half == Half::upper_right) low.y = middle.y + margin;
  return {std::clamp(wanted.x, low.x, high.x), std::clamp(wanted.y, low.y, high.y)};
}

std::vector<cdt::Point> SquareOutlines::fair() const {
  constexpr Smoothing shortest{.rounds = 20, .step = 0.5, .is_even = true};
  constexpr double area_tolerance = 1e-7;
  const Reach reach = [this](std::uint32_t point, cdt::Point wanted) {
    return inside(point, wanted);
  };
  std::vector<double> areas;
  for (std::size_t i = 0; i < net_.loop_count(); ++i)
    areas.push_back(signed_area(net_.loop(i), net_.points));
  std::vector<cdt::Point> places;
  for (std::uint32_t v = 0; v < net_.points.size(); ++v)
    places.push_back(inside(v, net_.points[v]));
  places = relax(net_, std::move(places), areas, reach, shortest);
  restore_areas(net_, areas, reach, area_tolerance, places);
  return places;
}

}  // namespace loft::io
