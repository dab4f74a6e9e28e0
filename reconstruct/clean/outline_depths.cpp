// SPDX-License-Identifier: MIT
#include "reconstruct/clean/outline_depths.h"

#include <algorithm>
#include <functional>
#include <set>
#include <tuple>

#include "cdt/predicates.h"

namespace loft {

namespace {

using cdt::Point;

/// An edge, from its smaller end. Upright ones run upwards: the line that sweeps leans to the left
/// by nearly nothing.
struct Edge {
  Point left;
  Point right;
  std::uint32_t outline;
  bool has_inside_above;
};

/// Whether a is below b, where both are on the sweeping line.
bool is_below(const Edge& a, const Edge& b) {
  if (b.left < a.left) return cdt::orient(b.left, b.right, a.left) < 0;
  const int side = cdt::orient(a.left, a.right, b.left);
  return side != 0 ? side > 0 : cdt::orient(a.left, a.right, b.right) > 0;
}

class Sweep {
 public:
  explicit Sweep(std::span<const SimpleOutline> outlines)
      : outlines_(outlines),
        depths_(outlines.size()),
        is_known_(outlines.size(), false),
        on_line_([this](std::uint32_t a, std::uint32_t b) {
          return a != b && is_below(edges_[a], edges_[b]);
        }) {
    for (std::uint32_t i = 0; i < outlines.size(); ++i) add_edges(i);
  }

  std::vector<OutlineDepth> run() {
    std::ranges::sort(events_);
    places_.resize(edges_.size());
    for (const auto& [at, is_start, edge] : events_) {
      if (!is_start) {
        on_line_.erase(places_[edge]);
        continue;
      }
      places_[edge] = on_line_.insert(edge).first;
      const std::uint32_t outline = edges_[edge].outline;
      if (is_known_[outline]) continue;
      is_known_[outline] = true;
      if (places_[edge] != on_line_.begin()) depths_[outline] = above(*std::prev(places_[edge]));
    }
    return std::move(depths_);
  }

 private:
  void add_edges(std::uint32_t outline) {
    const auto& [points, turns_left] = outlines_[outline];
    Point from = points.back();
    for (const Point to : points) {
      const bool is_forward = from < to;
      const auto number = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({std::min(from, to), std::max(from, to), outline, is_forward == turns_left});
      events_.emplace_back(edges_.back().left, true, number);
      events_.emplace_back(edges_.back().right, false, number);
      from = to;
    }
  }

  /// What encloses the places just above an edge.
  [[nodiscard]] OutlineDepth above(std::uint32_t edge) const {
    const std::uint32_t outline = edges_[edge].outline;
    const auto [depth, winding] = depths_[outline];
    if (!edges_[edge].has_inside_above) return {depth, winding};
    return {depth + 1, winding + (outlines_[outline].turns_left ? 1 : -1)};
  }

  using Line = std::set<std::uint32_t, std::function<bool(std::uint32_t, std::uint32_t)>>;

  std::span<const SimpleOutline> outlines_;
  std::vector<OutlineDepth> depths_;
  std::vector<bool> is_known_;  // of each outline: its depth
  std::vector<Edge> edges_;
  std::vector<std::tuple<Point, bool, std::uint32_t>> events_;  // edges end before others start
  Line on_line_;                                                // from below
  std::vector<Line::iterator> places_;                          // of each edge on the line
};

}  // namespace

std::vector<OutlineDepth> outline_depths(std::span<const SimpleOutline> outlines) {
  return Sweep(outlines).run();
}

}  // namespace loft
