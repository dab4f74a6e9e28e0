// SPDX-License-Identifier: MIT
#include "io/contours/take_away.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "reconstruct/clean/cleaning.h"

namespace loft::io {

namespace {

using Rings = std::vector<std::vector<cdt::Point>>;

/// A ring that begins with its least point.
std::vector<cdt::Point> turned(std::vector<cdt::Point> ring) {
  const auto is_before = [](const cdt::Point& a, const cdt::Point& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  };
  std::rotate(ring.begin(), std::ranges::min_element(ring, is_before), ring.end());
  return ring;
}

/// Appends rings, but takes those away that are there: cleaning would keep one of the two.
void append_odd(Rings& rings, const Rings& more) {
  for (auto& ring : rings) ring = turned(std::move(ring));
  for (const auto& one : more) {
    auto ring = turned(one);
    const auto found = std::ranges::find(rings, ring);
    if (found == rings.end()) {
      rings.push_back(std::move(ring));
    } else {
      rings.erase(found);
    }
  }
}

Rings cleaned(const Rings& rings, double z, Fill rule) {
  std::vector<ContourSource> sources;
  for (std::uint32_t i = 0; i < rings.size(); ++i) sources.push_back({rings[i], 0, i});
  std::vector<Defect> repairs;
  const Region region = clean(sources, z, {rule, {}, 0}, repairs);
  Rings result(region.loop_count());
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const std::uint32_t v : region.loop(i)) result[i].push_back(region.points[v]);
  return result;
}

}  // namespace

Rings take_away(const std::vector<Contour>& from, const std::vector<Contour>& away, double z) {
  const auto append = [](Rings& rings, const std::vector<Contour>& contours) {
    for (const Contour& contour : contours) rings.push_back(contour.points);
  };
  // A without B is (A or B) but not B, and B is in (A or B): by even-odd filling of the two.
  Rings both;
  append(both, from);
  append(both, away);
  both = cleaned(both, z, Fill::nonzero);
  Rings negative;
  append(negative, away);
  append_odd(both, cleaned(negative, z, Fill::nonzero));
  return cleaned(both, z, Fill::even_odd);
}

}  // namespace loft::io
