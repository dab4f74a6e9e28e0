// SPDX-License-Identifier: MIT
#include "reconstruct/link/pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesh/adjacency.h"

namespace loft {

namespace {

using cdt::Point;

/// Of the second moments of area the larger one is larger than the other by that factor in what is
/// long: an ellipse that is longer than wide by a tenth.
constexpr double least_long = 1.2;

/// Area, first and second moments of what a loop encloses, signed, about an origin.
struct Moments {
  double area = 0;
  Point first;
  double xx = 0;
  double xy = 0;
  double yy = 0;

  void operator+=(const Moments& other) {
    area += other.area;
    first = {first.x + other.first.x, first.y + other.first.y};
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
  }
};

/// Where the loop's smallest point is: sums begin there, so that they do not depend on where the
/// input's contour does.
std::size_t start(const Region& region, std::span<const std::uint32_t> loop) {
  const auto least =
      std::ranges::min_element(loop, {}, [&](std::uint32_t v) { return region.points[v]; });
  return static_cast<std::size_t>(least - loop.begin());
}

Moments moments(const Region& region, std::span<const std::uint32_t> loop, std::size_t start,
                Point origin) {
  const auto at = [&](std::size_t i) {
    const Point p = region.points[loop[i < loop.size() ? i : i - loop.size()]];
    return Point{p.x - origin.x, p.y - origin.y};
  };
  Moments sum;
  Point p = at(start);
  for (std::size_t i = start + 1; i <= start + loop.size(); ++i) {
    const Point q = at(i);
    const double area = (p.x * q.y - p.y * q.x) / 2;
    sum += {area,
            {area * (p.x + q.x) / 3, area * (p.y + q.y) / 3},
            area * (p.x * p.x + p.x * q.x + q.x * q.x) / 6,
            area * (2 * (p.x * p.y + q.x * q.y) + p.x * q.y + q.x * p.y) / 12,
            area * (p.y * p.y + p.y * q.y + q.y * q.y) / 6};
    p = q;
  }
  return sum;
}

/// The unit vector across what is long, at right angles to the axis along which its area is spread
/// most; 0 of what is about as wide as it is long. `centroid`: from the origin of the moments.
Point across(const Moments& sum, Point centroid) {
  const double xx = sum.xx / sum.area - centroid.x * centroid.x;
  const double xy = sum.xy / sum.area - centroid.x * centroid.y;
  const double yy = sum.yy / sum.area - centroid.y * centroid.y;
  const double mean = (xx + yy) / 2;
  const double deviation = std::hypot((xx - yy) / 2, xy);
  if (!(mean + deviation > least_long * (mean - deviation))) return {};
  const double along = std::atan2(2 * xy, xx - yy) / 2;
  return {-std::sin(along), std::cos(along)};
}

/// Whether two slices of one loop each are linked for sure: only ends and forks have Steiner
/// vertices.
bool is_single(const Region& lower, const Region& upper, const TileSet& tiles) {
  return lower.loop_count() == 1 && upper.loop_count() == 1 && tiles.is_linked &&
         std::ranges::find(tiles.inner, VertexKind::steiner, &InnerVertex::kind) ==
             tiles.inner.end();
}

Point smallest_point(const Region& lower, const Region& upper, const Piece& piece) {
  const Region& region = piece.lower.is_empty() ? upper : lower;
  const auto loop =
      region.loop(piece.lower.is_empty() ? piece.upper.loops[0] : piece.lower.loops[0]);
  return region.points[loop[start(region, loop)]];
}

}  // namespace

void sort_pieces(const Region& lower, const Region& upper, Pieces& pieces) {
  struct Key {
    bool is_upper;
    Point point;
    std::uint32_t piece;
  };
  std::vector<Key> keys;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    keys.push_back({piece.lower.is_empty(), smallest_point(lower, upper, piece), i});
  }
  std::ranges::sort(keys, [](const Key& a, const Key& b) {
    if (a.is_upper != b.is_upper) return b.is_upper;
    return a.point != b.point ? a.point < b.point : a.piece < b.piece;
  });
  std::vector<Piece> sorted;
  std::vector<std::uint32_t> place(keys.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    sorted.push_back(std::move(pieces.pieces[keys[i].piece]));
    place[keys[i].piece] = i;
  }
  pieces.pieces = std::move(sorted);
  for (std::uint32_t& piece : pieces.of_tile) piece = place[piece];
}

bool measure(const Region& region, Footprint& footprint) {
  struct Start {
    Point point;
    std::size_t at;
    std::uint32_t loop;
  };
  std::vector<Start> starts;
  for (const std::uint32_t i : footprint.loops) {
    const std::size_t at = start(region, region.loop(i));
    starts.push_back({region.points[region.loop(i)[at]], at, i});
  }
  std::ranges::sort(starts, [](const Start& a, const Start& b) {
    return a.point != b.point ? a.point < b.point : a.loop < b.loop;
  });
  const Point origin = starts.front().point;
  Moments sum;
  std::vector<double> areas;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    footprint.loops[i] = starts[i].loop;
    const Moments loop = moments(region, region.loop(starts[i].loop), starts[i].at, origin);
    areas.push_back(loop.area);
    sum += loop;
  }
  const bool is_solid = sum.area > 0;
  footprint.area = std::abs(sum.area);
  footprint.parts = 0;
  double outer = 0;
  for (const double area : areas) {
    if ((area > 0) != is_solid) continue;
    ++footprint.parts;
    outer += std::abs(area);
  }
  footprint.radius = std::sqrt(outer / std::numbers::pi);
  footprint.centroid = origin;
  if (sum.area != 0) {
    const Point centroid{sum.first.x / sum.area, sum.first.y / sum.area};
    footprint.centroid = {origin.x + centroid.x, origin.y + centroid.y};
    footprint.across = across(sum, centroid);
  }
  return is_solid;
}

Pieces find_pieces(const Region& lower, const Region& upper, const TileSet& tiles) {
  Pieces found;
  if (is_single(lower, upper, tiles)) {
    Piece& piece = found.pieces.emplace_back();
    piece.lower.loops = piece.upper.loops = {0};
    measure(lower, piece.lower);
    measure(upper, piece.upper);
    found.of_tile.assign(tiles.tiles.size(), 0);
    return found;
  }
  const auto lower_count = static_cast<std::uint32_t>(lower.points.size());
  DisjointSets sets(lower_count + upper.points.size() + tiles.inner.size());
  for (const auto& [region, first] : {std::pair(&lower, 0U), std::pair(&upper, lower_count)})
    for (std::size_t i = 0; i < region->loop_count(); ++i)
      for (const std::uint32_t v : region->loop(i))
        sets.unite(first + region->loop(i)[0], first + v);
  for (const Tile& tile : tiles.tiles) {
    sets.unite(tile.nodes[0], tile.nodes[1]);
    sets.unite(tile.nodes[0], tile.nodes[2]);
  }
  std::vector<std::uint32_t> piece_of(lower_count + upper.points.size() + tiles.inner.size(),
                                      Origin::none);
  const auto piece = [&](std::uint32_t node) -> std::uint32_t {
    std::uint32_t& index = piece_of[sets.find(node)];
    if (index == Origin::none) {
      index = static_cast<std::uint32_t>(found.pieces.size());
      found.pieces.emplace_back();
    }
    return index;
  };
  for (std::uint32_t i = 0; i < lower.loop_count(); ++i)
    found.pieces[piece(lower.loop(i)[0])].lower.loops.push_back(i);
  for (std::uint32_t i = 0; i < upper.loop_count(); ++i)
    found.pieces[piece(lower_count + upper.loop(i)[0])].upper.loops.push_back(i);
  for (Piece& p : found.pieces) {
    if (!p.lower.is_empty()) p.is_solid = measure(lower, p.lower);
    if (!p.upper.is_empty()) p.is_solid = measure(upper, p.upper);
  }
  found.of_tile.reserve(tiles.tiles.size());
  for (const Tile& tile : tiles.tiles) found.of_tile.push_back(piece(tile.nodes[0]));
  sort_pieces(lower, upper, found);
  return found;
}

std::vector<double> differences(const Region& lower, const Region& upper, const TileSet& tiles,
                                const Pieces& pieces) {
  std::vector<double> sums(pieces.pieces.size());
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    const std::uint32_t piece = pieces.of_tile[t];
    const Point shift = pieces.pieces[piece].shift;
    std::array<Point, 3> flat;
    for (unsigned i = 0; i < 3; ++i) {
      const Vec3 p = place_of(lower, upper, tiles.inner, tiles.tiles[t].nodes[i]);
      const double share = (p[2] - lower.z) / (upper.z - lower.z);
      flat[i] = {p[0] + share * shift.x, p[1] + share * shift.y};
    }
    const auto& [a, b, c] = flat;
    sums[piece] += std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] = pieces.pieces[i].registered_difference.value_or(sums[i]);
  return sums;
}

}  // namespace loft
