// SPDX-License-Identifier: MIT
#include "reconstruct/link/beside.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reconstruct/link/bounds.h"
#include "reconstruct/plane/nearest.h"

namespace loft {

namespace {

using cdt::Point;

/// In radii: see the header. Found on a tree of vessels with every second, third and fourth slice
/// kept, and right on eight others, drawn at random and turned, and on what else was cut from known
/// shapes: of the trees nearly all gained, up to 14%, and no stack lost more than 1.2%.
constexpr double farthest_beside = 1;
constexpr double farthest_off_way = 0.25;
/// In widths of the gap to what a part goes on as.
constexpr double most_of_sibling = 0.5;
/// Of areas.
constexpr double least_of_trunk = 0.5;
constexpr double least_of_twig = 0.05;
/// Over that share of a radius beyond the width of a gap its sides still say where it leads across.
constexpr double blur_of_way = 0.25;
constexpr double stretches_around = 64;
/// Gaps that differ by less than that share of a radius may do so by rounding.
constexpr double rounding_of_gap = 1e-9;

/// From a place to the nearest one of an outline.
Point way_to(const SegmentTree& outline, Point p) {
  double least = std::numeric_limits<double>::infinity();
  Point nearest;
  outline.visit_near(p, least, [&](const Segment& edge) {
    const Point q = foot(p, edge[0], edge[1]);
    const Point way{q.x - p.x, q.y - p.y};
    const double squared = way.x * way.x + way.y * way.y;
    if (squared < least) {
      least = squared;
      nearest = way;
    }
    return least;
  });
  return nearest;
}

Box3 box_of_loops(const Region& region, const Footprint& footprint, double more) {
  cdt::Box box;
  for (const std::uint32_t i : footprint.loops)
    for (const std::uint32_t v : region.loop(i)) box.add(region.points[v]);
  return {{box.low.x - more, box.low.y - more, 0}, {box.high.x + more, box.high.y + more, 0}};
}

}  // namespace

BesideFinder::BesideFinder(const Region& lower, const Region& upper, const Pieces& pieces)
    : lower_(lower), upper_(upper), pieces_(pieces) {
  for (const Level level : {Level::lower, Level::upper}) {
    std::vector<Box3> boxes;
    for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
      const Footprint& part = pieces.pieces[i].footprint(level);
      if (part.parts != 1 || pieces.pieces[i].is_tip()) continue;
      targets_[static_cast<std::size_t>(level)].push_back(i);
      boxes.push_back(box_of_loops(region(level), part, 2 * farthest_beside * part.radius));
    }
    trees_.emplace_back(boxes);
  }
}

const BesideFinder::Outline& BesideFinder::outline(std::uint32_t piece, Level level) {
  const auto [found, is_new] = outlines_.try_emplace({piece, level});
  if (!is_new) return found->second;
  const Footprint& footprint = pieces_.pieces[piece].footprint(level);
  double whole = 0;
  for (const std::uint32_t loop : footprint.loops) whole += length(region(level), loop);
  std::vector<Stretch> stretches;
  std::vector<Segment> edges;
  for (const std::uint32_t loop : footprint.loops) {
    const auto more = stretches_by_edges(region(level), loop, whole / stretches_around);
    stretches.insert(stretches.end(), more.begin(), more.end());
    const auto vertices = region(level).loop(loop);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      edges.push_back({region(level).points[vertices[i]],
                       region(level).points[vertices[(i + 1) % vertices.size()]]});
  }
  found->second = {std::move(stretches), SegmentTree(std::move(edges)), whole};
  return found->second;
}

/// How wide a gap may be; none if the two are no match.
std::optional<double> BesideFinder::reach(const LooseEnd& end, const Piece& target) const {
  const Piece& piece = pieces_.pieces[end.piece];
  const Footprint& own = piece.footprint(end.level);
  const Footprint& part = target.footprint(other(end.level));
  if (piece.is_solid != target.is_solid || !is_within(least_of_trunk * own.area, part.area))
    return {};
  if (target.is_end() && !is_within(least_of_twig * part.area, own.area)) return {};
  if (end.expected) return farthest_off_way * own.radius;
  return farthest_beside * (target.is_end() ? std::max(own.radius, part.radius) : own.radius);
}

/// Whether an end and what a part goes on as do not belong together in the slab beside.
bool BesideFinder::is_apart(const LooseEnd& end, const Piece& target) const {
  return std::ranges::none_of(target.footprint(end.level).loops, [&](std::uint32_t loop) {
    return std::ranges::find(end.joined, loop) != end.joined.end();
  });
}

/// Between an end, where it is expected, and a part, if that lets them be joined.
std::optional<BesideFinder::Gap> BesideFinder::gap(const LooseEnd& end, std::uint32_t target) {
  const Piece& piece = pieces_.pieces[target];
  const auto reach = this->reach(end, piece);
  if (!reach || !is_apart(end, piece)) return {};
  const Outline& own = outline(end.piece, end.level);
  const Outline& part = outline(target, other(end.level));
  const Point expected = end.expected.value_or(Point{});
  const auto width = [](Point way) { return std::hypot(way.x, way.y); };
  double least = std::numeric_limits<double>::infinity();
  double to_sibling = least;
  std::vector<Point> ways;
  for (const Stretch& stretch : own.stretches) {
    const Point p = stretch.middle;
    ways.push_back(way_to(part.tree, {p.x + expected.x, p.y + expected.y}));
    least = std::min(least, width(ways.back()));
    if (!piece.is_end())
      to_sibling = std::min(to_sibling, width(way_to(outline(target, end.level).tree, p)));
  }
  if (!is_within(least, *reach) || !is_within(least, most_of_sibling * to_sibling)) return {};
  Point across;
  const double blur = blur_of_way * pieces_.pieces[end.piece].footprint(end.level).radius;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double further = (width(ways[i]) - least) / blur;
    const double weight = own.stretches[i].length * std::exp(-further * further);
    across = {across.x + weight * ways[i].x, across.y + weight * ways[i].y};
  }
  const double size = width(across);
  if (!(size > 0)) return {};
  return Gap{least, {across.x / size, across.y / size}};
}

std::optional<Trunk> BesideFinder::find(const LooseEnd& end) {
  const Footprint& own = pieces_.pieces[end.piece].footprint(end.level);
  const Level beyond = other(end.level);
  Box3 box = box_of_loops(region(end.level), own, 2 * farthest_beside * own.radius);
  if (end.expected) {
    const Box3 here = box;
    for (const auto& [axis, way] :
         {std::pair(0U, end.expected->x), std::pair(1U, end.expected->y)}) {
      box.low[axis] += way;
      box.high[axis] += way;
    }
    box = joined(here, box);
  }
  std::vector<std::uint32_t> near;
  trees_[static_cast<std::size_t>(beyond)].for_each_meeting(
      box, [&](std::uint32_t i) { near.push_back(targets_[static_cast<std::size_t>(beyond)][i]); });
  std::ranges::sort(near);
  const double same = rounding_of_gap * own.radius;
  double least = std::numeric_limits<double>::infinity();
  std::optional<Trunk> best;
  bool is_tie = false;
  for (const std::uint32_t target : near) {
    if (target == end.piece) continue;
    const auto gap = this->gap(end, target);
    if (!gap || gap->width > least + same) continue;
    is_tie = gap->width >= least - same;
    if (is_tie) continue;
    least = gap->width;
    const double thickness = std::min(
        2 * own.area / outline(end.piece, end.level).length,
        2 * pieces_.pieces[target].footprint(beyond).area / outline(target, beyond).length);
    const double size = gap->width + 2 * thickness;
    const Point expected = end.expected.value_or(Point{});
    best = {target, {expected.x + size * gap->way.x, expected.y + size * gap->way.y}};
  }
  if (is_tie) return {};  // rounding would decide
  return best;
}

}  // namespace loft
