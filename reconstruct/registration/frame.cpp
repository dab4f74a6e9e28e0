// SPDX-License-Identifier: MIT
#include "reconstruct/registration/frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/vec3.h"
#include "reconstruct/plane/nearest.h"
#include "reconstruct/registration/quads.h"
#include "reconstruct/tile/sheet_heights.h"

namespace loft {

using cdt::Point;

Frame::Frame(const Region& lower, const Region& upper, std::span<const Point> lower_ways,
             std::span<const Point> upper_ways)
    : lower_(lower),
      upper_(upper),
      lower_moved_(moved(lower, lower_ways)),
      upper_moved_(moved(upper, upper_ways)),
      lower_ways_(lower_moved_, lower_ways),
      upper_ways_(upper_moved_, upper_ways) {}

double Frame::covered(const TileSet& tiles) const {
  double sum = 0;
  for (const Tile& tile : tiles.tiles) {
    const auto place = [&](unsigned i) {
      return place_of(lower_moved_, upper_moved_, tiles.inner, tile.nodes[i]);
    };
    sum += std::abs(cross(minus(place(1), place(0)), minus(place(2), place(0)))[2]) / 2;
  }
  return sum;
}

Vec3 Frame::put_back(const Vec3& place) const {
  const auto [x, y, z] = place;
  const double share = (z - lower_.z) / (upper_.z - lower_.z);
  const Point u = lower_ways_.at({x, y});
  const Point v = upper_ways_.at({x, y});
  return {x - (1 - share) * u.x - share * v.x, y - (1 - share) * u.y - share * v.y, z};
}

void Frame::put_back(TileSet& tiles) const {
  lift_anew(tiles);
  for (InnerVertex& inner : tiles.inner) inner.place = put_back(inner.place);
  choose_diagonals(tiles);
}

/// Ends, whose heights do not come from the distances to both slices, keep them.
void Frame::lift_anew(TileSet& tiles) const {
  constexpr double rounding = 1e-9;
  const auto is_steiner = [](const InnerVertex& inner) {
    return inner.kind == VertexKind::steiner;
  };
  if (std::ranges::none_of(tiles.inner, is_steiner)) return;
  const NearestSegment lower(boundary(lower_));
  const NearestSegment upper(boundary(upper_));
  const NearestSegment lower_moved(boundary(lower_moved_));
  const NearestSegment upper_moved(boundary(upper_moved_));
  const double height = upper_.z - lower_.z;
  for (InnerVertex& inner : tiles.inner) {
    if (!is_steiner(inner)) continue;
    const Point p{inner.place[0], inner.place[1]};
    const double share = height_share(lower_moved.distance(p), upper_moved.distance(p), height);
    if (!(std::abs(inner.place[2] - (lower_.z + share * height)) <= rounding * height)) continue;
    const Point u = lower_ways_.at(p);
    const Point v = upper_ways_.at(p);
    inner.place[2] =
        lower_.z + height * height_share(lower.distance({p.x - u.x, p.y - u.y}),
                                         upper.distance({p.x - v.x, p.y - v.y}), height);
  }
}

namespace {

void replace(Tile& tile, std::uint32_t node, std::uint32_t other) {
  *std::ranges::find(tile.nodes, node) = other;
}

}  // namespace

bool Frame::are_one(std::uint32_t lower_node, std::uint32_t upper_node, double rounding) const {
  const Point a = lower_moved_.points[lower_node];
  const Point b = upper_moved_.points[upper_node - lower_.points.size()];
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) <= rounding;
}

void Frame::choose_diagonals(TileSet& tiles) const {
  constexpr double rounding = 1e-9;  // relative
  const auto length = [&](std::uint32_t a, std::uint32_t b) {
    return loft::length(
        minus(place_of(lower_, upper_, tiles.inner, a), place_of(lower_, upper_, tiles.inner, b)));
  };
  const auto is_wall = [](const Tile& tile) { return tile.kind == FaceKind::wall; };
  for (const Quad& quad : find_quads(lower_, upper_, tiles, is_wall)) {
    const double now = length(quad.lower, quad.upper);
    if (!(length(quad.lower_apex, quad.upper_apex) < (1 - rounding) * now)) continue;
    if (!are_one(quad.lower_apex, quad.upper, rounding * now) ||
        !are_one(quad.lower, quad.upper_apex, rounding * now))
      continue;
    replace(tiles.tiles[quad.lower_tile], quad.upper, quad.upper_apex);
    replace(tiles.tiles[quad.upper_tile], quad.lower, quad.lower_apex);
  }
}

}  // namespace loft
