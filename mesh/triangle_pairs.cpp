// SPDX-License-Identifier: MIT
#include "mesh/triangle_pairs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "mesh/spread.h"
#include "mesh/vec3.h"

namespace loft {

namespace {

using Vertices = TrianglePairs::Vertices;

/// A vertex of more triangles than that has a fan; below, boxes are as good.
constexpr std::uint32_t least_fan = 24;

Box3 grown(const Box3& box, double reach) {
  const Vec3 way{reach, reach, reach};
  return {minus(box.low, way), along(box.high, 1, way)};
}

/// The box around the arc that a triangle shows to one of its corners, on the unit sphere.
/// Triangles with that corner meet elsewhere only where their arcs do: all that they have in common
/// is joined to the corner by segments in both. An arc is no further from its chord than a quarter
/// of the chord's square.
Box3 arc_of(const Corners& t, std::size_t corner) {
  constexpr double rounding_of_ends = 0x1p-46;
  std::array<Vec3, 2> ends;
  for (std::size_t i = 0; i < 2; ++i) {
    Vec3 way = minus(t[(corner + 1 + i) % 3], t[corner]);
    const double scale = std::max({std::abs(way[0]), std::abs(way[1]), std::abs(way[2])});
    if (!(scale > 0)) return {{-2, -2, -2}, {2, 2, 2}};
    for (double& x : way) x /= scale;
    const double size = length(way);
    for (double& x : way) x /= size;
    ends[i] = way;
  }
  const double bulge = squared_length(minus(ends[0], ends[1])) / 4 + rounding_of_ends;
  Box3 box = joined({ends[0], ends[0]}, {ends[1], ends[1]});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] -= bulge;
    box.high[axis] += bulge;
  }
  return box;
}

}  // namespace

class TrianglePairs::Builder {
 public:
  Builder(TrianglePairs& pairs, std::span<const Corners> triangles,
          std::span<const Vertices> vertices, std::size_t vertex_count, double reach)
      : pairs_(pairs), all_(triangles), triangles_(triangles), vertices_(vertices), reach_(reach) {
    lies_.reserve(triangles.size());
    for (const Corners& t : triangles) lies_.push_back(lie_of(t));
    std::vector<Unit> units = units_of(find_hubs(vertex_count));
    pairs_.items_.reserve(triangles.size());
    pairs_.nodes_.reserve(triangles.size());
    if (!units.empty()) build(units);
  }

 private:
  /// One triangle, or a fan, of which all have one place in the tree.
  struct Unit {
    std::uint32_t first;  // of order_
    std::uint32_t last;
    std::uint32_t rank;  // before all with a larger one, of those that are alike
    std::uint32_t hub = none;
    double middle = 0;  // twice, along the axis at hand

    [[nodiscard]] std::uint32_t size() const { return last - first; }
  };

  /// So many units are brought together in memory: they fit into what is next to a processor.
  static constexpr std::size_t most_together = 8192;

  /// For some units of a whole, with copies of their triangles side by side.
  Builder(const Builder& whole, std::span<Unit> units)
      : pairs_(whole.pairs_), all_(whole.all_), vertices_(whole.vertices_), reach_(whole.reach_) {
    for (Unit& unit : units) {
      const auto first = static_cast<std::uint32_t>(order_.size());
      for (const std::uint32_t t : whole.triangles_of(unit)) {
        order_.push_back(static_cast<std::uint32_t>(order_.size()));
        numbers_.push_back(whole.number(t));
        copies_.push_back(whole.triangles_[t]);
        lies_.push_back(whole.lies_[t]);
      }
      unit.first = first;
      unit.last = static_cast<std::uint32_t>(order_.size());
    }
    triangles_ = copies_;
  }

  /// Whether most of what is here is of other units, and so far apart.
  [[nodiscard]] bool are_scattered(std::span<const Unit> units) const {
    if (units.size() > most_together || order_.size() <= 2 * most_together) return false;
    std::size_t count = 0;
    for (const Unit& unit : units) count += unit.size();
    return 2 * count < order_.size();
  }

  [[nodiscard]] std::uint32_t number(std::uint32_t triangle) const {
    return numbers_.empty() ? triangle : numbers_[triangle];
  }

  /// Each triangle at a vertex of many is in the fan of that, of several of the largest.
  [[nodiscard]] std::vector<std::uint32_t> find_hubs(std::size_t vertex_count) const {
    std::vector<std::uint32_t> degree(vertex_count);
    for (const Vertices& v : vertices_)
      for (const std::uint32_t vertex : v) ++degree[vertex];
    std::vector<std::uint32_t> hubs;
    for (const Vertices& v : vertices_) {
      const std::uint32_t hub =
          *std::ranges::max_element(v, {}, [&](auto vertex) { return degree[vertex]; });
      hubs.push_back(degree[hub] > least_fan ? hub : none);
    }
    return hubs;
  }

  [[nodiscard]] Box3 box(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles_[triangle];
    return grown(box_around(a, b, c), reach_);
  }

  [[nodiscard]] std::span<const std::uint32_t> triangles_of(const Unit& unit) const {
    return std::span(order_).subspan(unit.first, unit.size());
  }

  /// Puts the triangles in order: first those that are alone, then fan by fan.
  [[nodiscard]] std::vector<Unit> units_of(std::span<const std::uint32_t> hubs) {
    for (std::uint32_t t = 0; t < hubs.size(); ++t)
      if (hubs[t] == none) order_.push_back(t);
    const auto alone = static_cast<std::uint32_t>(order_.size());
    for (std::uint32_t t = 0; t < hubs.size(); ++t)
      if (hubs[t] != none) order_.push_back(t);
    std::stable_sort(order_.begin() + alone, order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return hubs[a] < hubs[b]; });
    std::vector<Unit> units;
    units.reserve(alone);
    for (std::uint32_t i = 0; i < alone; ++i) units.push_back({i, i + 1, i});
    for (std::uint32_t first = alone; first < order_.size();) {
      const std::uint32_t hub = hubs[order_[first]];
      std::uint32_t last = first;
      while (last < order_.size() && hubs[order_[last]] == hub) ++last;
      units.push_back({first, last, first, hub});
      first = last;
    }
    return units;
  }

  /// The place of the node that holds them.
  std::uint32_t build(std::span<Unit> units) {
    if (are_scattered(units)) return Builder(*this, units).build(units);
    if (units.size() == 1 && units[0].size() > 1) return build_fan(units[0]);
    const auto node = static_cast<std::uint32_t>(pairs_.nodes_.size());
    pairs_.nodes_.push_back({.first = item_count()});
    surround(node, units);
    const bool is_leaf = units.size() <= leaf_size &&
                         std::ranges::all_of(units, [](const Unit& u) { return u.size() == 1; });
    if (is_leaf) {
      for (const Unit& unit : units)
        pairs_.items_.push_back({box(order_[unit.first]), number(order_[unit.first])});
    } else {
      const std::size_t half = halve(node, units);
      build(units.first(half));
      pairs_.nodes_[node].second = build(units.subspan(half));
    }
    pairs_.nodes_[node].last = item_count();
    return node;
  }

  /// Over the triangles of one fan, and its arcs.
  std::uint32_t build_fan(const Unit& fan) {
    std::vector<Unit> units;
    for (std::uint32_t i = fan.first; i < fan.last; ++i) units.push_back({i, i + 1, i});
    const std::uint32_t hub = fan.hub;
    const std::uint32_t node = build(units);
    const std::uint32_t first = pairs_.nodes_[node].first;
    pairs_.nodes_[node].fan = static_cast<std::uint32_t>(pairs_.fans_.size());
    const auto items = std::span<const Item>(pairs_.items_).subspan(first);
    pairs_.fans_.push_back({arcs_of(items, hub, all_, vertices_), first, hub});
    return node;
  }

  [[nodiscard]] std::uint32_t item_count() const {
    return static_cast<std::uint32_t>(pairs_.items_.size());
  }

  /// Makes the boxes of a node.
  void surround(std::uint32_t node, std::span<const Unit> units) {
    Box3 all = no_box;
    Lie lie;
    std::size_t count = 0;
    for (const Unit& unit : units) {
      count += unit.size();
      for (const std::uint32_t t : triangles_of(unit)) {
        all = joined(all, box(t));
        if (lies_[t].length > 0) add_lie(lie, lies_[t]);
      }
    }
    pairs_.nodes_[node].box = all;
    lie = lie_of_most(lie, count, all);
    if (lie.length == 0) return;
    TurnedBox turned(lie);
    for (const Unit& unit : units)
      for (const std::uint32_t t : triangles_of(unit))
        for (const Vec3& p : triangles_[t]) turned.add(p);
    turned.grow(reach_);
    pairs_.nodes_[node].turned = static_cast<std::uint32_t>(pairs_.turned_.size());
    pairs_.turned_.push_back(turned);
  }

  /// Puts the units of one half of the space first; how many they are.
  std::size_t halve(std::uint32_t node, std::span<Unit> units) const {
    const std::size_t half = units.size() / 2;
    for (const Vec3& axis : best_axes(node, units)) {
      for (Unit& unit : units) unit.middle = extent(unit, axis).twice_middle();
      std::ranges::nth_element(units, units.begin() + static_cast<std::ptrdiff_t>(half), {},
                               [](const Unit& unit) { return std::pair(unit.middle, unit.rank); });
      if (!are_most_alike(units, units[half].middle, std::mem_fn(&Unit::middle))) break;
    }
    return half;
  }

  /// The best first.
  [[nodiscard]] std::array<Vec3, 3> best_axes(std::uint32_t node,
                                              std::span<const Unit> units) const {
    const std::uint32_t turned = pairs_.nodes_[node].turned;
    const auto& axes = turned == none ? frame_of_axes : pairs_.turned_[turned].axes();
    Spread spread(axes);
    for (const Unit& unit : units)
      spread.add({extent(unit, axes[0]), extent(unit, axes[1]), extent(unit, axes[2])});
    return turned == none ? spread.by_spread() : spread.by_spread_in_widths();
  }

  [[nodiscard]] Extent extent(const Unit& unit, const Vec3& axis) const {
    Extent whole = loft::extent(triangles_[order_[unit.first]], axis);
    for (const std::uint32_t t : triangles_of(unit).subspan(1)) {
      const auto [low, high] = loft::extent(triangles_[t], axis);
      whole = {std::min(whole.low, low), std::max(whole.high, high)};
    }
    return whole;
  }

  TrianglePairs& pairs_;
  std::span<const Corners> all_;
  std::span<const Corners> triangles_;  // those here
  std::span<const Vertices> vertices_;  // of all
  double reach_;
  std::vector<Lie> lies_;               // of those here
  std::vector<std::uint32_t> order_;    // of those here, by units
  std::vector<std::uint32_t> numbers_;  // of each that is here, among all; empty: all are
  std::vector<Corners> copies_;
};

TrianglePairs::TrianglePairs(std::span<const Corners> triangles, std::span<const Vertices> vertices,
                             std::size_t vertex_count, double reach) {
  Builder(*this, triangles, vertices, vertex_count, reach);
}

BoxTree TrianglePairs::arcs_of(std::span<const Item> items, std::uint32_t hub,
                               std::span<const Corners> triangles,
                               std::span<const Vertices> vertices) {
  std::vector<Box3> arcs;
  for (const Item& item : items) {
    const Vertices& own = vertices[item.index];
    const auto corner = std::ranges::find(own, hub) - own.begin();
    arcs.push_back(arc_of(triangles[item.index], static_cast<std::size_t>(corner)));
  }
  return BoxTree(arcs);
}

void TrianglePairs::update(std::span<const std::uint32_t> changed,
                           std::span<const Corners> triangles, std::span<const Vertices> vertices) {
  ++round_;
  if (places_.empty()) {
    places_.resize(items_.size());
    for (std::uint32_t i = 0; i < items_.size(); ++i) places_[items_[i].index] = i;
  }
  std::vector<std::uint32_t> places;
  for (const std::uint32_t t : changed) places.push_back(places_[t]);
  std::ranges::sort(places);
  if (!nodes_.empty()) refresh(0, places, triangles, vertices);
}

void TrianglePairs::refresh(std::uint32_t node, std::span<const std::uint32_t> places,
                            std::span<const Corners> triangles,
                            std::span<const Vertices> vertices) {
  if (places.empty()) return;
  Node& n = nodes_[node];
  n.round = round_;
  if (n.turned != none) refresh_turned(n, places, triangles);
  if (n.second == 0) {
    for (const std::uint32_t place : places) {
      const auto& [a, b, c] = triangles[items_[place].index];
      items_[place].box = box_around(a, b, c);
      items_[place].round = round_;
    }
    n.box = no_box;
    for (std::uint32_t i = n.first; i < n.last; ++i) n.box = joined(n.box, items_[i].box);
    return;
  }
  const auto half = std::ranges::lower_bound(places, nodes_[n.second].first) - places.begin();
  refresh(node + 1, places.first(static_cast<std::size_t>(half)), triangles, vertices);
  refresh(n.second, places.subspan(static_cast<std::size_t>(half)), triangles, vertices);
  n.box = joined(nodes_[node + 1].box, nodes_[n.second].box);
  if (n.fan == none) return;
  Fan& fan = fans_[n.fan];
  const auto items = std::span<const Item>(items_).subspan(n.first, n.last - n.first);
  fan.arcs = arcs_of(items, fan.hub, triangles, vertices);
}

/// A small one is made anew: what has moved is far from where it was, in widths of what is long and
/// thin, and as wide a box meets all that is near.
void TrianglePairs::refresh_turned(const Node& node, std::span<const std::uint32_t> places,
                                   std::span<const Corners> triangles) {
  constexpr std::uint32_t small = 256;
  TurnedBox& turned = turned_[node.turned];
  const auto add = [&](std::uint32_t place) {
    for (const Vec3& p : triangles[items_[place].index]) turned.add(p);
  };
  if (node.last - node.first > small) {
    std::ranges::for_each(places, add);
    return;
  }
  turned.clear();
  for (std::uint32_t i = node.first; i < node.last; ++i) add(i);
}

bool TrianglePairs::are_apart(const Node& a, const Node& b) const {
  if (a.turned == none && b.turned == none) return false;
  if (a.turned == none) return turned_[b.turned].is_apart(b.box, a.box);
  if (b.turned == none) return turned_[a.turned].is_apart(a.box, b.box);
  const TurnedBox& turned_a = turned_[a.turned];
  const TurnedBox& turned_b = turned_[b.turned];
  return turned_a.is_apart(a.box, turned_b, b.box) || turned_b.is_apart(b.box, turned_a, a.box) ||
         turned_a.passes(a.box, turned_b, b.box) || turned_a.is_apart(a.box, b.box) ||
         turned_b.is_apart(b.box, a.box);
}

}  // namespace loft
