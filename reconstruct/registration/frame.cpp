// SPDX-License-Identifier: MIT
#include "reconstruct/registration/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "mesh/vec3.h"

namespace loft {

namespace {

using cdt::Point;

Region moved(const Region& region, std::span<const Point> ways) {
  Region made = region;
  for (std::size_t i = 0; i < ways.size(); ++i)
    made.points[i] = {region.points[i].x + ways[i].x, region.points[i].y + ways[i].y};
  return made;
}

Vec3 middle(const Vec3& a, const Vec3& b) { return along(a, 0.5, minus(b, a)); }

}  // namespace

/// An edge to split, and the tiles on both sides.
struct Frame::Askew {
  double off;
  std::uint32_t a;
  std::uint32_t b;
  std::array<std::size_t, 2> tiles;
};

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

void Frame::put_back(TileSet& tiles) {
  for (InnerVertex& inner : tiles.inner) {
    const Vec3 place = put_back(inner.place);
    frame_places_[place] = inner.place;
    inner.place = place;
  }
}

bool Frame::is_contour(std::uint32_t node) const {
  return node < lower_.points.size() + upper_.points.size();
}

bool Frame::in_one_slice(std::uint32_t a, std::uint32_t b) const {
  return is_contour(a) && is_contour(b) &&
         (a < lower_.points.size()) == (b < lower_.points.size());
}

Vec3 Frame::in_frame(const TileSet& tiles, std::uint32_t node) const {
  if (is_contour(node)) return place_of(lower_moved_, upper_moved_, tiles.inner, node);
  return frame_places_.at(place_of(lower_, upper_, tiles.inner, node));
}

std::vector<Frame::Askew> Frame::find_askew(const TileSet& tiles, double most) const {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> halves;
  std::vector<Askew> found;
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    const auto& nodes = tiles.tiles[t].nodes;
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = nodes[i];
      const std::uint32_t b = nodes[(i + 1) % 3];
      if (in_one_slice(a, b)) continue;
      const auto twin = halves.find({b, a});
      if (twin == halves.end()) {
        halves[{a, b}] = t;
        continue;
      }
      const Vec3 there = put_back(middle(in_frame(tiles, a), in_frame(tiles, b)));
      const Vec3 here = middle(place_of(lower_, upper_, tiles.inner, a),
                               place_of(lower_, upper_, tiles.inner, b));
      const double off = std::hypot(there[0] - here[0], there[1] - here[1]);
      if (off > most) found.push_back({off, a, b, {twin->second, t}});
    }
  }
  std::ranges::stable_sort(found, std::greater(), &Askew::off);
  return found;
}

void Frame::split_askew(TileSet& tiles, double most) {
  const auto first = static_cast<std::uint32_t>(lower_.points.size() + upper_.points.size());
  std::vector<bool> is_split(tiles.tiles.size());
  for (const Askew& edge : find_askew(tiles, most)) {
    if (is_split[edge.tiles[0]] || is_split[edge.tiles[1]]) continue;
    const Vec3 there = middle(in_frame(tiles, edge.a), in_frame(tiles, edge.b));
    const Vec3 here = put_back(there);
    frame_places_[here] = there;
    const auto node = first + static_cast<std::uint32_t>(tiles.inner.size());
    tiles.inner.push_back({here, VertexKind::steiner});
    for (const std::size_t t : edge.tiles) {
      is_split[t] = true;
      Tile rest = tiles.tiles[t];
      std::ranges::replace(tiles.tiles[t].nodes, edge.a, node);
      std::ranges::replace(rest.nodes, edge.b, node);
      tiles.tiles.push_back(rest);
    }
  }
}

}  // namespace loft
