// SPDX-License-Identifier: MIT
// The value at a place.
#include <algorithm>
#include <cmath>

#include "cdt/predicates.h"
#include "fields/along.h"
#include "fields/field_parts.h"
#include "fields/if_any.h"
#include "fields/patch.h"

namespace loft::fields {

using cdt::Location;

namespace {

/// The edge of the hull that an infinite triangle is beyond.
EdgeId hull_edge(const Triangulation& mesh, EdgeId e) {
  while (mesh.apex(e) != Triangulation::infinite) e = Triangulation::next(e);
  return e;
}
EdgeId next_on_hull(const Triangulation& mesh, EdgeId e) {
  return Triangulation::next(mesh.twin(Triangulation::next(e)));
}
EdgeId previous_on_hull(const Triangulation& mesh, EdgeId e) {
  return Triangulation::prev(mesh.twin(Triangulation::prev(e)));
}

/// The place on an edge that is nearest to a point.
Point nearest_on(const Triangulation& mesh, EdgeId e, Point p) {
  const Point a = mesh.point(mesh.from(e));
  const Point b = mesh.point(mesh.to(e));
  const Vector along = way(a, b);
  const double t = dot(way(a, p), along) / dot(along, along);
  if (!(t > 0)) return a;
  if (t >= 1) return b;
  return {a.x + t * along.x, a.y + t * along.y};
}

/// The edge of the hull that is nearest to a point beyond it, from one that is seen from there: the
/// nearest is seen, too, and of those that are, none is further than both of its neighbours.
EdgeId nearest_hull_edge(const Triangulation& mesh, EdgeId e, Point p) {
  const auto distance = [&](EdgeId edge) {
    const Vector d = way(p, nearest_on(mesh, edge, p));
    return dot(d, d);
  };
  const auto is_nearer = [&](EdgeId beside) {
    return cdt::orient(mesh.point(mesh.from(beside)), mesh.point(mesh.to(beside)), p) >= 0 &&
           distance(beside) < distance(e);
  };
  for (const auto step : {next_on_hull, previous_on_hull})
    for (EdgeId beside = step(mesh, e); is_nearer(beside); beside = step(mesh, e)) e = beside;
  return e;
}

}  // namespace

std::optional<double> Field::value(Point p, Smoothness smoothness, Side side,
                                   Outside outside) const {
  const Location place = mesh_.locate(p);
  switch (place.kind) {
    case Location::Kind::vertex:
      return if_any(corner_value(corner_at(place.edge, side)));
    case Location::Kind::edge:
      return if_any(edge_value(seen_from(place.edge, side), p, smoothness));
    case Location::Kind::triangle: {
      const Patch patch(*this, Triangulation::triangle(place.edge), smoothness);
      return patch.has_values() ? std::optional(patch.value(p)) : std::nullopt;
    }
    case Location::Kind::outside:
      if (outside == Outside::nothing) return std::nullopt;
      return value_beyond(place.edge, p, smoothness, side);
    case Location::Kind::nowhere:
      break;
  }
  return lone_value(p, outside);
}

std::optional<Vector> Field::gradient(Point p, Smoothness smoothness, Side side) const {
  const Location place = mesh_.locate(p);
  EdgeId e = place.edge;
  if (place.kind == Location::Kind::vertex) {
    e = corner_at(e, side);
    if (!is_infinite(e) && smoothness == Smoothness::cubic) {
      const double here = corner_value(e);
      return here == here ? std::optional(corner_gradient(e)) : std::nullopt;
    }
  } else if (place.kind == Location::Kind::edge) {
    e = seen_from(e, side);
  } else if (place.kind != Location::Kind::triangle) {
    return std::nullopt;
  }
  if (is_infinite(e)) return std::nullopt;
  const Patch patch(*this, Triangulation::triangle(e), smoothness);
  return patch.has_values() ? std::optional(patch.gradient(p)) : std::nullopt;
}

EdgeId Field::seen_from(EdgeId e, Side side) const {
  const EdgeId twin = mesh_.twin(e);
  if (is_infinite(e) != is_infinite(twin)) return is_infinite(e) ? twin : e;
  bool is_forward = mesh_.point(mesh_.from(e)) < mesh_.point(mesh_.to(e));
  (void)first_separator(e, is_forward);
  return is_forward == (side == Side::left) ? e : twin;
}

/// The corner at the vertex that e starts from, on that side of the wall or barrier there: the one
/// that was inserted first, best where it leaves, where it does so twice on the way that comes
/// first.
EdgeId Field::corner_at(EdgeId e, Side side) const {
  EdgeId best;
  EdgeId inside = e;
  const Values* first = nullptr;
  bool best_is_forward = false;
  const auto is_better = [&](EdgeId here, const Values& line, bool is_forward) {
    if (best.is_none() || line.order != first->order)
      return best.is_none() || line.order < first->order;
    if (is_forward != best_is_forward) return is_forward;
    return mesh_.point(mesh_.to(here)) < mesh_.point(mesh_.to(best));
  };
  EdgeId here = e;
  do {
    bool is_forward = false;
    const std::optional<cdt::Passage> passage = first_separator(here, is_forward);
    const Values* line = passage ? line_along(*passage) : nullptr;
    if (!is_infinite(here)) inside = here;
    if (line != nullptr && is_better(here, *line, is_forward)) {
      first = line;
      best = here;
      best_is_forward = is_forward;
    }
    here = mesh_.rotated(here);
  } while (here != e);
  if (best.is_none()) return inside;
  const EdgeId left = best;  // in the triangle on the left of best
  const EdgeId right = Triangulation::next(mesh_.twin(best));
  const EdgeId chosen = best_is_forward == (side == Side::left) ? left : right;
  if (!is_infinite(chosen)) return chosen;
  const EdgeId other = chosen == left ? right : left;
  return is_infinite(other) ? chosen : other;
}

/// Of the walls and barriers along an edge, the one that was inserted first; and whether it runs in
/// the edge's direction.
std::optional<cdt::Passage> Field::first_separator(EdgeId e, bool& is_forward) const {
  std::optional<cdt::Passage> first;
  const Values* line = nullptr;
  for (const cdt::Passage passage : mesh_.passages(e)) {
    const Values* other = line_along(passage);
    if (other == nullptr || !separates(other->kind)) continue;
    // A line that runs there twice: upwards.
    const bool is_other_way = other == line && passage.is_upward();
    if (line != nullptr && line->order <= other->order && !is_other_way) continue;
    line = other;
    first = passage;
    is_forward = mesh_.is_forward(e, passage);
  }
  return first;
}

const Field::Values* Field::line_along(cdt::Passage passage) const {
  const std::uint32_t c = mesh_.segment(passage.segment()).constraint.index();
  return c < lines_.size() ? lines_[c].get() : nullptr;
}

double Field::edge_value(EdgeId e, Point p, Smoothness smoothness) const {
  const EdgeId end = Triangulation::next(e);
  const Along along(mesh_.point(mesh_.from(e)), mesh_.point(mesh_.to(e)));
  double start_value = corner_value(e);
  double end_value = corner_value(end);
  if (start_value != start_value || end_value != end_value || smoothness == Smoothness::linear ||
      is_infinite(e))
    return along.between(start_value, end_value, p);

  const EdgeId twin = mesh_.twin(e);
  const Vector edge = way(mesh_.point(mesh_.from(e)), mesh_.point(mesh_.to(e)));
  Vector start = corner_gradient(e);
  Vector stop = corner_gradient(end);
  if (is_crease(e) && !is_separating(e)) {
    start = 0.5 * (start + corner_gradient(Triangulation::next(twin)));
    stop = 0.5 * (stop + corner_gradient(twin));
  }
  double start_slope = dot(start, edge);
  double end_slope = dot(stop, edge);
  if (along.is_turned()) {
    std::swap(start_value, end_value);
    std::swap(start_slope, end_slope);
    start_slope = -start_slope;
    end_slope = -end_slope;
  }
  const double t = along.part(p);
  const double s = 1 - t;
  return s * s * (start_value + t * (2 * start_value + start_slope)) +
         t * t * (end_value + s * (2 * end_value - end_slope));
}

std::optional<double> Field::value_beyond(EdgeId e, Point p, Smoothness smoothness,
                                          Side side) const {
  e = nearest_hull_edge(mesh_, hull_edge(mesh_, e), p);
  const Point place = nearest_on(mesh_, e, p);
  for (const EdgeId end : {e, Triangulation::next(e)})
    if (mesh_.point(mesh_.from(end)) == place) return if_any(corner_value(corner_at(end, side)));
  return if_any(edge_value(seen_from(e, side), place, smoothness));
}

/// Where there is no vertex but one.
std::optional<double> Field::lone_value(Point p, Outside outside) const {
  for (std::uint32_t v = 1; v < mesh_.vertex_bound(); ++v)
    if (mesh_.is_vertex(VertexId(v)) &&
        (outside == Outside::nearest || mesh_.point(VertexId(v)) == p))
      return if_any(lone_value_);
  return std::nullopt;
}

}  // namespace loft::fields
