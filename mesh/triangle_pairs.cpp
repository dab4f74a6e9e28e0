// SPDX-License-Identifier: MIT
#include "mesh/triangle_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/vec3.h"

namespace loft {

namespace {

using Vertices = TrianglePairs::Vertices;

/// A vertex of more triangles than that has a fan; below, boxes are as good.
constexpr std::uint32_t least_fan = 24;

Vec3 middle(const Box3& box) {
  return {box.low[0] + box.high[0], box.low[1] + box.high[1], box.low[2] + box.high[2]};
}

/// The box around the arc that a triangle shows to one of its corners, on the unit sphere.
/// Triangles with that corner meet elsewhere only where their arcs do: all that they have in common
/// is joined to the corner by segments in both. An arc is no further from its chord than a quarter
/// of the chord's square.
Box3 arc_of(const Corners& t, std::size_t corner) {
  constexpr double rounding = 0x1p-46;
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
  const double bulge = squared_length(minus(ends[0], ends[1])) / 4 + rounding;
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
          std::span<const Vertices> vertices, std::size_t vertex_count)
      : pairs_(pairs), triangles_(triangles), vertices_(vertices) {
    lies_.reserve(triangles.size());
    for (const Corners& t : triangles) lies_.push_back(lie_of(t));
    std::vector<Unit> units = units_of(find_hubs(vertex_count));
    pairs_.items_.reserve(triangles.size());
    pairs_.nodes_.reserve(triangles.size());
    if (!units.empty()) build(units);
  }

 private:
  /// One triangle, or a fan, of which all have one place in the order.
  struct Unit {
    std::vector<std::uint32_t> triangles;
    Vec3 middle;
    std::uint32_t hub = none;
  };

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
    return box_around(a, b, c);
  }

  [[nodiscard]] Unit unit_of(std::vector<std::uint32_t> triangles, std::uint32_t hub) const {
    Box3 all = box(triangles.front());
    for (const std::uint32_t t : triangles) all = joined(all, box(t));
    return {std::move(triangles), middle(all), hub};
  }

  [[nodiscard]] std::vector<Unit> units_of(std::span<const std::uint32_t> hubs) const {
    std::vector<std::uint32_t> in_fans;
    std::vector<Unit> units;
    for (std::uint32_t t = 0; t < hubs.size(); ++t) {
      if (hubs[t] == none)
        units.push_back(unit_of({t}, none));
      else
        in_fans.push_back(t);
    }
    std::ranges::stable_sort(in_fans, {}, [&](std::uint32_t t) { return hubs[t]; });
    for (auto first = in_fans.begin(); first != in_fans.end();) {
      const std::uint32_t hub = hubs[*first];
      const auto last =
          std::find_if(first, in_fans.end(), [&](std::uint32_t t) { return hubs[t] != hub; });
      units.push_back(unit_of({first, last}, hub));
      first = last;
    }
    return units;
  }

  /// The place of the node that holds them.
  std::uint32_t build(std::span<Unit> units) {
    if (units.size() == 1 && units[0].triangles.size() > 1) return build_fan(units[0]);
    const auto node = static_cast<std::uint32_t>(pairs_.nodes_.size());
    pairs_.nodes_.push_back({.box = box_of(units), .first = item_count()});
    const bool is_leaf = units.size() <= leaf_size && std::ranges::all_of(units, [](const Unit& u) {
                           return u.triangles.size() == 1;
                         });
    if (is_leaf) {
      for (const Unit& unit : units)
        pairs_.items_.push_back({box(unit.triangles[0]), unit.triangles[0]});
    } else {
      const std::size_t half = halve(units);
      build(units.first(half));
      pairs_.nodes_[node].second = build(units.subspan(half));
    }
    pairs_.nodes_[node].last = item_count();
    return node;
  }

  /// Over the triangles of one fan, and its arcs.
  std::uint32_t build_fan(const Unit& fan) {
    std::vector<Unit> units;
    for (const std::uint32_t t : fan.triangles) units.push_back(unit_of({t}, none));
    const std::uint32_t node = build(units);
    const std::uint32_t first = pairs_.nodes_[node].first;
    std::vector<Box3> arcs;
    for (std::uint32_t i = first; i < item_count(); ++i) {
      const std::uint32_t t = pairs_.items_[i].index;
      const auto corner = std::ranges::find(vertices_[t], fan.hub) - vertices_[t].begin();
      arcs.push_back(arc_of(triangles_[t], static_cast<std::size_t>(corner)));
    }
    pairs_.nodes_[node].fan = static_cast<std::uint32_t>(pairs_.fans_.size());
    pairs_.fans_.push_back({BoxTree(arcs), first});
    return node;
  }

  [[nodiscard]] std::uint32_t item_count() const {
    return static_cast<std::uint32_t>(pairs_.items_.size());
  }

  [[nodiscard]] OrientedBox box_of(std::span<const Unit> units) const {
    Lie lie;
    for (const Unit& unit : units)
      for (const std::uint32_t t : unit.triangles) add_lie(lie, lies_[t]);
    OrientedBox box(lie);
    for (const Unit& unit : units)
      for (const std::uint32_t t : unit.triangles)
        for (const Vec3& p : triangles_[t]) box.add(p);
    return box;
  }

  /// Puts the units of one half of the space first; how many they are.
  static std::size_t halve(std::span<Unit> units) {
    Box3 middles{units[0].middle, units[0].middle};
    for (const Unit& unit : units) middles = joined(middles, {unit.middle, unit.middle});
    const std::size_t axis = longest_axis(middles);
    const std::size_t half = units.size() / 2;
    std::ranges::nth_element(
        units, units.begin() + static_cast<std::ptrdiff_t>(half), {},
        [axis](const Unit& unit) { return std::pair(unit.middle[axis], unit.triangles[0]); });
    return half;
  }

  TrianglePairs& pairs_;
  std::span<const Corners> triangles_;
  std::span<const Vertices> vertices_;
  std::vector<Lie> lies_;
};

TrianglePairs::TrianglePairs(std::span<const Corners> triangles, std::span<const Vertices> vertices,
                             std::size_t vertex_count) {
  Builder(*this, triangles, vertices, vertex_count);
}

}  // namespace loft
