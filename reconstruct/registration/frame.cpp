// SPDX-License-Identifier: MIT
#include "reconstruct/registration/frame.h"

#include <cmath>

#include "mesh/vec3.h"

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
  for (InnerVertex& inner : tiles.inner) inner.place = put_back(inner.place);
}

}  // namespace loft
