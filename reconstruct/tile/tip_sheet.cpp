// SPDX-License-Identifier: MIT
#include "reconstruct/tile/tip_sheet.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <tuple>

#include "cdt/predicates.h"
#include "cdt/regions.h"
#include "reconstruct/plane/nearest.h"
#include "reconstruct/tile/middle.h"
#include "reconstruct/tile/sheet_heights.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::SegmentId;
using cdt::Triangulation;
using cdt::VertexId;

/// The lines of a region; a point is one without length.
std::vector<Segment> segments_of_lines(const Region& region, std::span<const std::uint32_t> lines) {
  std::vector<Segment> all;
  for (const std::uint32_t i : lines) {
    const auto line = region.line(i);
    if (line.size() == 1) all.push_back({region.points[line[0]], region.points[line[0]]});
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
      all.push_back({region.points[line[k]], region.points[line[k + 1]]});
  }
  return all;
}

}  // namespace

std::optional<TipSheet> TipSheet::make(const Region& part, const Region& tips, double contact) {
  TipSheet sheet(part, tips, contact);
  sheet.insert();
  if (!sheet.drop_uncovered() || !sheet.note_vertices()) return {};
  sheet.list_triangles();
  if (!sheet.list_outline()) return {};
  sheet.flip_chords();
  if (!sheet.lift_chords() || !sheet.lift_flat()) return {};
  return sheet;
}

std::vector<std::uint32_t> TipSheet::along(std::size_t loop_vertex) const {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t v : outline_[loop_vertex]) {
    if (!all.empty()) {
      const auto made = middles_.find(std::minmax(all.back(), v));
      if (made != middles_.end()) all.push_back(made->second);
    }
    all.push_back(v);
  }
  return all;
}

// --- The triangulation of the part, with the tips in it ---

void TipSheet::insert() {
  insert_loops(part_, mesh_);
  constraints_.resize(tips_.line_count());
  std::vector<Point> points;
  for (std::size_t i = 0; i < tips_.line_count(); ++i) {
    points.clear();
    for (const std::uint32_t v : tips_.line(i)) points.push_back(tips_.points[v]);
    constraints_[i] = mesh_.insert(points, cdt::open);
  }
  classify();
}

void TipSheet::classify() {
  is_inside_ = cdt::flood(mesh_, false, [&](EdgeId e, bool inside) {
    for (const cdt::Passage passage : mesh_.passages(e))
      if (passage.segment().index() < part_.loop_vertices.size()) inside = !inside;
    return inside;
  });
}

bool TipSheet::is_inside(EdgeId e) const { return is_inside_[Triangulation::triangle(e).index()]; }

std::vector<VertexId> TipSheet::line_vertices(std::size_t line) const {
  const cdt::ConstraintId id = *constraints_[line];
  std::vector<VertexId> vertices{mesh_.first_vertex(id)};
  for (const cdt::Segment& segment : mesh_.segments(id)) vertices.push_back(segment.to);
  vertices.resize(tips_.line(line).size());
  return vertices;
}

/// A line is covered if it runs along edges of its own, with the part on one side at least.
bool TipSheet::covers(std::size_t line) const {
  const std::vector<VertexId> vertices = line_vertices(line);
  const EdgeId first = mesh_.edge(vertices.front());
  EdgeId e = first;
  bool is_at_part = false;
  do {
    is_at_part = is_at_part || is_inside(e);
    e = mesh_.rotated(e);
  } while (e != first);
  if (!is_at_part) return false;
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    if (vertices[k] == vertices[k + 1]) return false;
    const auto edge = mesh_.find_edge(vertices[k], vertices[k + 1]);
    if (!edge || (!is_inside(*edge) && !is_inside(mesh_.twin(*edge)))) return false;
  }
  return true;
}

/// Whether any are left.
bool TipSheet::drop_uncovered() {
  std::vector<std::uint32_t> dropped;
  for (std::uint32_t i = 0; i < constraints_.size(); ++i)
    (covers(i) ? covered_ : dropped).push_back(i);
  if (covered_.empty()) return false;
  for (const std::uint32_t i : dropped) {
    mesh_.remove(*constraints_[i]);
    constraints_[i].reset();
  }
  if (!dropped.empty()) classify();
  return true;
}

/// False if points of one slice are the same vertex.
bool TipSheet::note_vertices() {
  vertex_of_.assign(mesh_.vertex_bound(), none);
  const auto vertex = [&](VertexId v) -> Vertex& {
    std::uint32_t& here = vertex_of_[v.index()];
    if (here == none) {
      here = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back({mesh_.point(v)});
    }
    return vertices_[here];
  };
  for (std::uint32_t s = 0; s < part_.loop_vertices.size(); ++s) {
    const cdt::Segment& segment = mesh_.segment(SegmentId(s));
    Vertex& there = vertex(segment.from);
    if (segment.from == segment.to) return false;
    if (there.outline != none && there.outline != part_.loop_vertices[s]) return false;
    there.outline = part_.loop_vertices[s];
  }
  for (const std::uint32_t i : covered_) {
    const std::vector<VertexId> vertices = line_vertices(i);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      Vertex& there = vertex(vertices[k]);
      const std::uint32_t point = tips_.line(i)[k];
      if (there.tip != none && there.tip != point) return false;
      there.tip = point;
      if (there.place != tips_.points[point]) is_doubtful_ = true;
    }
  }
  return true;
}

void TipSheet::list_triangles() {
  std::vector<std::uint32_t> number(mesh_.triangle_bound(), none);
  for (std::uint32_t t = 0; t < number.size(); ++t) {
    if (!is_inside_[t] || !mesh_.is_triangle(cdt::TriangleId(t))) continue;
    number[t] = static_cast<std::uint32_t>(triangles_.size());
    Triangle& corners = triangles_.emplace_back();
    for (unsigned k = 0; k < 3; ++k)
      corners[k] = vertex_of_[mesh_.from(Triangulation::edge(cdt::TriangleId(t), k)).index()];
  }
  twins_.assign(3 * triangles_.size(), none);
  is_line_.assign(twins_.size(), false);
  for (std::uint32_t t = 0; t < number.size(); ++t) {
    if (number[t] == none) continue;
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeId e = Triangulation::edge(cdt::TriangleId(t), k);
      bool is_outline = false;
      for (const cdt::Passage passage : mesh_.passages(e)) {
        const bool is_of_part = passage.segment().index() < part_.loop_vertices.size();
        is_outline = is_outline || is_of_part;
        if (!is_of_part) is_line_[3 * number[t] + k] = true;
      }
      const EdgeId beyond = mesh_.twin(e);
      if (!is_outline)
        twins_[3 * number[t] + k] = 3 * number[Triangulation::triangle(beyond).index()] +
                                    static_cast<std::uint32_t>(beyond.index() % 3);
    }
  }
}

/// False if an edge of the part goes through another one's vertex.
bool TipSheet::list_outline() {
  for (std::uint32_t s = 0; s < part_.loop_vertices.size(); ++s) {
    const cdt::Segment& segment = mesh_.segment(SegmentId(s));
    auto& along = outline_.emplace_back(1, vertex_of_[segment.from.index()]);
    for (const EdgeId e : mesh_.pieces(SegmentId(s))) {
      const VertexId v = mesh_.to(e);
      along.push_back(vertex_of_[v.index()]);
      if (v == segment.to) continue;
      if (!is_tip(along.back()) || vertices_[along.back()].outline != none) return false;
      if (cdt::orient(mesh_.point(segment.from), mesh_.point(segment.to), mesh_.point(v)) != 0)
        is_doubtful_ = true;
    }
  }
  return true;
}

// --- The triangles, on their way to a sheet ---

/// Whether both ends of a side are at the height of one slice, though nothing of it is there.
bool TipSheet::is_chord(std::uint32_t h) const {
  const std::uint32_t u = from(h);
  const std::uint32_t v = to(h);
  if (is_made(u) || is_made(v) || is_tip(u) != is_tip(v)) return false;
  return is_tip(u) ? !is_line_[h] : twins_[h] != none;
}

/// Whether there would be a side from a tip to the outline in its place.
bool TipSheet::is_flippable(std::uint32_t h) const {
  if (twins_[h] == none || !is_chord(h)) return false;
  const std::uint32_t x = apex(h);
  const std::uint32_t y = apex(twins_[h]);
  if (is_made(x) || is_made(y) || is_tip(x) == is_tip(y)) return false;
  return cdt::orient(place(y), place(to(h)), place(x)) > 0 &&
         cdt::orient(place(x), place(from(h)), place(y)) > 0;
}

void TipSheet::join(std::uint32_t h, std::uint32_t twin, bool is_line) {
  twins_[h] = twin;
  is_line_[h] = is_line;
  if (twin != none) twins_[twin] = h;
}

/// The triangles u v x and v u y become u y x and y v x.
void TipSheet::flip(std::uint32_t h) {
  const std::uint32_t g = twins_[h];
  const std::uint32_t u = from(h);
  const std::uint32_t v = to(h);
  const std::uint32_t x = apex(h);
  const std::uint32_t y = apex(g);
  struct Beyond {
    std::uint32_t twin;
    bool is_line;
  };
  const auto beyond = [&](std::uint32_t side) { return Beyond{twins_[side], is_line_[side]}; };
  const Beyond vx = beyond(next(h));
  const Beyond xu = beyond(next(next(h)));
  const Beyond uy = beyond(next(g));
  const Beyond yv = beyond(next(next(g)));
  const std::uint32_t s = h / 3;
  const std::uint32_t t = g / 3;
  triangles_[s] = {u, y, x};
  triangles_[t] = {y, v, x};
  join(3 * s, uy.twin, uy.is_line);
  join(3 * s + 1, 3 * t + 2, false);
  join(3 * s + 2, xu.twin, xu.is_line);
  join(3 * t, yv.twin, yv.is_line);
  join(3 * t + 1, vx.twin, vx.is_line);
  is_line_[3 * t + 2] = false;
}

std::vector<std::uint32_t> TipSheet::chords() const {
  std::vector<std::uint32_t> all;
  for (std::uint32_t h = 0; h < twins_.size(); ++h)
    if (is_chord(h) && (twins_[h] == none || h < twins_[h])) all.push_back(h);
  const auto key = [&](std::uint32_t h) {
    const auto [a, b] = std::minmax({place(from(h)), place(to(h))});
    return std::tuple(static_cast<float>(std::hypot(b.x - a.x, b.y - a.y)), a, b);
  };
  std::ranges::sort(all, {}, key);
  return all;
}

/// Each flip leaves a chord less, and may let the sides behind be flipped.
void TipSheet::flip_chords() {
  const std::vector<std::uint32_t> first = chords();
  std::deque<std::uint32_t> sides(first.begin(), first.end());
  while (!sides.empty()) {
    const std::uint32_t h = sides.front();
    sides.pop_front();
    if (!is_flippable(h)) continue;
    const std::uint32_t s = h / 3;
    const std::uint32_t t = twins_[h] / 3;
    flip(h);
    for (const std::uint32_t side : {3 * s, 3 * s + 2, 3 * t, 3 * t + 1}) sides.push_back(side);
  }
}

bool TipSheet::is_upright() const {
  return std::ranges::all_of(triangles_, [&](const Triangle& t) {
    return cdt::orient(place(t[0]), place(t[1]), place(t[2])) > 0;
  });
}

/// All other sides end at the new vertices: they are no chords.
bool TipSheet::lift_chords() {
  const std::vector<std::uint32_t> all = chords();
  if (all.empty()) return true;
  const NearestSegment outline(boundary(part_));
  const NearestSegment lines(segments_of_lines(tips_, covered_));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const std::uint32_t h : all) {
    ends.push_back(std::minmax(from(h), to(h)));
    sides_[ends.back()] = h;
  }
  for (const auto& chord : ends) {
    const std::uint32_t h = sides_.at(chord);
    const auto v = static_cast<std::uint32_t>(vertices_.size());
    const Point p = middle(place(from(h)), place(to(h)));
    if (twins_[h] == none) {
      is_doubtful_ = true;
      middles_[chord] = v;
      vertices_.push_back({p, none, none, 0.5});
      split_side(h, v);
    } else {
      vertices_.push_back({p, none, none, height_share(outline.distance(p), lines.distance(p))});
      split_edge(h, v);
    }
  }
  return is_upright();
}

/// Triangles with all their sides on lines.
bool TipSheet::lift_flat() {
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  const auto is_flat = [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return is_tip(v); }) ||
           std::ranges::none_of(t, [&](std::uint32_t v) { return is_tip(v) || is_made(v); });
  };
  std::vector<std::uint32_t> flat;
  for (std::uint32_t t = 0; t < count; ++t)
    if (is_flat(triangles_[t])) flat.push_back(t);
  if (flat.empty()) return true;
  const NearestSegment outline(boundary(part_));
  const NearestSegment lines(segments_of_lines(tips_, covered_));
  for (const std::uint32_t t : flat) {
    const auto [a, b, c] = triangles_[t];
    const Point p = middle(place(a), place(b), place(c));
    vertices_.push_back({p, none, none, height_share(outline.distance(p), lines.distance(p))});
    split_triangle(t, static_cast<std::uint32_t>(vertices_.size() - 1));
  }
  return is_upright();
}

/// The triangle u v x becomes u m x and m v x; the side u v stays in the place h, as u m.
void TipSheet::split_side(std::uint32_t h, std::uint32_t middle) {
  const std::uint32_t s = h / 3;
  const std::uint32_t vx = next(h);
  const std::uint32_t v = to(h);
  const std::uint32_t x = apex(h);
  const auto t = static_cast<std::uint32_t>(triangles_.size());
  triangles_.push_back({middle, v, x});
  twins_.resize(3 * triangles_.size(), none);
  is_line_.resize(3 * triangles_.size(), false);
  join(3 * t + 1, twins_[vx], is_line_[vx]);
  const auto moved = sides_.find(std::minmax(v, x));
  if (moved != sides_.end() && moved->second == vx) moved->second = 3 * t + 1;
  triangles_[s][vx % 3] = middle;
  join(vx, 3 * t + 2, false);
}

void TipSheet::split_edge(std::uint32_t h, std::uint32_t middle) {
  const std::uint32_t g = twins_[h];
  const auto t = static_cast<std::uint32_t>(triangles_.size());
  split_side(h, middle);  // h is u m, and 3t is m v
  split_side(g, middle);  // g is v m, and 3t + 3 is m u
  join(h, 3 * t + 3, false);
  join(g, 3 * t, false);
}

void TipSheet::split_triangle(std::uint32_t t, std::uint32_t middle) {
  const auto [a, b, c] = triangles_[t];
  triangles_.push_back({b, c, middle});
  triangles_.push_back({c, a, middle});
  triangles_[t] = {a, b, middle};
}

}  // namespace loft
