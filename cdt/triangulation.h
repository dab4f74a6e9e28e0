// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cdt/ids.h"
#include "cdt/passages.h"
#include "cdt/point.h"

namespace loft::cdt {

/// Whether a polyline's last point is joined to its first.
enum class Ends { open, closed };
inline constexpr Ends open = Ends::open;
inline constexpr Ends closed = Ends::closed;

/// Where a point is in a triangulation.
struct Location {
  enum class Kind {
    vertex,    ///< on the vertex `edge` starts from
    edge,      ///< inside `edge`
    triangle,  ///< inside the triangle left of `edge`
    outside,   ///< beyond the hull: the triangle left of `edge` is infinite
    nowhere,   ///< there are fewer than two vertices
  };
  Kind kind = Kind::nowhere;
  EdgeId edge;
};

/// A segment as it was inserted: the straight line between two consecutive points of a constraint.
struct Segment {
  VertexId from;
  VertexId to;  ///< equal to `from` where a point was given twice in a row
  ConstraintId constraint;
};

/// A constrained Delaunay triangulation (CDT) of the plane that grows by points and polylines,
/// after Kallmann, Bieri and Thalmann, "Fully Dynamic Constrained Delaunay Triangulations" (2003).
///
/// Constraints may cross, overlap and repeat one another and themselves: crossings become
/// vertices, overlaps share edges, and every edge knows the segments that run along it.
///
/// Guarantees. All decisions are exact. Every triangle is counter-clockwise; every edge without
/// passage is constrained Delaunay, ties broken by the coordinates alone (in_circle_perturbed).
/// Crossing points are computed from the two segments as inserted and correctly rounded. Where
/// rounding would turn a triangle over, the later segment goes through a vertex nearby instead:
/// snaps() counts that. It never fails and never hangs.
///
/// Structure. Triangles beyond the convex hull share one infinite vertex, so that every edge has a
/// triangle on each side and no bounding box is needed. An oriented edge is 3 * triangle + corner;
/// all adjacency is arithmetic on one flat array. Ids stay valid as long as nothing is inserted;
/// vertex, segment and constraint ids stay valid always.
class Triangulation {
 public:
  /// The vertex at infinity.
  static constexpr VertexId infinite{0};

  /// Beyond it products of four coordinates overflow.
  static constexpr double largest_coordinate = 1e75;

  Triangulation() { clear(); }

  /// Forgets everything, keeps the memory.
  void clear();
  /// Makes room for that many vertices.
  void reserve(std::size_t vertices);

  /// Inserts a polyline, or a single point. Cost: location from the last place, then in practice
  /// constant a vertex and a crossing. Precondition: there is a point, coordinates are at most
  /// largest_coordinate. Throws std::invalid_argument otherwise, and then changes nothing.
  ConstraintId insert(std::span<const Point> points, Ends ends);
  /// Inserts a vertex that belongs to no constraint, or finds the one that is there.
  VertexId insert(Point point);
  /// Splits an edge at a point on it or so close to it that the four new triangles are
  /// counter-clockwise, whatever else is between; nothing happens if they are not.
  /// The two halves keep the edge's passages; edges at the new vertex are not flipped away.
  std::optional<VertexId> split(EdgeId edge, Point point);
  /// Splits a triangle at a point strictly inside; nothing happens if it is not.
  std::optional<VertexId> split(TriangleId triangle, Point point);

  [[nodiscard]] Location locate(Point point) const { return locate(point, last_); }
  /// Walks from the triangle of `hint`. Cost: in the number of triangles between.
  [[nodiscard]] Location locate(Point point, EdgeId hint) const;

  // Traversal. All in constant time.
  [[nodiscard]] static constexpr EdgeId next(EdgeId e) {
    return EdgeId(e.index() % 3 == 2 ? e.index() - 2 : e.index() + 1);
  }
  [[nodiscard]] static constexpr EdgeId prev(EdgeId e) {
    return EdgeId(e.index() % 3 == 0 ? e.index() + 2 : e.index() - 1);
  }
  [[nodiscard]] static constexpr TriangleId triangle(EdgeId e) { return TriangleId(e.index() / 3); }
  [[nodiscard]] static constexpr EdgeId edge(TriangleId t, unsigned corner = 0) {
    return EdgeId(3 * t.index() + corner);
  }
  [[nodiscard]] EdgeId twin(EdgeId e) const { return edges_[e.index()].twin; }
  [[nodiscard]] VertexId from(EdgeId e) const { return edges_[e.index()].from; }
  [[nodiscard]] VertexId to(EdgeId e) const { return from(next(e)); }
  /// The corner opposite to an edge, in the triangle on its left.
  [[nodiscard]] VertexId apex(EdgeId e) const { return from(prev(e)); }
  /// The next edge from the same vertex, counter-clockwise.
  [[nodiscard]] EdgeId rotated(EdgeId e) const { return twin(prev(e)); }
  /// An edge from a vertex; none while there is only one vertex.
  [[nodiscard]] EdgeId edge(VertexId v) const { return vertex_edges_[v.index()]; }
  [[nodiscard]] Point point(VertexId v) const { return points_[v.index()]; }
  [[nodiscard]] bool is_infinite(TriangleId t) const {
    const auto e = 3 * t.index();
    return edges_[e].from == infinite || edges_[e + 1].from == infinite ||
           edges_[e + 2].from == infinite;
  }

  /// Vertices have the ids 1 ... vertex_count(); 0 is the infinite one.
  [[nodiscard]] std::size_t vertex_count() const { return points_.size() - 1; }
  /// Triangles, infinite ones included, have the ids 0 ... triangle_count() - 1.
  [[nodiscard]] std::size_t triangle_count() const { return edges_.size() / 3; }
  [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }

  /// The edge between two vertices, if there is one. Cost: the smaller degree.
  [[nodiscard]] std::optional<EdgeId> find_edge(VertexId a, VertexId b) const;

  // Constraints.
  [[nodiscard]] bool is_constrained(EdgeId e) const { return !edges_[e.index()].set.is_empty(); }
  /// The segments along an edge, with direction. Valid until the next insertion.
  [[nodiscard]] std::span<const Passage> passages(EdgeId e) const {
    return sets_.view(edges_[e.index()].set);
  }
  /// Whether a passage of this edge runs from from(e) to to(e).
  [[nodiscard]] bool is_forward(EdgeId e, Passage passage) const {
    return passage.is_upward() == is_upward(e);
  }
  [[nodiscard]] std::size_t constraint_count() const { return constraints_.size(); }
  [[nodiscard]] std::size_t segment_count() const { return segments_.size(); }
  [[nodiscard]] const Segment& segment(SegmentId s) const { return segments_[s.index()]; }
  /// The segments of a constraint, in order: segment i starts at the vertex of point i.
  [[nodiscard]] std::span<const Segment> segments(ConstraintId c) const;
  [[nodiscard]] SegmentId first_segment(ConstraintId c) const;
  /// The edges that make up a segment, in order and direction.
  [[nodiscard]] std::vector<EdgeId> pieces(SegmentId s) const;
  /// The vertex where a constraint starts.
  [[nodiscard]] VertexId first_vertex(ConstraintId c) const {
    return constraints_[c.index()].first_vertex;
  }
  /// How often rounding led a segment through a vertex that is not on it.
  [[nodiscard]] std::size_t snaps() const { return snaps_; }

 private:
  struct OrientedEdge {
    VertexId from;
    EdgeId twin;
    PassageSet set;  // the same on both sides
  };
  struct Constraint {
    VertexId first_vertex;
    std::uint32_t first_segment;
    std::uint32_t segment_count;
  };
  /// What a walk along a straight line came to first.
  struct Obstacle {
    enum class Kind { edge_along, constrained_edge, vertex } kind;
    EdgeId edge;      // edge_along, constrained_edge
    VertexId vertex;  // vertex: reached over the edges in crossed_
  };
  /// A side of the cavity that a new segment cuts: the edge from chain vertex i to i + 1.
  struct Gap {
    EdgeId outer;        // beyond it, or none where the cavity is on both sides
    std::uint32_t mate;  // then: the gap on the other side
    EdgeId inner;        // then: the new edge here, once it is made
    PassageSet set;
  };
  struct Cavity {
    std::vector<VertexId> chain;
    std::vector<Gap> gaps;
    bool has_mates = false;
  };

  [[nodiscard]] bool is_upward(EdgeId e) const { return point(from(e)) < point(to(e)); }
  [[nodiscard]] TriangleId new_triangle();
  [[nodiscard]] VertexId new_vertex(Point point);
  void set_edge(EdgeId e, VertexId from) { edges_[e.index()].from = from; }
  void link(EdgeId a, EdgeId b, PassageSet set);
  void link(EdgeId a, EdgeId b) { link(a, b, {}); }

  // triangulation.cpp: vertices
  void insert_points(std::span<const Point> points);
  VertexId insert_near(Point point, EdgeId hint);
  std::pair<EdgeId, EdgeId> add_flat_edge(VertexId a, VertexId b);
  void start(VertexId a, VertexId b);
  void extend(EdgeId end_to_infinity, VertexId v);
  void split_triangle(TriangleId t, VertexId v);
  void split_edge(EdgeId e, VertexId v);
  void fan_out(VertexId v);
  [[nodiscard]] bool can_split(EdgeId e, Point point) const;
  [[nodiscard]] bool should_flip(VertexId a, VertexId b, VertexId c, VertexId d) const;
  void flip(EdgeId e);
  void restore_delaunay();
  void push_star(VertexId v);

  // locate.cpp
  [[nodiscard]] Location locate_flat(Point point, EdgeId hint) const;
  [[nodiscard]] Location settle(Point point, EdgeId e) const;

  // constrain.cpp: segments
  void constrain(SegmentId s);
  [[nodiscard]] Obstacle walk(VertexId from, VertexId to);
  [[nodiscard]] EdgeId first_crossed(VertexId from, VertexId to, Obstacle& obstacle) const;
  [[nodiscard]] VertexId cross(EdgeId e, SegmentId s);
  [[nodiscard]] std::optional<Point> crossing_point(EdgeId e, SegmentId s) const;
  [[nodiscard]] VertexId snap(EdgeId e, Point place);
  void reroute(EdgeId e, VertexId through);
  void mark(EdgeId e, SegmentId s);
  void follow_corridor(VertexId from, VertexId to, SegmentId s);
  EdgeId force_edge(VertexId from, VertexId to);
  void gather_cavity();
  void add_gap(Cavity& cavity, EdgeId inside, VertexId end);
  void match_gaps();
  [[nodiscard]] EdgeId fill(Cavity& cavity, std::uint32_t low, std::uint32_t high);
  [[nodiscard]] std::uint32_t choose_tip(const Cavity& cavity, std::uint32_t low,
                                         std::uint32_t high) const;
  [[nodiscard]] bool opens_towards(const Cavity& cavity, std::uint32_t tip, VertexId low,
                                   VertexId high) const;
  void close(Cavity& cavity, std::uint32_t gap, EdgeId inside);

  std::vector<OrientedEdge> edges_;
  std::vector<Point> points_;
  std::vector<EdgeId> vertex_edges_;
  std::vector<Constraint> constraints_;
  std::vector<Segment> segments_;
  PassageSets sets_;
  EdgeId last_;
  bool is_flat_ = true;  // no finite triangle yet: all vertices in one line
  std::size_t snaps_ = 0;

  // Scratch memory of single operations, kept to spare allocations.
  std::vector<VertexId> inserted_;
  std::vector<EdgeId> suspects_;
  std::vector<EdgeId> crossed_;
  std::vector<VertexId> goals_;
  std::vector<TriangleId> spare_;
  Cavity left_;
  Cavity right_;
};

}  // namespace loft::cdt
