// SPDX-License-Identifier: MIT
#include "reconstruct/tile/slab.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

#include "cdt/predicates.h"
#include "cdt/regions.h"

namespace loft {

Slab::Slab(const Region& lower, const Region& upper, cdt::Point shift, cdt::Triangulation memory)
    : lower_(lower), upper_(upper), shift_(shift), overlay_(std::move(memory)) {
  overlay_.clear();
  overlay_.reserve(lower.points.size() + upper.points.size());
  insert_loops(lower, overlay_);
  insert_loops(upper, overlay_, shift);
  note_vertices(Level::lower);
  note_vertices(Level::upper);
  refresh();
}

/// Where two things are near each other, there is a triangle between them that is no higher, or a
/// side of one that is no longer; or they meet already, but for rounding.
bool Slab::has_near_contact(double contact) const {
  for (std::uint32_t i = 0; i < overlay_.edge_bound(); ++i) {
    const cdt::EdgeId e(i);
    if (!overlay_.is_triangle(cdt::Triangulation::triangle(e))) continue;
    if (is_short_between_slices(e, contact)) return true;
    if (overlay_.is_constrained(e) && (is_bent(e) || is_near_apex(e, contact))) return true;
  }
  return false;
}

/// Whether an edge no longer than `contact` joins what are not two vertices of one slice.
bool Slab::is_short_between_slices(cdt::EdgeId e, double contact) const {
  const cdt::VertexId from = overlay_.from(e);
  const cdt::VertexId to = overlay_.to(e);
  const cdt::Point a = overlay_.point(from);
  const cdt::Point b = overlay_.point(to);
  if (!(std::abs(b.x - a.x) <= contact && std::abs(b.y - a.y) <= contact)) return false;
  const auto are_of = [&](Level level) { return is_vertex(from, level) && is_vertex(to, level); };
  return !are_of(Level::lower) && !are_of(Level::upper);
}

/// Whether a contour edge goes on after `e` through a vertex of the other slice that is beside it.
bool Slab::is_bent(cdt::EdgeId e) const {
  const cdt::VertexId v = overlay_.to(e);
  return std::ranges::any_of(overlay_.passages(e), [&](cdt::Passage passage) {
    const cdt::Segment& segment = overlay_.segment(passage.segment());
    return v != segment.from && v != segment.to && is_vertex(v, other(level(passage.segment()))) &&
           cdt::orient(overlay_.point(segment.from), overlay_.point(segment.to),
                       overlay_.point(v)) != 0;
  });
}

/// Whether the vertex across from a contour edge is of the other slice, and no farther from the
/// edge than `contact`.
bool Slab::is_near_apex(cdt::EdgeId e, double contact) const {
  if (overlay_.is_infinite(cdt::Triangulation::triangle(e))) return false;
  const cdt::VertexId apex = overlay_.apex(e);
  const cdt::Point a = overlay_.point(overlay_.from(e));
  const cdt::Point b = overlay_.point(overlay_.to(e));
  const cdt::Point c = overlay_.point(apex);
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area > 2 * contact * std::max(std::abs(b.x - a.x), std::abs(b.y - a.y))) return false;
  if ((c.x - a.x) * (c.x - b.x) + (c.y - a.y) * (c.y - b.y) > 0) return false;  // not beside it
  return std::ranges::any_of(overlay_.passages(e), [&](cdt::Passage passage) {
    const Level own = level(passage.segment());
    return is_vertex(apex, other(own)) && !is_vertex(apex, own);
  });
}

Slab::Slab(const Region& lower, const Region& upper, cdt::Point shift,
           std::array<LoopPaths, 2> paths)
    : lower_(lower), upper_(upper), shift_(shift), paths_(std::move(paths)) {
  for (const LoopPaths& loops : paths_) {
    const std::span points(loops.points);
    for (std::size_t i = 0; i + 1 < loops.loop_starts.size(); ++i)
      overlay_.insert(
          points.subspan(loops.loop_starts[i], loops.loop_starts[i + 1] - loops.loop_starts[i]),
          cdt::closed);
  }
  note_vertices(Level::lower);
  note_vertices(Level::upper);
  refresh();
}

std::optional<Slab> Slab::merged(const Region& lower, const Region& upper, cdt::Point shift,
                                 double contact, unsigned stir) {
  auto paths = meet_exactly(lower, upper, shift, contact, stir);
  if (!paths) return {};
  return Slab(lower, upper, shift, std::move(*paths));
}

std::size_t Slab::loop(cdt::SegmentId s) const {
  const Level level = this->level(s);
  const auto& led = paths_[static_cast<unsigned>(level)].loop_starts;
  const auto& starts = led.empty() ? region(level).loop_starts : led;
  const auto behind = std::ranges::upper_bound(starts, s.index() - first_segment(level));
  return static_cast<std::size_t>(behind - starts.begin() - 1);
}

Vec3 Slab::place(cdt::VertexId v, double z) const {
  const double share = (z - lower_.z) / height();
  const cdt::Point p = overlay_.point(v);
  const Vec3 place{p.x - share * shift_.x, p.y - share * shift_.y, z};
  assert(std::ranges::all_of(place, [](double x) { return std::isfinite(x); }));
  return place;
}

bool Slab::is_exact() const {
  if (!overlay_.snaps().empty()) return false;
  std::vector<std::uint8_t> passing(overlay_.vertex_bound());  // segments through each vertex
  for (std::uint32_t i = 0; i < overlay_.edge_bound(); ++i) {
    const cdt::EdgeId e(i);
    for (const cdt::Passage passage : overlay_.passages(e)) {
      const cdt::Segment& segment = overlay_.segment(passage.segment());
      const cdt::VertexId v = overlay_.to(e);
      if (!overlay_.is_forward(e, passage) || v == segment.to) continue;
      if (is_vertex(v, level(passage.segment()))) return false;
      const bool is_crossing = !is_vertex(v, other(level(passage.segment())));
      if (is_crossing && ++passing[v.index()] > 2) return false;
      if (!is_crossing && cdt::orient(overlay_.point(segment.from), overlay_.point(segment.to),
                                      overlay_.point(v)) != 0)
        return false;
    }
  }
  return true;
}

bool Slab::is_oriented() const {
  const auto has = [](Side side, Level level) {
    return (static_cast<unsigned>(side) &
            static_cast<unsigned>(level == Level::lower ? Side::lower : Side::upper)) != 0;
  };
  for (std::uint32_t i = 0; i < overlay_.edge_bound(); ++i) {
    const cdt::EdgeId e(i);
    for (const cdt::Passage passage : overlay_.passages(e))
      if (overlay_.is_forward(e, passage) && !has(side(e), level(passage.segment()))) return false;
  }
  return true;
}

bool Slab::is_tight(double height) const {
  for (std::uint32_t i = 1; i < overlay_.vertex_bound(); ++i) {
    const cdt::VertexId v(i);
    if (is_vertex(v, Level::lower) || is_vertex(v, Level::upper) || !overlay_.is_vertex(v))
      continue;
    const cdt::EdgeId first = overlay_.edge(v);
    cdt::EdgeId e = first;
    do {
      if (!overlay_.is_infinite(cdt::Triangulation::triangle(e)) && is_lower(e, height))
        return true;
      e = overlay_.rotated(e);
    } while (e != first);
  }
  return false;
}

/// Whether the triangle left of an edge is lower than `height`.
bool Slab::is_lower(cdt::EdgeId e, double height) const {
  const cdt::Point a = overlay_.point(overlay_.from(e));
  const cdt::Point b = overlay_.point(overlay_.to(e));
  const cdt::Point c = overlay_.point(overlay_.apex(e));
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const double longest =
      std::max({std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - b.x, c.y - b.y),
                std::hypot(a.x - c.x, a.y - c.y)});
  return area < height * longest;
}

void Slab::note_vertices(Level level) {
  const auto& loop_vertices = region(level).loop_vertices;
  auto& indices = level == Level::lower ? lower_index_ : upper_index_;
  indices.assign(overlay_.vertex_bound(), Origin::none);
  for (std::uint32_t i = 0; i < loop_vertices.size(); ++i)
    indices[overlay_.segment(segments(level, i)[0]).from.index()] = loop_vertices[i];
}

void Slab::refresh() {
  sides_ = cdt::flood(overlay_, Side::none, [&](cdt::EdgeId e, Side side) {
    auto bits = static_cast<unsigned>(side);
    for (const cdt::Passage passage : overlay_.passages(e))
      bits ^= static_cast<unsigned>(level(passage.segment()) == Level::lower ? Side::lower
                                                                             : Side::upper);
    return static_cast<Side>(bits);
  });
}

bool Slab::is_contour(cdt::EdgeId e, Level wanted) const {
  return std::ranges::any_of(overlay_.passages(e), [&](cdt::Passage passage) {
    return level(passage.segment()) == wanted;
  });
}

std::optional<cdt::VertexId> Slab::split(cdt::EdgeId e, cdt::Point point) {
  return overlay_.split(e, point);
}

std::optional<cdt::VertexId> Slab::split(cdt::TriangleId t, cdt::Point point) {
  return overlay_.split(t, point);
}

}  // namespace loft
