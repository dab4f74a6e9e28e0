// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cdt/changes.h"
#include "cdt/ids.h"
#include "cdt/locator.h"
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

/// Points to insert as one constraint. A view: the points belong to someone else.
struct Polyline {
  std::span<const Point> points;
  Ends ends = open;
};

/// Where rounding decides: a segment that goes through a vertex although none of its points rounds
/// to that, because its way, being rounded, is on the wrong side of it.
struct Snap {
  SegmentId segment;
  Point place;
};

/// A fully dynamic constrained Delaunay triangulation (CDT) of the plane after Kallmann, Bieri and
/// Thalmann, "Fully Dynamic Constrained Delaunay Triangulations" (2003), here KBT: points and
/// polylines are inserted, moved and removed at any time and go by their ids.
///
/// Constraints may cross, overlap and repeat one another and themselves: crossings become
/// vertices, overlaps share edges, and every edge knows the segments that run along it. What is
/// removed leaves no trace: vertices that nothing needs any more go with it, and edges that were
/// split by them are whole again.
///
/// Guarantees. All decisions are exact. Every triangle is counter-clockwise; every edge without
/// passage is constrained Delaunay, ties broken by the coordinates alone (in_circle_perturbed).
/// Crossing points are computed from the two segments as inserted and correctly rounded, and a
/// segment leads through the vertices that one of its points rounds to (predicates.h, rounds_to):
/// snap rounding. So the triangulation is a function of the set of constraints, whatever the order
/// in which they came, moved and went, and every vertex on a segment's way is within half a unit in
/// the last place of it. Where doubles are much closer to each other than where the segment was
/// rounded, near 0, it may have to lead through others between it and its rounded way: snaps()
/// lists these places, where the result may depend on the order. No vertex on the way is further
/// from the segment than 2^-50 of its largest coordinate; check() tests that. It never fails and
/// never hangs.
///
/// Epsilon. With an epsilon above zero, a point no further than that from a vertex is that vertex,
/// one no further than that from a segment is on it, and a segment passing a vertex no further than
/// that goes through it. What is merged depends on the order of insertion, as closeness is not
/// transitive.
///
/// Structure. Triangles beyond the convex hull share one infinite vertex, so that every edge has a
/// triangle on each side and no bounding box is needed. An oriented edge is 3 * triangle + corner;
/// all adjacency is arithmetic on one flat array. Ids of vertices, segments and constraints stay
/// valid until what they name is removed, those of edges and triangles until the next edit. Ids of
/// removed things are used again: loops over ids go up to a bound and ask what is there.
///
/// Not for several threads at once, except for reading. Copies are independent; what has been moved
/// from can be cleared, assigned to and destroyed.
class Triangulation {
 public:
  /// The vertex at infinity.
  static constexpr VertexId infinite{0};

  /// Beyond it products of four coordinates overflow.
  static constexpr double largest_coordinate = 1e75;
  /// Below it, but for 0, what is left of products of four differences underflows.
  static constexpr double smallest_coordinate = 1e-50;
  /// Whether exact arithmetic is exact for a coordinate: 0, or between these two in magnitude.
  [[nodiscard]] static constexpr bool is_usable(double coordinate) {
    const double size = coordinate < 0 ? -coordinate : coordinate;
    return size <= largest_coordinate && (size >= smallest_coordinate || size == 0);
  }
  [[nodiscard]] static constexpr bool is_usable(Point point) {
    return is_usable(point.x) && is_usable(point.y);
  }

  Triangulation() { clear(); }
  /// Precondition: epsilon is finite and not negative; std::invalid_argument otherwise.
  explicit Triangulation(double epsilon);

  [[nodiscard]] double epsilon() const { return epsilon_; }

  /// Forgets everything but epsilon, keeps the memory.
  void clear();
  /// Makes room for that many vertices.
  void reserve(std::size_t vertices);

  // Edits. Each throws std::invalid_argument, and then changes nothing, if there is no point, if a
  // coordinate is not usable, or if an id names nothing. (Beyond 2^31 edges, 2^30 segments or the
  // memory there is, std::length_error or std::bad_alloc leave it fit for clear() only.)

  /// Inserts a polyline, or a single point. Cost: to locate the first point, O(1) expected where
  /// points are spread evenly; then in practice constant a point and a crossing.
  ConstraintId insert(std::span<const Point> points, Ends ends);
  /// Inserts many at once: the same as one after the other, but faster, as all points come first,
  /// in rounds and along a space-filling curve (Amenta, Choi, Rote 2003). Returns their ids.
  std::vector<ConstraintId> insert(std::span<const Polyline> polylines);
  /// Removes a constraint (KBT, section 5): vertices that nothing else needs go, edges that they
  /// split become one. Cost: in practice constant a vertex and a crossing.
  void remove(ConstraintId id);
  /// Gives a constraint other points, as many as it likes. Vertices whose triangles stay
  /// counter-clockwise on the way are moved in place and flips restore the triangulation; others
  /// are removed and inserted. The same as remove and insert, but the id stays.
  void move(ConstraintId id, std::span<const Point> points);
  /// Moves all points of a constraint by the same vector.
  void translate(ConstraintId id, Point by);
  /// Inserts a vertex that belongs to no constraint, or finds the one that is there.
  VertexId insert(Point point);
  /// Undoes one insert(Point) or split(): the vertex goes if nothing else needs it. Also throws if
  /// all that is there are points of constraints. Cost: the points of the constraints there.
  void remove(VertexId v);
  /// Removes constraints, each named once, and undoes one insert(Point) or split() at each of some
  /// vertices. The same as one after the other, but in one edit, and faster, as what they have in
  /// common goes at once.
  void remove(std::span<const ConstraintId> ids, std::span<const VertexId> vertices);
  /// Splits an edge at a point on it or so close to it that the four new triangles are
  /// counter-clockwise, whatever else is between; nothing happens if they are not, or if the edge
  /// has nothing but infinity on both sides and the point is not strictly between its ends.
  /// The two halves keep the edge's passages; where that bends segments, snaps() has them.
  std::optional<VertexId> split(EdgeId edge, Point point);
  /// Splits a triangle at a point strictly inside; nothing happens if it is not.
  std::optional<VertexId> split(TriangleId triangle, Point point);

  /// From now on (or no longer) each edit notes the triangles that it makes and unmakes.
  void record_changes(bool is_on);
  /// From here to end_batch(), edits are one edit as far as changes() is concerned. Until then it
  /// says nothing.
  void begin_batch();
  void end_batch();
  /// Those of the last edit, or batch, that changed something; empty if they were not recorded, and
  /// after clear().
  [[nodiscard]] const Changes& changes() const { return changes_; }

  /// Where a point is; nowhere if it is not finite.
  [[nodiscard]] Location locate(Point point) const { return locate(point, hint_for(point)); }
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
  [[nodiscard]] EdgeId twin(EdgeId e) const { return edges_[e.index()].twin(); }
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

  /// Vertices there are, without the infinite one.
  [[nodiscard]] std::size_t vertex_count() const { return vertex_count_; }
  /// Their ids are above 0, which is the infinite one, and below this.
  [[nodiscard]] std::size_t vertex_bound() const { return points_.size(); }
  [[nodiscard]] bool is_vertex(VertexId v) const {
    return v != infinite && v.index() < uses_.size() && uses_[v.index()] != unused;
  }
  /// Triangles there are, infinite ones included.
  [[nodiscard]] std::size_t triangle_count() const {
    return triangle_bound_ - free_triangles_.size();
  }
  [[nodiscard]] std::size_t triangle_bound() const { return triangle_bound_; }
  [[nodiscard]] bool is_triangle(TriangleId t) const {
    return t.index() < triangle_bound() && !edges_[3 * t.index()].from.is_none();
  }
  [[nodiscard]] std::size_t edge_bound() const { return 3 * triangle_bound_; }

  /// The edge between two vertices, if there is one. Precondition: they are vertices. Cost: the
  /// smaller degree.
  [[nodiscard]] std::optional<EdgeId> find_edge(VertexId a, VertexId b) const;

  // Constraints. Precondition of all: the ids name something.
  [[nodiscard]] bool is_constrained(EdgeId e) const { return edges_[e.index()].is_constrained(); }
  /// The segments along an edge, with direction. Valid until the next edit.
  [[nodiscard]] std::span<const Passage> passages(EdgeId e) const {
    if (!is_constrained(e)) return {};
    return sets_.view(edge_sets_[e.index()]);
  }
  /// Whether a passage of this edge runs from from(e) to to(e).
  [[nodiscard]] bool is_forward(EdgeId e, Passage passage) const {
    return passage.is_upward() == is_upward(e);
  }
  [[nodiscard]] std::size_t constraint_count() const {
    return constraints_.size() - free_constraints_.size();
  }
  [[nodiscard]] std::size_t constraint_bound() const { return constraints_.size(); }
  [[nodiscard]] bool is_constraint(ConstraintId c) const {
    return c.index() < constraints_.size() && !constraints_[c.index()].first_vertex.is_none();
  }
  [[nodiscard]] std::size_t segment_bound() const { return segments_.size(); }
  [[nodiscard]] bool is_segment(SegmentId s) const {
    return s.index() < segments_.size() && !segments_[s.index()].constraint.is_none();
  }
  [[nodiscard]] const Segment& segment(SegmentId s) const { return segments_[s.index()]; }
  /// The segments of a constraint, in order: segment i starts at the vertex of point i.
  [[nodiscard]] std::span<const Segment> segments(ConstraintId c) const;
  [[nodiscard]] SegmentId first_segment(ConstraintId c) const;
  [[nodiscard]] Ends ends(ConstraintId c) const {
    return constraints_[c.index()].is_closed ? closed : open;
  }
  /// The places of a constraint's points: as given, but for those that epsilon merged.
  [[nodiscard]] std::vector<Point> points(ConstraintId c) const;
  /// The edges that make up a segment, in order and direction.
  [[nodiscard]] std::vector<EdgeId> pieces(SegmentId s) const;
  /// The edges that make up a constraint, in order and direction. Cost: their number times the
  /// degrees on the way.
  [[nodiscard]] std::vector<EdgeId> pieces(ConstraintId c) const;
  /// The constraints along an edge: sorted, each once.
  [[nodiscard]] std::vector<ConstraintId> constraints(EdgeId e) const;
  /// The constraints that have a point at a vertex or pass through it: sorted, each once.
  /// Cost: the degree; in a mesh with point constraints, their number.
  [[nodiscard]] std::vector<ConstraintId> constraints(VertexId v) const;
  /// Whether insert(Point) or split() has put a vertex here. Cost: the points of the constraints
  /// here.
  [[nodiscard]] bool has_own_point(VertexId v) const {
    return count_points_at(v) < uses_[v.index()];
  }
  /// The vertex where a constraint starts.
  [[nodiscard]] VertexId first_vertex(ConstraintId c) const {
    return constraints_[c.index()].first_vertex;
  }
  /// The places where rounding decides, as things are now.
  [[nodiscard]] std::span<const Snap> snaps() const { return snaps_; }

 private:
  friend class Persistence;

  /// `bits`: the twin, and in the highest bit whether there are passages.
  struct OrientedEdge {
    static constexpr std::uint32_t constrained = 0x8000'0000;
    VertexId from;
    std::uint32_t bits;

    [[nodiscard]] EdgeId twin() const { return EdgeId(bits & ~constrained); }
    [[nodiscard]] bool is_constrained() const { return (bits & constrained) != 0; }
  };
  /// What is beyond a side of a triangle: its twin, and the passages that both share.
  struct Side {
    std::uint32_t bits;
    PassageSet set;
  };
  struct Constraint {
    VertexId first_vertex;
    std::uint32_t first_segment;
    std::uint32_t segment_count : 31;
    std::uint32_t is_closed : 1;
    ConstraintId next_here;  // of those without length at first_vertex
  };
  /// What a walk along a straight line came to first.
  struct Obstacle {
    enum class Kind { edge_along, constrained_edge, vertex, confusion } kind;
    EdgeId edge;      // edge_along, constrained_edge
    VertexId vertex;  // vertex: reached over the edges in crossed_
  };
  /// A side of a cavity: the edge from chain vertex i to i + 1.
  struct Gap {
    EdgeId inside;           // the edge here in the triangles that were taken out
    Side beyond{};           // what they were joined to
    bool has_mate = false;   // the cavity is on both sides of this edge,
    std::uint32_t mate = 0;  // at this gap, too
    EdgeId inner{};          // then: the new edge here, once it is made
  };
  /// What filling a large cavity needs, kept from one to the next. A copy begins with none.
  struct Workshop;
  class Workshops {
   public:
    Workshops() = default;
    Workshops(const Workshops&) {}
    Workshops(Workshops&&) = default;
    Workshops& operator=(const Workshops&) { return *this; }
    Workshops& operator=(Workshops&&) = default;
    [[nodiscard]] Workshop& get();

   private:
    std::shared_ptr<Workshop> one_;
  };
  struct Cavity {
    std::vector<VertexId> chain;
    std::vector<Gap> gaps;
    bool has_mates = false;
  };
  /// One corner of the hole that a vertex leaves, and how soon its ear is to be cut.
  struct Corner {
    VertexId vertex;
    Side side;  // to the next corner
    std::uint32_t next;
    std::uint32_t prev;
    double urgency;
  };
  struct Ear {
    double urgency;
    std::uint32_t corner;
    friend auto operator<=>(const Ear&, const Ear&) = default;
  };
  /// What may be so of a vertex; noted for as long as there is the vertex.
  enum Trait : std::uint8_t {
    passed = 1,   // a segment that does not end there goes through
    crowded = 2,  // there is another vertex hardly apart
  };
  /// How an edit touched a triangle: what counts is whether it was there before, and whether it is
  /// the same but for where its corners are. As one number, sorted by triangle.
  class Touch {
   public:
    constexpr Touch() = default;
    constexpr Touch(TriangleId t, bool was_there, bool has_only_moved)
        : bits_(t.index() << 2 | (was_there ? 2U : 0U) | (has_only_moved ? 1U : 0U)) {}

    [[nodiscard]] constexpr TriangleId triangle() const { return TriangleId(bits_ >> 2); }
    [[nodiscard]] constexpr bool was_there() const { return (bits_ & 2) != 0; }
    [[nodiscard]] constexpr bool has_only_moved() const { return (bits_ & 1) != 0; }
    constexpr void change() { bits_ &= ~1U; }

    friend constexpr auto operator<=>(Touch, Touch) = default;

   private:
    std::uint32_t bits_ = 0;
  };

  static constexpr std::uint32_t unused = 0xffff'ffff;
  static constexpr std::uint32_t moved = 0x8000'0000;  // in uses_, during a move
  static constexpr std::uint32_t most_planned = 9;     // corners of a small hole

  [[nodiscard]] bool is_upward(EdgeId e) const { return point(from(e)) < point(to(e)); }
  [[nodiscard]] TriangleId new_triangle();
  void grow();
  [[nodiscard]] VertexId new_vertex(Point point);
  void free_triangle(TriangleId t);
  void free_vertex(VertexId v);
  void touch(TriangleId t) {
    if (is_recording_) note(Touch(t, true, false));
  }
  /// Its corners are elsewhere; what else there is to it stays.
  void touch_moved(TriangleId t) {
    if (is_recording_) note(Touch(t, true, true));
  }
  void note(Touch touch);
  void set_from(EdgeId e, VertexId from) { edges_[e.index()].from = from; }
  [[nodiscard]] Side side(EdgeId e) const {
    const std::uint32_t bits = edges_[e.index()].bits;
    return {bits, (bits & OrientedEdge::constrained) != 0 ? edge_sets_[e.index()] : PassageSet()};
  }
  /// The sets grow only as far as there are constrained edges.
  [[nodiscard]] PassageSet& set_at(EdgeId e) {
    if (e.index() >= edge_sets_.size()) grow_sets();
    return edge_sets_[e.index()];
  }
  [[gnu::cold]] void grow_sets();  // so that attach() is small, and inlined
  /// Puts an edge in the place of another that had this side.
  void attach(EdgeId e, Side side) {
    const std::uint32_t flag = side.bits & OrientedEdge::constrained;
    edges_[e.index()].bits = side.bits;
    edges_[side.bits & ~OrientedEdge::constrained].bits = e.index() | flag;
    if (flag != 0) set_at(e) = side.set;
  }
  void join(EdgeId a, EdgeId b) {
    edges_[a.index()].bits = b.index();
    edges_[b.index()].bits = a.index();
  }
  void join(EdgeId a, EdgeId b, PassageSet set);

  // triangulation.cpp: edits
  static void check_usable(std::span<const Point> points);
  void check_known(ConstraintId id) const;
  void begin_edit();
  void end_edit();
  void sort_touched();
  void sum_up_changes();
  [[nodiscard]] ConstraintId new_constraint();
  void describe(ConstraintId id, std::span<const VertexId> vertices, Ends ends);
  void lay_all(ConstraintId id);
  [[nodiscard]] std::uint32_t take_segments(std::uint32_t count);
  void give_segments(std::uint32_t first, std::uint32_t count);
  void free_segments(ConstraintId id);
  [[nodiscard]] std::vector<EdgeId> tangled_pieces(SegmentId s) const;
  [[nodiscard]] bool is_without_length(ConstraintId id) const;
  /// Calls visit(vertex) for each point, in order.
  template <class Visit>
  void for_each_point(ConstraintId id, Visit visit) const {
    const Constraint& constraint = constraints_[id.index()];
    if (constraint.segment_count == 0) visit(constraint.first_vertex);
    const auto all = segments(id);
    for (const Segment& s : all) visit(s.from);
    if (!all.empty() && !constraint.is_closed) visit(all.back().to);
  }

  // vertices.cpp
  void insert_points(std::span<const Point> points);
  void insert_pass(std::span<const Point> points, std::size_t stride);
  [[nodiscard]] std::vector<VertexId> insert_in_rounds(std::span<const Point> points);
  VertexId insert_near(Point point, EdgeId hint);
  [[nodiscard]] VertexId merge(Location& place, Point point) const;
  [[nodiscard]] EdgeId hint_for(Point point) const;
  [[nodiscard]] VertexId split_at(Location place, Point point);
  void doubt_others_on(EdgeId e, Point point);
  [[nodiscard]] bool has_constrained_side(TriangleId t) const {
    const OrientedEdge* sides = &edges_[3 * t.index()];
    return ((sides[0].bits | sides[1].bits | sides[2].bits) & OrientedEdge::constrained) != 0;
  }
  [[nodiscard]] EdgeId led_through(EdgeId inside, Point point) const;
  std::pair<EdgeId, EdgeId> add_flat_edge(VertexId a, VertexId b);
  void start(VertexId a, VertexId b);
  void extend(EdgeId end_to_infinity, VertexId v);
  void split_triangle(TriangleId t, VertexId v);
  void split_edge(EdgeId e, VertexId v);
  [[nodiscard]] bool is_in_both_circles(EdgeId e, Point place) const;
  [[nodiscard]] VertexId split_edge_at(EdgeId e, Point place);
  void fan_out(VertexId v);
  [[nodiscard]] bool is_crowded_by(EdgeId e, Point place) const;
  void flip_away(EdgeId e, VertexId v, VertexId d);
  [[nodiscard]] bool can_split(EdgeId e, Point point) const;
  [[nodiscard]] bool should_flip(VertexId a, VertexId b, VertexId c, VertexId d) const;
  void flip(EdgeId e);
  bool restore_delaunay();
  void push_star(VertexId v);

  // locate.cpp
  [[nodiscard]] Location locate_flat(Point point, EdgeId hint) const;
  [[nodiscard]] Location settle(Point point, EdgeId e) const;

  // constrain.cpp: segments
  void lay(SegmentId s);
  [[nodiscard]] bool lay_straight(SegmentId s);
  [[nodiscard]] VertexId meet(EdgeId e, SegmentId s);
  [[nodiscard]] std::optional<Point> common_crossing(EdgeId e, SegmentId s) const;
  [[nodiscard]] bool misses_something_at(VertexId v, SegmentId s) const;
  [[nodiscard]] bool crosses_elsewhere(SegmentId one, SegmentId other, Point place) const;
  [[nodiscard]] EdgeId connect(VertexId from, VertexId to, SegmentId s);
  [[nodiscard]] Obstacle walk(VertexId from, VertexId to, Point a, Point b,
                              EdgeId back = EdgeId::none());
  [[nodiscard]] EdgeId first_crossed(VertexId from, VertexId to, Point a, Point b,
                                     Obstacle& obstacle) const;
  [[nodiscard]] EdgeId first_crossed_ahead(EdgeId back, VertexId to, Point a, Point b,
                                           Obstacle& obstacle) const;
  [[nodiscard]] bool crosses_at(SegmentId one, SegmentId other, Point place) const;
  [[nodiscard]] EdgeId edge_between(VertexId from, VertexId to) const;
  void lay_crooked(SegmentId s, VertexId at);
  [[nodiscard]] Point nearest_on(EdgeId e, SegmentId s) const;
  [[nodiscard]] VertexId cross(EdgeId e, SegmentId s);
  [[nodiscard]] std::optional<Point> crossing_point(EdgeId e, SegmentId s) const;
  [[nodiscard]] VertexId snap(EdgeId e, Point place, SegmentId s);
  void reroute(EdgeId e, VertexId through);
  void mark(EdgeId e, SegmentId s);
  void note(Trait trait, VertexId v) {
    if (v.index() >= traits_.size()) traits_.resize(points_.size());
    traits_[v.index()] |= trait;
  }
  [[nodiscard]] unsigned traits(VertexId v) const {
    return v.index() < traits_.size() ? traits_[v.index()] : 0;
  }
  void follow_corridor(VertexId from, VertexId to, SegmentId s);
  [[nodiscard]] double along(SegmentId s, VertexId v) const;
  [[nodiscard]] VertexId nearby_before(VertexId goal, VertexId at, SegmentId s,
                                       const Obstacle& obstacle) const;
  void doubt(SegmentId s, Point place) { snaps_.push_back({s, place}); }
  [[nodiscard]] std::pair<Point, Point> ends_of(SegmentId s) const;

  // course.cpp: the vertices that a segment leads through
  [[nodiscard]] bool belongs_at_apex(EdgeId e, Passage passage);
  bool lead_through_apex(EdgeId e);
  bool settle_new(VertexId v) {
    return !(is_surrounded_ || is_crowded_) || settle_around(v, is_crowded_);
  }
  bool settle_around(VertexId v, bool may_be_crowded = true);
  [[nodiscard]] bool lead_others_through(VertexId v);
  [[nodiscard]] bool find_crowds(VertexId v);
  void note_crowd(VertexId v);
  void settle_crowd(VertexId v);
  template <class IsNearVertex, class IsNearEdge, class Visit>
  void visit_near(VertexId v, IsNearVertex is_near_vertex, IsNearEdge is_near_edge, Visit visit);
  void lay_crowded();
  void take_off_crowded();
  [[nodiscard]] bool settle_piece(EdgeId e, SegmentId s);
  [[nodiscard]] bool hides_something(EdgeId e) const;
  void settle_pieces();
  void lay_through(SegmentId s, bool can_others_wait = true);
  template <class Visit>
  void trace(SegmentId s, Visit visit) const;
  void make_crossings(SegmentId s);
  void gather_stops(SegmentId s);
  void lay_between(VertexId at, VertexId stop, SegmentId s);
  [[nodiscard]] VertexId detour(EdgeId e, VertexId at, VertexId goal, SegmentId s);

  // cavity.cpp
  EdgeId force_edge(VertexId from, VertexId to);
  void gather_cavity();
  void add_gap(Cavity& cavity, EdgeId inside, VertexId end);
  void match_gaps();
  [[nodiscard]] EdgeId fill(Cavity& cavity);
  [[nodiscard]] EdgeId fill(Cavity& cavity, std::uint32_t low, std::uint32_t high);
  [[nodiscard]] EdgeId fill_large(Cavity& cavity);
  void copy_triangle(EdgeId in_part);
  [[nodiscard]] std::uint32_t choose_tip(const Cavity& cavity, std::uint32_t low,
                                         std::uint32_t high) const;
  [[nodiscard]] bool opens_towards(const Cavity& cavity, std::uint32_t tip, VertexId low,
                                   VertexId high) const;
  void close(Cavity& cavity, std::uint32_t gap, EdgeId inside);
  [[nodiscard]] TriangleId spare_triangle(VertexId a, VertexId b, VertexId c);

  // remove.cpp
  void check_own_point(VertexId v) const;
  void take_out(std::span<const ConstraintId> ids, std::span<const VertexId> vertices = {});
  void take_off(SegmentId s);
  [[nodiscard]] bool may_be_tangled(SegmentId s) const;
  void take_off_around(VertexId start, SegmentId s);
  void take_off_to_lay_again(SegmentId s);
  void loosen(VertexId v);
  [[nodiscard]] bool ends_at(SegmentId s, VertexId v) const;
  [[nodiscard]] std::optional<Passage> find_passage(EdgeId e, SegmentId s) const;
  void unmark(EdgeId e, Passage passage);
  void settle_loose();
  void examine(VertexId v);
  [[nodiscard]] bool passes_straight(EdgeId before, EdgeId after) const;
  [[nodiscard]] bool is_needed(VertexId v) const;
  [[nodiscard]] bool is_rightly_on(SegmentId s, VertexId v) const;
  void gather_segments(VertexId v);
  void lay_again();
  void release_points(ConstraintId id);
  [[nodiscard]] std::size_t count_points_at(VertexId v) const;
  [[nodiscard]] bool may_have_points_at(VertexId v) const;
  void note_edited(ConstraintId id);
  void forget_dead_snaps();
  void tidy_snaps();
  void straighten(std::size_t known_snaps);

  // holes.cpp: vertices taken out
  void delete_vertex(VertexId v);
  [[nodiscard]] bool delete_between(VertexId v, EdgeId before, EdgeId after);
  void delete_from_line(VertexId v);
  void gather_half(Cavity& cavity, EdgeId first, EdgeId last);
  [[nodiscard]] bool is_beside(const Cavity& cavity) const;
  void suspect_rim(const Cavity& cavity);
  [[nodiscard]] bool fill_small_hole(VertexId v);
  [[nodiscard]] bool plan(const Cavity& cavity, std::uint32_t low, std::uint32_t high);
  [[nodiscard]] EdgeId fill_planned(Cavity& cavity, std::uint32_t low, std::uint32_t high);
  void gather_star(VertexId v);
  void gather_hole(VertexId v);
  void rate(std::uint32_t corner, Point centre);
  void cut_ears(Point centre);
  void cut_ear(std::uint32_t corner);
  void close_hole(std::uint32_t start);

  // move.cpp
  void move_to(ConstraintId id, std::span<const Point> points);
  void replace(ConstraintId id, std::span<const Point> points);
  void move_in_place(ConstraintId id, std::span<const Point> points);
  void take_off_all_but_plain(ConstraintId id);
  [[nodiscard]] EdgeId plain_edge(SegmentId s) const;
  [[nodiscard]] EdgeId plain_edge_now(SegmentId s, EdgeId known) const;
  void move_vertices(ConstraintId id, std::span<const Point> points);
  void move_together(ConstraintId id, std::span<const Point> points);
  void put_back(VertexId v);
  void turn_passages(ConstraintId id);
  [[nodiscard]] bool has_room(VertexId v, Point point) const;
  [[nodiscard]] bool has_room_beside_moved(VertexId v) const;
  [[nodiscard]] bool move_vertex(VertexId v, Point point);
  void suspect_around(VertexId v);
  void settle_plain(ConstraintId id);
  void replace_still(ConstraintId id, std::span<const Point> points);
  [[nodiscard]] bool has_moved(VertexId v) const {
    return v != infinite && (uses_[v.index()] & moved) != 0;
  }
  /// Whether what is beside both is looked at from `other`, not from v: once for all that moved.
  [[nodiscard]] bool is_for(VertexId other, VertexId v) const {
    return has_moved(other) && other < v;
  }

  double epsilon_ = 0;
  std::vector<OrientedEdge> edges_;  // some more than triangle_bound_ asks for
  std::size_t triangle_bound_ = 0;
  std::vector<PassageSet> edge_sets_;  // of constrained edges; the same on both sides
  std::vector<Point> points_;
  std::vector<EdgeId> vertex_edges_;
  std::vector<std::uint32_t> uses_;  // points of constraints at a vertex, and insert(Point)s
  std::vector<Constraint> constraints_;
  std::vector<ConstraintId> without_length_;  // the first at each vertex; as long as needed
  std::vector<Segment> segments_;
  PassageSets sets_;
  std::vector<TriangleId> free_triangles_;
  std::vector<VertexId> free_vertices_;
  std::vector<ConstraintId> free_constraints_;
  std::vector<std::uint32_t> free_segments_;  // the first block of each size class
  std::uint32_t dense_segments_ = unused;     // below it, blocks are as long as they were asked
  std::vector<Snap> snaps_;
  Locator locator_;
  EdgeId last_;
  std::size_t vertex_count_ = 0;
  VertexId reserved_;       // the number of the next vertex, where that is not the first free one
  VertexId only_;           // the only vertex, while there is just one
  std::size_t flips_ = 0;   // since insert_points() began
  bool is_flat_ = true;     // no finite triangle yet: all vertices in one line
  bool has_bends_ = false;  // segments may lead through points of others that are not on them
  bool is_surrounded_ = true;  // what fan_out() came by: constrained edges,
  bool is_crowded_ = true;     // vertices or edges hardly apart from the new one
  bool is_recording_ = false;
  bool is_in_batch_ = false;
  Changes changes_;

  // Scratch memory of single operations, kept to spare allocations.
  std::vector<Touch> touched_;
  std::vector<Touch> touched_before_;
  std::vector<std::uint32_t> touched_at_;  // by triangle: where in touched_ it may be; as needed
  std::vector<VertexId> inserted_;
  std::vector<EdgeId> suspects_;
  std::vector<EdgeId> crossed_;
  std::vector<VertexId> goals_;
  std::vector<VertexId> stops_;
  std::vector<VertexId> crowd_;
  std::vector<char> is_in_crowd_;
  std::vector<std::uint8_t> traits_;  // by vertex; as long as needed
  std::vector<SegmentId> crowded_;
  std::vector<Point> crossings_;
  std::vector<std::pair<VertexId, VertexId>> unsettled_;  // pieces, from one end to the other
  std::vector<TriangleId> spare_;
  std::vector<VertexId> loose_;
  std::vector<SegmentId> taken_off_;
  std::vector<SegmentId> around_;
  std::vector<Passage> around_passages_;
  std::vector<Corner> corners_;
  std::vector<Ear> ears_;
  std::array<std::array<std::uint32_t, most_planned>, most_planned> tips_{};
  std::vector<Point> places_;
  std::vector<char> stays_;
  std::vector<EdgeId> plain_;
  std::vector<std::uint32_t> still_;
  std::vector<Point> places_before_;
  std::vector<VertexId> moving_;
  std::vector<std::pair<Point, Point>> edited_;
  Cavity left_;
  Cavity right_;
  Workshops workshop_;
};

}  // namespace loft::cdt
