// SPDX-License-Identifier: MIT
#include "reconstruct/clean/near_copies.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "reconstruct/plane/nearest.h"

namespace loft {

namespace {

using cdt::Point;

class NearCopies {
 public:
  NearCopies(std::span<const std::vector<Point>> places, double tolerance)
      : places_(places), tolerance_(tolerance), boxes_(places.size()), outlines_(places.size()) {
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const Point p : places[i]) boxes_[i].add(p);
  }

  std::vector<NearCopy> find() {
    std::vector<std::uint32_t> order(places_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [this](std::uint32_t i) { return boxes_[i].low.x; });
    std::vector<std::uint32_t> kept(places_.size());
    std::iota(kept.begin(), kept.end(), 0);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        if (boxes_[order[j]].low.x - boxes_[order[i]].low.x > tolerance_) break;
        unite(kept, order[i], order[j]);
      }
    std::vector<NearCopy> found;
    for (std::uint32_t i = 0; i < kept.size(); ++i)
      if (kept[i] != i) found.push_back({root(kept, i), i});
    return found;
  }

 private:
  void unite(std::vector<std::uint32_t>& kept, std::uint32_t a, std::uint32_t b) {
    const std::uint32_t one = root(kept, a);
    const std::uint32_t other = root(kept, b);
    if (one == other || !are_alike(a, b)) return;
    const bool is_first = places_[one] < places_[other];
    kept[is_first ? other : one] = is_first ? one : other;
  }

  [[nodiscard]] static std::uint32_t root(std::vector<std::uint32_t>& kept, std::uint32_t i) {
    while (kept[i] != i) i = kept[i] = kept[kept[i]];
    return i;
  }

  [[nodiscard]] bool are_alike(std::uint32_t a, std::uint32_t b) {
    return is_same(boxes_[a].low, boxes_[b].low) && is_same(boxes_[a].high, boxes_[b].high) &&
           is_along(a, b) && is_along(b, a);
  }

  [[nodiscard]] bool is_same(Point p, Point q) const {
    return std::abs(p.x - q.x) <= tolerance_ && std::abs(p.y - q.y) <= tolerance_;
  }

  [[nodiscard]] bool is_along(std::uint32_t ring, std::uint32_t other) {
    const NearestSegment& outline = this->outline(other);
    return std::ranges::all_of(places_[ring],
                               [&](Point p) { return outline.distance(p) <= tolerance_; });
  }

  const NearestSegment& outline(std::uint32_t ring) {
    if (!outlines_[ring]) {
      const auto& points = places_[ring];
      std::vector<Segment> sides;
      for (std::size_t i = 0; i < points.size(); ++i)
        sides.push_back({points[i], points[(i + 1) % points.size()]});
      outlines_[ring].emplace(std::move(sides));
    }
    return *outlines_[ring];
  }

  std::span<const std::vector<Point>> places_;
  double tolerance_;
  std::vector<cdt::Box> boxes_;
  std::vector<std::optional<NearestSegment>> outlines_;
};

}  // namespace

std::vector<NearCopy> find_near_copies(std::span<const std::vector<Point>> places,
                                       double tolerance) {
  return NearCopies(places, tolerance).find();
}

}  // namespace loft
