// SPDX-License-Identifier: MIT
#include "reconstruct/tile/sheet_heights.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;

constexpr double steepness = 0.7;    // k in the header
constexpr double highest_end = 0.7;  // of the slab
constexpr double lowest_end = 0.05;  // so that a cut just beside the slice still shows small parts

/// Inner vertices keep that share of the slab's height away from the slices.
constexpr double least_share = 1e-3;

}  // namespace

double height_share(double to_lower, double to_upper) {
  const double lower = std::pow(to_lower, steepness);
  const double upper = std::pow(to_upper, steepness);
  // On an edge of both slices both are 0, as in the middle of a chord of a hair-thin sheet.
  const double share = lower + upper > 0 ? lower / (lower + upper) : 0.5;
  return std::clamp(share, least_share, 1 - least_share);
}

SheetHeights::SheetHeights(const Slab& slab)
    : slab_(slab), sheet_of_(slab.overlay().triangle_bound(), Origin::none) {}

double SheetHeights::depth(EdgeId e, Point p) { return measured(e).depth(p); }

double SheetHeights::height(EdgeId e, Point p) {
  const Sheet& sheet = measured(e);
  double share = 0;
  if (!sheet.touches_upper) {
    share = end_share(sheet, p);
  } else if (!sheet.touches_lower) {
    share = 1 - end_share(sheet, p);
  } else {
    share = height_share(sheet.lower.distance(p), sheet.upper.distance(p));
  }
  assert(std::isfinite(share));
  return slab_.lower().z + std::clamp(share, least_share, 1 - least_share) * slab_.height();
}

/// How far, as a share of the slab, the surface is from the slice that an end belongs to.
double SheetHeights::end_share(const Sheet& sheet, Point p) const {
  if (!(sheet.radius > 0)) return 0;
  const double inwards = 1 - std::min(sheet.depth(p) / sheet.radius, 1.0);
  const double top = std::clamp(sheet.radius / slab_.height(), lowest_end, highest_end);
  return top * (1 - inwards * inwards);
}

SheetHeights::Sheet& SheetHeights::sheet_at(EdgeId e) {
  const TriangleId t = Triangulation::triangle(e);
  if (sheet_of_[t.index()] == Origin::none) explore(t);
  return sheets_[sheet_of_[t.index()]];
}

const SheetHeights::Sheet& SheetHeights::measured(EdgeId e) {
  Sheet& sheet = sheet_at(e);
  if (!sheet.is_measured) measure(sheet);
  return sheet;
}

Point SheetHeights::centroid(TriangleId t) const {
  const Triangulation& mesh = slab_.overlay();
  const EdgeId e = Triangulation::edge(t);
  std::array corners{mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))};
  std::ranges::sort(corners);  // the same to the last bit whichever comes first
  const auto& [a, b, c] = corners;
  return {a.x + ((b.x - a.x) + (c.x - a.x)) / 3, a.y + ((b.y - a.y) + (c.y - a.y)) / 3};
}

/// Finds the triangles of a sheet, and which slices it touches.
void SheetHeights::explore(TriangleId start) {
  const Triangulation& mesh = slab_.overlay();
  const auto id = static_cast<std::uint32_t>(sheets_.size());
  Sheet sheet;
  sheet.first = triangles_.size();
  front_.assign(1, start);
  sheet_of_[start.index()] = id;
  while (!front_.empty()) {
    const TriangleId t = front_.back();
    front_.pop_back();
    triangles_.push_back(t);
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      if (mesh.is_constrained(e)) {
        sheet.touches_lower = sheet.touches_lower || slab_.is_contour(e, Level::lower);
        sheet.touches_upper = sheet.touches_upper || slab_.is_contour(e, Level::upper);
        continue;
      }
      const TriangleId beyond = Triangulation::triangle(mesh.twin(e));
      if (sheet_of_[beyond.index()] != Origin::none) continue;
      sheet_of_[beyond.index()] = id;
      front_.push_back(beyond);
    }
  }
  sheet.last = triangles_.size();
  sheets_.push_back(std::move(sheet));
}

void SheetHeights::measure(Sheet& sheet) const {
  const Triangulation& mesh = slab_.overlay();
  std::vector<Segment> bounds[2];
  std::vector<Point> middles;
  for (std::size_t i = sheet.first; i < sheet.last; ++i) {
    const TriangleId t = triangles_[i];
    middles.push_back(centroid(t));
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const Point a = mesh.point(mesh.from(e));
      const Point b = mesh.point(mesh.to(e));
      if (mesh.is_constrained(e)) {
        for (const Level level : {Level::lower, Level::upper})
          if (slab_.is_contour(e, level)) bounds[static_cast<int>(level)].push_back({a, b});
        continue;
      }
      middles.push_back({a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2});
    }
  }
  sheet.lower = NearestSegment(std::move(bounds[0]));
  sheet.upper = NearestSegment(std::move(bounds[1]));
  if (sheet.is_end())
    for (const Point p : middles) sheet.radius = std::max(sheet.radius, sheet.depth(p));
  sheet.is_measured = true;
}

}  // namespace loft
