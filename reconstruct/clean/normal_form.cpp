// SPDX-License-Identifier: MIT
#include "reconstruct/clean/normal_form.h"

#include <algorithm>

#include "cdt/predicates.h"

namespace loft {

namespace {

using cdt::Point;

/// How long the part is that a ring repeats all round; its length if there is none.
std::size_t period(std::span<const Point> ring) {
  std::vector<std::size_t> border(ring.size() + 1);  // Knuth, Morris, Pratt 1977
  for (std::size_t i = 1, k = 0; i < ring.size(); ++i) {
    while (k > 0 && ring[i] != ring[k]) k = border[k];
    if (ring[i] == ring[k]) ++k;
    border[i + 1] = k;
  }
  const std::size_t part = ring.size() - border[ring.size()];
  return part != 0 && ring.size() % part == 0 ? part : ring.size();
}

double twice_area(std::span<const Point> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    twice += (a.x - ring[0].x) * (b.y - ring[0].y) - (a.y - ring[0].y) * (b.x - ring[0].x);
  }
  return twice;
}

}  // namespace

NormalForm normal_form(std::span<const Point> points) {
  NormalForm form;
  std::vector<Point> ring;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!ring.empty() && ring.back() == points[i]) continue;
    ring.push_back(points[i]);
    form.numbers.push_back(i);
  }
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  const std::size_t once = period(ring);
  form.laps = once == 0 ? 1 : ring.size() / once;
  ring.resize(once);
  form.numbers.resize(once);
  bool is_forward = true;
  for (const bool forward : {true, false}) {
    std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
    if (form.places.empty() || ring < form.places) {
      form.places = ring;
      is_forward = forward;
    }
    std::ranges::reverse(ring);
  }
  const double twice = twice_area(form.places);
  form.turns_left = twice == 0 ? is_forward : (twice > 0) == is_forward;
  return form;
}

bool are_in_line(std::span<const Point> points) {
  const auto ends = std::ranges::minmax(points);
  return std::ranges::all_of(points,
                             [&](Point p) { return cdt::orient(ends.min, ends.max, p) == 0; });
}

}  // namespace loft
