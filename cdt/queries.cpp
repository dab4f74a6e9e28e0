// SPDX-License-Identifier: MIT
#include "cdt/queries.h"

#include <limits>
#include <utility>

#include "cdt/disc.h"
#include "cdt/predicates.h"

namespace loft::cdt {

VertexId nearest_vertex(const Triangulation& mesh, Point p) {
  const Location place = mesh.locate(p);
  if (place.kind == Location::Kind::vertex) return mesh.from(place.edge);
  VertexId nearest;
  if (place.kind == Location::Kind::nowhere) {
    for (std::uint32_t v = 1; v < mesh.vertex_bound(); ++v)
      if (mesh.is_vertex(VertexId(v))) nearest = VertexId(v);
    return nearest;
  }
  double radius = std::numeric_limits<double>::infinity();
  const auto consider = [&](VertexId v) {
    if (v == Triangulation::infinite) return;
    if (!nearest.is_none()) {
      const int order = compare_distances(p, mesh.point(v), mesh.point(nearest));
      if (order > 0 || (order == 0 && !(mesh.point(v) < mesh.point(nearest)))) return;
    }
    nearest = v;
    radius = distance(p, mesh.point(v)) * (1 + 8 * detail::rounding);
  };
  const EdgeId e = place.edge;
  for (const EdgeId corner : {e, Triangulation::next(e), Triangulation::prev(e)})
    consider(mesh.from(corner));
  visit_disc(
      mesh, place, p, [&] { return radius; },
      [&](TriangleId t) {
        for (unsigned corner = 0; corner < 3; ++corner)
          consider(mesh.from(Triangulation::edge(t, corner)));
      });
  return nearest;
}

Box bounding_box(const Triangulation& mesh) {
  Box box;
  for (std::uint32_t v = 1; v < mesh.vertex_bound(); ++v)
    if (mesh.is_vertex(VertexId(v))) box.add(mesh.point(VertexId(v)));
  return box;
}

namespace {

/// Follows a segment from triangle to triangle.
class Passer {
 public:
  Passer(const Triangulation& mesh, Point a, Point b) : mesh_(mesh), a_(a), b_(b) {}

  Way run() {
    if (a_ == b_) return {};
    const Location place = mesh_.locate(a_);
    switch (place.kind) {
      case Location::Kind::nowhere:
        break;
      case Location::Kind::vertex:
        start_at(place.edge);
        break;
      case Location::Kind::edge:
        leave_edge(place.edge);
        break;
      case Location::Kind::triangle:
        leave_triangle(place.edge);
        break;
      case Location::Kind::outside:
        enter_hull(place.edge);
        break;
    }
    while (!at_.is_none()) leave_vertex(std::exchange(at_, EdgeId::none()));
    return std::move(way_);
  }

 private:
  [[nodiscard]] int side(VertexId v) const { return orient(a_, b_, mesh_.point(v)); }
  /// Whether a vertex on the line is not behind a place on it.
  [[nodiscard]] bool is_ahead(VertexId v, Point place) const {
    return (a_ < b_) == (place < mesh_.point(v)) && mesh_.point(v) != place;
  }
  [[nodiscard]] bool is_beyond_end(Point place) const {
    return place == b_ || (a_ < b_) == (b_ < place);
  }

  void pass(TriangleId t) {
    way_.parts.push_back({.triangle = t, .along = {}, .exit = {}, .end = {}});
  }
  void start_at(EdgeId e) {
    at_ = e;
    way_.start = mesh_.from(e);
  }
  /// The last part comes to the vertex that e starts from.
  void come_to(EdgeId e) {
    const VertexId v = mesh_.from(e);
    if (!is_past_end(mesh_.point(v))) way_.parts.back().end = v;
    if (!is_beyond_end(mesh_.point(v))) at_ = e;
  }
  [[nodiscard]] bool is_past_end(Point place) const { return place != b_ && is_beyond_end(place); }

  /// Whether b is before or on e, which the line crosses out of the triangle on its left.
  [[nodiscard]] bool ends_before(EdgeId e) const {
    return orient(mesh_.point(mesh_.from(e)), mesh_.point(mesh_.to(e)), b_) >= 0;
  }

  /// From a point strictly inside a triangle.
  void leave_triangle(EdgeId e) {
    pass(Triangulation::triangle(e));
    for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e)) {
      const int from = side(mesh_.from(e));
      const int to = side(mesh_.to(e));
      if (from < 0 && to > 0) {  // the edge that the line leaves through
        if (!ends_before(e)) cross(e);
        return;
      }
      if (from == 0 && is_ahead(mesh_.from(e), a_)) {
        come_to(e);
        return;
      }
    }
  }

  /// From a point strictly inside an edge.
  void leave_edge(EdgeId e) {
    const int to = side(mesh_.to(e));
    if (to == 0) {
      if (!is_ahead(mesh_.to(e), a_)) e = mesh_.twin(e);
      run_along(e);
      return;
    }
    cross(to > 0 ? e : mesh_.twin(e));
  }

  void run_along(EdgeId e) {
    way_.parts.push_back({.triangle = {}, .along = e, .exit = {}, .end = {}});
    come_to(mesh_.twin(e));
  }

  /// Over an edge from its left to its right, where from(e) is right of the line, and on.
  void cross(EdgeId e) {
    for (;;) {
      if (!way_.parts.empty()) way_.parts.back().exit = e;
      const EdgeId f = mesh_.twin(e);
      const VertexId ahead = mesh_.apex(f);
      if (ahead == Triangulation::infinite) return;
      pass(Triangulation::triangle(f));
      const int beside = side(ahead);
      if (beside == 0) {
        come_to(Triangulation::prev(f));
        return;
      }
      e = beside > 0 ? Triangulation::next(f) : Triangulation::prev(f);
      if (ends_before(e)) return;
    }
  }

  /// From the vertex that e starts from, which is on the line.
  void leave_vertex(EdgeId first) {
    const Point place = mesh_.point(mesh_.from(first));
    EdgeId e = first;
    do {
      const VertexId right = mesh_.to(e);
      const VertexId left = mesh_.apex(e);
      if (right != Triangulation::infinite && side(right) == 0 && is_ahead(right, place)) {
        run_along(e);
        return;
      }
      if (right != Triangulation::infinite && left != Triangulation::infinite && side(right) < 0 &&
          side(left) > 0) {
        pass(Triangulation::triangle(e));
        if (!ends_before(Triangulation::next(e))) cross(Triangulation::next(e));
        return;
      }
      e = mesh_.rotated(e);
    } while (e != first);
  }

  /// From a point beyond the hull: around it to where the line comes in.
  void enter_hull(EdgeId e) {
    while (mesh_.apex(e) != Triangulation::infinite) e = Triangulation::next(e);
    const EdgeId first = e;
    EdgeId best;
    do {
      // The hull edge that the line enters through has the start strictly on its outside.
      const Point p = mesh_.point(mesh_.from(e));
      const Point q = mesh_.point(mesh_.to(e));
      if (orient(p, q, a_) > 0 && side(mesh_.from(e)) <= 0 && side(mesh_.to(e)) >= 0 &&
          orient(p, q, b_) < 0) {
        best = e;
        break;
      }
      e = Triangulation::next(mesh_.twin(Triangulation::next(e)));
    } while (e != first);
    if (best.is_none()) {
      touch_hull(first);
      return;
    }
    if (side(mesh_.from(best)) == 0) {
      start_at(best);
    } else if (side(mesh_.to(best)) == 0) {
      start_at(mesh_.twin(best));
    } else {
      way_.entry = best;
      cross(best);
    }
  }

  /// A line through a corner of the hull whose edges it does not cross, or along the hull.
  void touch_hull(EdgeId first) {
    EdgeId e = first;
    do {
      const VertexId v = mesh_.from(e);
      if (side(v) == 0 && is_ahead(v, a_) && !is_beyond_end(mesh_.point(v))) {
        start_at(e);
        return;
      }
      e = Triangulation::next(mesh_.twin(Triangulation::next(e)));
    } while (e != first);
  }

  const Triangulation& mesh_;
  Point a_;
  Point b_;
  EdgeId at_;  // from a vertex on the line, where the segment has not ended yet
  Way way_;
};

}  // namespace

Way passed_by(const Triangulation& mesh, Point a, Point b) { return Passer(mesh, a, b).run(); }

std::vector<TriangleId> crossed_triangles(const Triangulation& mesh, Point a, Point b) {
  std::vector<TriangleId> crossed;
  for (const WayPart& part : passed_by(mesh, a, b).parts)
    if (!part.triangle.is_none()) crossed.push_back(part.triangle);
  return crossed;
}

}  // namespace loft::cdt
