// SPDX-License-Identifier: MIT
#include "reconstruct/clean/near_copies.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "reconstruct/plane/nearest.h"

namespace loft {

namespace {

using cdt::Point;
using Outline = std::span<const Point>;

class NearCopies {
 public:
  NearCopies(std::span<const Outline> rings, double tolerance)
      : rings_(rings), tolerance_(tolerance), extents_(rings.size()), outlines_(rings.size()) {
    for (std::size_t i = 0; i < rings.size(); ++i) {
      cdt::Box box;
      for (const Point p : rings[i]) box.add(p);
      extents_[i] = {box.low.x, box.low.y, box.high.x, box.high.y};
    }
  }

  std::vector<NearCopy> find() {
    std::vector<std::uint32_t> all(rings_.size());
    std::iota(all.begin(), all.end(), 0);
    kept_ = all;
    compare(all, 0);
    std::vector<NearCopy> found;
    for (std::uint32_t i = 0; i < kept_.size(); ++i)
      if (kept_[i] != i) found.push_back({root(i), i});
    return found;
  }

 private:
  /// Only rings whose boxes are the same within the tolerance are looked at: they are divided by
  /// one side of their boxes after the other.
  void compare(std::span<std::uint32_t> some, std::size_t side) {
    if (some.size() < 2) return;
    if (side == extents_[0].size()) {
      for (std::size_t i = 0; i < some.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) unite(some[j], some[i]);
      return;
    }
    const auto at = [&](std::uint32_t ring) { return extents_[ring][side]; };
    std::ranges::sort(some, {}, at);
    for (std::size_t i = 0, j = 1; i < some.size(); i = j++) {
      while (j < some.size() && at(some[j]) - at(some[j - 1]) <= tolerance_) ++j;
      compare(some.subspan(i, j - i), side + 1);
    }
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t one = root(a);
    const std::uint32_t other = root(b);
    if (one == other || !is_along(a, b) || !is_along(b, a)) return;
    const bool is_first = std::ranges::lexicographical_compare(rings_[one], rings_[other]);
    kept_[is_first ? other : one] = is_first ? one : other;
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t i) {
    while (kept_[i] != i) i = kept_[i] = kept_[kept_[i]];
    return i;
  }

  [[nodiscard]] bool is_along(std::uint32_t ring, std::uint32_t other) {
    const NearestSegment& outline = this->outline(other);
    return std::ranges::all_of(rings_[ring],
                               [&](Point p) { return outline.distance(p) <= tolerance_; });
  }

  const NearestSegment& outline(std::uint32_t ring) {
    if (!outlines_[ring]) {
      const Outline points = rings_[ring];
      std::vector<Segment> sides;
      for (std::size_t i = 0; i < points.size(); ++i)
        sides.push_back({points[i], points[(i + 1) % points.size()]});
      outlines_[ring].emplace(std::move(sides));
    }
    return *outlines_[ring];
  }

  std::span<const Outline> rings_;
  double tolerance_;
  std::vector<std::array<double, 4>> extents_;  // the sides of each ring's box
  std::vector<std::optional<NearestSegment>> outlines_;
  std::vector<std::uint32_t> kept_;  // for each ring one that it is the same as
};

}  // namespace

std::vector<NearCopy> find_near_copies(std::span<const Outline> rings, double tolerance) {
  if (rings.size() < 2) return {};
  return NearCopies(rings, tolerance).find();
}

}  // namespace loft
