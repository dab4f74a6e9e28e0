// SPDX-License-Identifier: MIT
#include "reconstruct/shape/smooth_target.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "mesh/vec3.h"
#include "reconstruct/shape/ways.h"

namespace loft {

namespace {

using cdt::Point;

/// Vertices stay that share of the slab's height away from the slices.
constexpr double least_share = 0.02;

/// Where the function is flatter than that, its zero is not near.
constexpr double least_gradient = 0.2;
constexpr int newton_steps = 3;

/// In radii of a footprint: what is over it by less touches it but for rounding.
constexpr double touch = 1e-6;

/// The deepest known place of a part.
struct Depth {
  Point place;
  double depth = 0;
};

/// Pattern search (Hooke and Jeeves, 1961): to the best of eight places around, nearer by half
/// where none is better.
void deepen(Depth& deepest, const SignedDistance& distance) {
  const double side = distance.at(deepest.place).distance < 0 ? -1 : 1;
  constexpr double finest = 0.01;
  for (double step = deepest.depth / 2; step > finest * deepest.depth;) {
    Depth best = deepest;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        const Point place{deepest.place.x + step * x, deepest.place.y + step * y};
        const double depth = side * distance.at(place).distance;
        if (depth > best.depth) best = {place, depth};
      }
    }
    if (best.depth > deepest.depth) {
      deepest = best;
    } else {
      step /= 2;
    }
  }
}

/// The deepest place of each piece that ends in the slab, as near as a search from its corners and
/// middles of edges comes; of equally deep ones the first by coordinates.
std::vector<Depth> find_depths(const Region& lower, const Region& upper, const Surroundings& slices,
                               const Pieces& pieces, const TileSet& tiles) {
  std::vector<Depth> deepest(pieces.pieces.size());
  const auto shape = [&](const Piece& piece) -> const SignedDistance& {
    return slices[piece.lower.is_empty() ? 2 : 1]->distance;
  };
  for (std::uint32_t t = 0; t < tiles.tiles.size(); ++t) {
    const Piece& piece = pieces.pieces[pieces.of_tile[t]];
    if (!piece.is_end()) continue;
    Depth& known = deepest[pieces.of_tile[t]];
    const auto look = [&](const Vec3& p) {
      const Point place{p[0], p[1]};
      const double depth = std::abs(shape(piece).at(place).distance);
      if (depth > known.depth || (depth == known.depth && place < known.place))
        known = {place, depth};
    };
    const auto& nodes = tiles.tiles[t].nodes;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = place_of(lower, upper, tiles.inner, nodes[i]);
      look(p);
      look(edge_middle(p, place_of(lower, upper, tiles.inner, nodes[(i + 1) % 3])));
    }
  }
  for (std::uint32_t i = 0; i < deepest.size(); ++i)
    if (deepest[i].depth > 0) deepen(deepest[i], shape(pieces.pieces[i]));
  return deepest;
}

/// A circle around the contours of a piece in one slice.
struct Circle {
  Point middle;
  double radius = 0;
};

Circle circle_around(const Region& region, const Footprint& footprint) {
  Circle circle{footprint.centroid};
  for (const std::uint32_t loop : footprint.loops) {
    for (const std::uint32_t i : region.loop(loop)) {
      const Point p = region.points[i];
      circle.radius =
          std::max(circle.radius, std::hypot(p.x - circle.middle.x, p.y - circle.middle.y));
    }
  }
  return circle;
}

/// From a slice to one beyond it, in which what goes on is `moved`.
struct Beyond {
  const SliceShape* slice;
  const SliceShape* beyond;
  Point moved;
  double reach;  // what is over by less only touches
};

/// Whether a way from a corner of an outline, between two edges, begins on the left of the outline.
bool is_left(Point before, Point corner, Point after, Point way) {
  const auto cross = [](Point a, Point b) { return a.x * b.y - a.y * b.x; };
  const Point in{corner.x - before.x, corner.y - before.y};
  const Point out{after.x - corner.x, after.y - corner.y};
  return cross(in, out) >= 0 ? cross(in, way) > 0 && cross(out, way) > 0
                             : cross(in, way) > 0 || cross(out, way) > 0;
}

/// Whether anything of a piece in one slice is over its footprint beyond: over a corner of that, or
/// inside of it.
bool goes_on(const Region& region, const Piece& piece, Level level, const Beyond& to) {
  const auto is_over = [&](std::span<const std::uint32_t> loop, std::size_t i) {
    const auto point = [&](std::size_t k) { return region.points[loop[k % loop.size()]]; };
    const Point p = point(i);
    const auto [distance, outward, there] =
        to.beyond->distance.at({p.x + to.moved.x, p.y + to.moved.y});
    if ((piece.is_solid ? -distance : distance) > to.reach) return true;
    const Point foot{there.x - to.moved.x, there.y - to.moved.y};
    return to.slice->depth(piece.is_solid, foot) > to.reach &&
           is_left(point(i + loop.size() - 1), p, point(i + 1), {foot.x - p.x, foot.y - p.y}) ==
               piece.is_solid;
  };
  for (const std::uint32_t loop : piece.footprint(level).loops)
    for (std::size_t i = 0; i < region.loop(loop).size(); ++i)
      if (is_over(region.loop(loop), i)) return true;
  return false;
}

/// The slices that tell how a piece goes: not one in which it has not begun yet, or has ended.
Surroundings known_of(const Piece& piece, const BentSlab& slab, Point way) {
  Surroundings known = slab.slices;
  const double height = slab.upper.z - slab.lower.z;
  const auto look = [&](const SliceShape*& beyond, const SliceShape& slice, const Region& region,
                        Level level) {
    if (beyond == nullptr || beyond->distance.is_empty()) return;
    const auto [middle, radius] = circle_around(region, piece.footprint(level));
    // What is hollow there, or bent around it, may be so beyond as well.
    if (slice.depth(piece.is_solid, middle) <= 0) return;
    const double share = (beyond->z - slice.z) / height;
    const Point moved{-share * way.x, -share * way.y};
    const double depth = beyond->depth(piece.is_solid, {middle.x + moved.x, middle.y + moved.y});
    if (depth > 0) return;
    if (depth <= -radius || !goes_on(region, piece, level, {&slice, beyond, moved, touch * radius}))
      beyond = nullptr;
  };
  look(known[0], *slab.slices[1], slab.lower, Level::lower);
  look(known[3], *slab.slices[2], slab.upper, Level::upper);
  return known;
}

}  // namespace

Vec3 between_slices(double bottom, double top, const Vec3& place, double z) {
  const double least = least_share * (top - bottom);
  return {place[0], place[1],
          std::clamp(place[2], std::min(bottom + least, z), std::max(top - least, z))};
}

SmoothTarget::SmoothTarget(const BentSlab& slab, const TileSet& tiles, double nearness)
    : bottom_(slab.lower.z),
      height_(slab.upper.z - slab.lower.z),
      nearness_(nearness),
      shapes_(slab.pieces.pieces.size()) {
  const auto& [lower, upper, slices, pieces] = slab;
  const std::vector<Depth> depths = find_depths(lower, upper, slices, pieces, tiles);
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.is_tip()) continue;  // a point or a line tells where it ends
    if (!piece.bends) continue;
    if (!piece.is_end()) {
      // What goes several ways at once is bent over each place as it is.
      const Point way = piece.registered_difference ? Point{} : piece.shift;
      shapes_[i] = SmoothPassage(known_of(piece, slab, way), {-way.x, -way.y});
    } else if (depths[i].depth > 0) {
      const Level level = piece.lower.is_empty() ? Level::upper : Level::lower;
      shapes_[i] = SmoothEnd(slices, level == Level::lower ? 1 : 2, depths[i].place,
                             depths[i].depth, piece.footprint(level).across, piece.lean);
    }
  }
}

Vec3 SmoothTarget::way_from(const Vec3& place, std::uint32_t piece, double most,
                            Point facing) const {
  const Shape& shape = shapes_[piece];
  if (const auto* passage = std::get_if<SmoothPassage>(&shape))
    return way_from(place, most, [&](const Vec3& p) { return passage->at(p, facing); });
  if (const auto* end = std::get_if<SmoothEnd>(&shape)) {
    const Vec3 upright = end->upright(place);
    const Vec3 way = way_from(upright, most, [&](const Vec3& p) { return end->at(p); });
    return minus(end->leant(along(upright, 1, way)), place);
  }
  return {};
}

Vec3 SmoothTarget::even_way_from(const Vec3& place, std::uint32_t piece, double most,
                                 Point facing) const {
  const auto* const passage = std::get_if<SmoothPassage>(&shapes_[piece]);
  if (passage == nullptr) return {};
  return way_from(place, most, [&](const Vec3& p) { return passage->even_at(p, facing); });
}

template <class SampleAt>
Vec3 SmoothTarget::way_from(const Vec3& place, double most, const SampleAt& sample_at) const {
  Vec3 way{};
  for (int step = 0; step < newton_steps; ++step) {
    const Sample sample = sample_at(along(place, 1, way));
    const double steepness = std::max(length(sample.gradient), least_gradient);
    if (std::abs(sample.value) < nearness_ * height_ * steepness) break;
    way = along(way, -sample.value / (steepness * steepness), sample.gradient);
    const double least = least_share * height_;
    way[2] = std::clamp(place[2] + way[2], bottom_ + least, bottom_ + height_ - least) - place[2];
    way = cut_off(way, most);
  }
  return way;
}

}  // namespace loft
