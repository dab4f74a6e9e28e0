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

/// The same angles, but for rounding.
constexpr double rounding = 1e-9;

/// Inner vertices keep that share of the slab's height away from the slices.
constexpr double least_share = 1e-3;

/// Whether the corners of two triangles with the side from a to b are on one circle: the angles at
/// which that is seen from c and from d make half a turn.
bool are_on_one_circle(Point a, Point b, Point c, Point d) {
  const auto angle = [](Point apex, Point p, Point q) {  // its sine and cosine, scaled
    const Point u{p.x - apex.x, p.y - apex.y};
    const Point v{q.x - apex.x, q.y - apex.y};
    const double scale = std::sqrt((u.x * u.x + u.y * u.y) * (v.x * v.x + v.y * v.y));
    return Point{(u.x * v.y - u.y * v.x) / scale, (u.x * v.x + u.y * v.y) / scale};
  };
  const auto [sine, cosine] = angle(c, a, b);
  const auto [other_sine, other_cosine] = angle(d, b, a);
  const double least = std::min(std::abs(sine), std::abs(other_sine));
  return std::abs(sine * other_cosine + cosine * other_sine) <= rounding * least;
}

}  // namespace

double height_share(double to_lower, double to_upper) {
  const double lower = std::pow(to_lower, steepness);
  const double upper = std::pow(to_upper, steepness);
  // On an edge of both slices both are 0, as in the middle of a chord of a hair-thin sheet.
  const double share = lower + upper > 0 ? lower / (lower + upper) : 0.5;
  return std::clamp(share, least_share, 1 - least_share);
}

double height_share(double to_lower, double to_upper, double height) {
  const double share = height_share(to_lower, to_upper);
  const double near = std::min(to_lower, to_upper);
  const double far = std::max(to_lower, to_upper);
  if (!(far > 0)) return share;
  const double apart = 1 - near / far;
  const double bulge = std::min(near / height, highest_end) * apart * apart * apart;
  return to_lower < to_upper ? std::max(share, bulge) : std::min(share, 1 - bulge);
}

SheetHeights::SheetHeights(const Slab& slab)
    : slab_(slab),
      sheet_of_(slab.overlay().triangle_bound(), Origin::none),
      cell_of_(sheet_of_.size(), Origin::none) {}

double SheetHeights::depth(EdgeId e, Point p) { return measured(e).depth(p); }

double SheetHeights::height(EdgeId e, Point p) {
  const Sheet& sheet = measured(e);
  double share = 0;
  if (!sheet.touches_upper) {
    share = end_share(sheet, p);
  } else if (!sheet.touches_lower) {
    share = 1 - end_share(sheet, p);
  } else {
    share = height_share(sheet.lower.distance(p), sheet.upper.distance(p), slab_.height());
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
  find_cells(sheet);
  sheets_.push_back(std::move(sheet));
}

/// Whether an edge between two triangles of a sheet could as well be another one.
bool SheetHeights::is_diagonal(EdgeId e) const {
  const Triangulation& mesh = slab_.overlay();
  if (mesh.is_constrained(e)) return false;
  return are_on_one_circle(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)),
                           mesh.point(mesh.apex(e)), mesh.point(mesh.apex(mesh.twin(e))));
}

void SheetHeights::find_cells(const Sheet& sheet) {
  const Triangulation& mesh = slab_.overlay();
  for (std::size_t i = sheet.first; i < sheet.last; ++i) {
    if (cell_of_[triangles_[i].index()] != Origin::none) continue;
    const auto id = static_cast<std::uint32_t>(cells_.size());
    front_.assign(1, triangles_[i]);
    for (std::size_t next = 0; next < front_.size(); ++next) {
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = Triangulation::edge(front_[next], corner);
        const TriangleId beyond = Triangulation::triangle(mesh.twin(e));
        if (!is_diagonal(e) || cell_of_[beyond.index()] != Origin::none) continue;
        cell_of_[beyond.index()] = cell_of_[front_[next].index()] = id;
        front_.push_back(beyond);
      }
    }
    if (front_.size() == 1) continue;
    CircleCell cell{front_, {}};
    find_centre(cell);
    cells_.push_back(std::move(cell));
  }
}

/// Of a rectangle the middle of its diagonal, to the last bit.
void SheetHeights::find_centre(CircleCell& cell) const {
  const Triangulation& mesh = slab_.overlay();
  std::ranges::sort(cell.triangles, {}, [&](TriangleId t) { return centroid(t); });
  const Point origin = centroid(cell.triangles.front());
  double whole = 0;
  Point sum;
  for (const TriangleId t : cell.triangles) {
    const EdgeId e = Triangulation::edge(t);
    const Point a = mesh.point(mesh.from(e));
    const Point b = mesh.point(mesh.to(e));
    const Point c = mesh.point(mesh.apex(e));
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const Point middle = centroid(t);
    whole += area;
    cell.diameter = std::hypot(b.x - a.x, b.y - a.y) * std::hypot(c.x - b.x, c.y - b.y) *
                    std::hypot(a.x - c.x, a.y - c.y) / area;
    sum = {sum.x + area * (middle.x - origin.x), sum.y + area * (middle.y - origin.y)};
  }
  cell.centre = {origin.x + sum.x / whole, origin.y + sum.y / whole};
  if (cell.triangles.size() != 2) return;
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId e = Triangulation::edge(cell.triangles[0], corner);
    if (Triangulation::triangle(mesh.twin(e)) != cell.triangles[1]) continue;
    const Point a = std::min(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
    const Point b = std::max(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
    const Point middle{a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
    const double off = std::hypot(middle.x - cell.centre.x, middle.y - cell.centre.y);
    if (off <= rounding * std::hypot(b.x - a.x, b.y - a.y)) cell.centre = middle;
  }
}

const CircleCell* SheetHeights::cell(EdgeId e) {
  sheet_at(e);
  const std::uint32_t cell = cell_of_[Triangulation::triangle(e).index()];
  if (cell == Origin::none) return nullptr;
  const std::uint32_t beyond = cell_of_[Triangulation::triangle(slab_.overlay().twin(e)).index()];
  return cell == beyond && !slab_.overlay().is_constrained(e) ? &cells_[cell] : nullptr;
}

void SheetHeights::measure(Sheet& sheet) const {
  const Triangulation& mesh = slab_.overlay();
  std::vector<Segment> bounds[2];
  std::vector<Point> middles;
  for (std::size_t i = sheet.first; i < sheet.last; ++i) {
    const TriangleId t = triangles_[i];
    const std::uint32_t cell = cell_of_[t.index()];
    middles.push_back(cell == Origin::none ? centroid(t) : cells_[cell].centre);
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const Point a = mesh.point(mesh.from(e));
      const Point b = mesh.point(mesh.to(e));
      if (mesh.is_constrained(e)) {
        for (const Level level : {Level::lower, Level::upper})
          if (slab_.is_contour(e, level)) bounds[static_cast<int>(level)].push_back({a, b});
        continue;
      }
      const std::uint32_t beyond = cell_of_[Triangulation::triangle(mesh.twin(e)).index()];
      if (cell != Origin::none && beyond == cell) continue;
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
