// SPDX-License-Identifier: MIT
#include "paths/visible.h"

#include <algorithm>

#include "cdt/predicates.h"
#include "paths/distance.h"
#include "paths/expect_followed.h"

namespace loft::paths {

using cdt::Location;

namespace {

/// Follows a ray from triangle to triangle, as far as it is a way.
class Gaze {
 public:
  Gaze(const FreeSpace& space, Point from, Point towards)
      : space_(space), mesh_(space.mesh()), from_(from), towards_(towards) {
    begin();
  }

  /// Whether it starts at what is free.
  [[nodiscard]] bool starts() const { return state_ != State::nowhere; }
  /// Whether it comes as far as to `towards`.
  [[nodiscard]] bool arrives() {
    while (goes_on()) {
      if (has_arrived()) return true;
      step();
    }
    return false;
  }

  [[nodiscard]] std::optional<Hit> hit() {
    while (goes_on()) step();
    if (state_ == State::nowhere) return std::nullopt;
    const Point place =
        state_ == State::blocked_at_place
            ? place_
            : cdt::intersection(from_, towards_, point(mesh_.from(edge_)), point(mesh_.to(edge_)));
    return Hit{.place = place, .edge = edge_, .distance = distance_between(from_, place)};
  }

 private:
  enum class State {
    nowhere,           // not even the start is free
    crossing,          // through the triangle left of edge_, to leave it across the edge
    along,             // from from(edge_) to to(edge_), beside what is free as the flags say
    arriving,          // through the triangle left of edge_, to the vertex from(edge_)
    blocked,           // at edge_, from the triangle on its left
    blocked_at_place,  // at place_, by edge_
  };

  [[nodiscard]] bool goes_on() const {
    return state_ == State::crossing || state_ == State::along || state_ == State::arriving;
  }
  [[nodiscard]] Point point(VertexId v) const { return mesh_.point(v); }
  [[nodiscard]] int side(VertexId v) const { return cdt::orient(from_, towards_, point(v)); }
  [[nodiscard]] bool has_free_left(EdgeId e) const {
    return space_.is_free(Triangulation::triangle(e));
  }
  /// Of two places on the line, whether the ray comes to `first` before it comes to `second`.
  [[nodiscard]] bool is_before(Point first, Point second) const {
    return from_ < towards_ ? first < second : second < first;
  }

  [[nodiscard]] bool has_arrived() const {
    switch (state_) {
      case State::crossing:
        return cdt::orient(point(mesh_.from(edge_)), point(mesh_.to(edge_)), towards_) >= 0;
      case State::along:
        return !is_before(point(mesh_.to(edge_)), towards_);
      default:
        return !is_before(point(mesh_.from(edge_)), towards_);
    }
  }

  void begin() {
    const Location place = mesh_.locate(from_);
    switch (place.kind) {
      case Location::Kind::triangle:
        if (has_free_left(place.edge)) leave_triangle(place.edge);
        break;
      case Location::Kind::edge:
        leave_edge(place.edge);
        break;
      case Location::Kind::vertex:
        leave_start(place.edge);
        break;
      case Location::Kind::outside:
      case Location::Kind::nowhere:
        break;
    }
  }

  void step() {
    switch (state_) {
      case State::crossing:
        if (const EdgeId entry = space_.beyond(edge_); entry.is_none())
          state_ = State::blocked;
        else
          enter(entry);
        break;
      case State::along:
        leave_vertex(is_on_left_ ? Triangulation::next(edge_) : EdgeId::none(),
                     is_on_right_ ? mesh_.twin(edge_) : EdgeId::none());
        break;
      default:
        leave_vertex(edge_, edge_);
        break;
    }
  }

  void cross(EdgeId e) {
    state_ = State::crossing;
    edge_ = e;
  }
  void arrive(EdgeId e) {
    state_ = State::arriving;
    edge_ = e;
  }
  void block(Point place, EdgeId e) {
    state_ = State::blocked_at_place;
    place_ = place;
    edge_ = e;
  }
  /// Along an edge, if it is on either side of it; those that are joined there are one.
  [[nodiscard]] bool follow(EdgeId e, bool is_on_left, bool is_on_right) {
    if (!is_on_left && !is_on_right) return false;
    const bool is_on_both = !space_.beyond(e).is_none();
    state_ = State::along;
    edge_ = e;
    is_on_left_ = is_on_left || is_on_both;
    is_on_right_ = is_on_right || is_on_both;
    return true;
  }

  /// Into the triangle left of e: from(e) is left of the ray, to(e) right.
  void enter(EdgeId e) {
    const int apex = side(mesh_.apex(e));
    if (apex == 0) return arrive(Triangulation::prev(e));
    cross(apex > 0 ? Triangulation::next(e) : Triangulation::prev(e));
  }

  /// From strictly inside a triangle.
  void leave_triangle(EdgeId e) {
    for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e)) {
      const int right = side(mesh_.from(e));
      if (right == 0 && is_before(from_, point(mesh_.from(e)))) return arrive(e);
      if (right < 0 && side(mesh_.to(e)) > 0) return cross(e);
    }
  }

  /// From strictly inside an edge.
  void leave_edge(EdgeId e) {
    const int to = side(mesh_.to(e));
    const bool is_turned = to == 0 ? is_before(point(mesh_.to(e)), from_) : to > 0;
    if (is_turned) e = mesh_.twin(e);
    const EdgeId twin = mesh_.twin(e);
    if (to == 0)
      (void)follow(e, has_free_left(e), has_free_left(twin));
    else if (has_free_left(e))
      enter(e);
    else if (has_free_left(twin))
      block(from_, twin);
  }

  /// From a vertex, where it starts; e starts there, too.
  void leave_start(EdgeId e) {
    const EdgeId first = e;
    EdgeId ahead;  // on its left is what the ray goes into, or, at its right side, along
    do {
      const VertexId right = mesh_.to(e);
      const VertexId left = mesh_.apex(e);
      if (right != Triangulation::infinite && side(right) == 0 && is_before(from_, point(right))) {
        if (follow(e, has_free_left(e), has_free_left(mesh_.twin(e)))) return;
        ahead = e;
      } else if (right == Triangulation::infinite || left == Triangulation::infinite) {
        if (ahead.is_none()) ahead = e;
      } else if (side(right) < 0 && side(left) > 0) {
        if (has_free_left(e)) return cross(Triangulation::next(e));
        ahead = e;
      }
      e = mesh_.rotated(e);
    } while (e != first);
    block_at_start(ahead);
  }

  /// The ray cannot leave the vertex where it starts: the edge in the way is the first one
  /// clockwise of something free.
  void block_at_start(EdgeId ahead) {
    EdgeId e = ahead;
    do {
      if (has_free_left(e)) return block(from_, Triangulation::prev(e));
      e = Triangulation::next(mesh_.twin(e));
    } while (e != ahead);
  }

  /// On from a vertex that the ray has come to; in the triangles left of these two edges from
  /// there, each on its side of the ray, or in one and the same.
  void leave_vertex(EdgeId left, EdgeId right) {
    const Point here = point(mesh_.from(left.is_none() ? right : left));
    EdgeId barrier;
    right = around_on_right(right, barrier);
    left = around_on_left(left, barrier);
    if (!left.is_none() && side(mesh_.to(left)) < 0) return cross(Triangulation::next(left));
    if (!right.is_none() && side(mesh_.apex(right)) > 0) return cross(Triangulation::next(right));
    const bool is_on_left = !left.is_none();
    const bool is_on_right = !right.is_none();
    const EdgeId ahead = is_on_left    ? left
                         : is_on_right ? mesh_.twin(Triangulation::prev(right))
                                       : EdgeId::none();
    if (!follow(ahead, is_on_left, is_on_right)) block(here, barrier);
  }

  /// Clockwise around the vertex to the triangle that has the ray in it or on its right side; none
  /// if something is in between.
  [[nodiscard]] EdgeId around_on_left(EdgeId e, EdgeId& barrier) const {
    while (!e.is_none() && side(mesh_.to(e)) > 0) {
      const EdgeId beyond = space_.beyond(e);
      if (beyond.is_none()) barrier = e;
      e = beyond.is_none() ? beyond : Triangulation::next(beyond);
    }
    return e;
  }
  /// Counter-clockwise to the triangle that has the ray in it or on its left side.
  [[nodiscard]] EdgeId around_on_right(EdgeId e, EdgeId& barrier) const {
    while (!e.is_none() && side(mesh_.apex(e)) < 0) {
      const EdgeId beyond = space_.beyond(Triangulation::prev(e));
      if (beyond.is_none()) barrier = Triangulation::prev(e);
      e = beyond;
    }
    return e;
  }

  const FreeSpace& space_;
  const Triangulation& mesh_;
  Point from_;
  Point towards_;
  State state_ = State::nowhere;
  EdgeId edge_;
  bool is_on_left_ = false;
  bool is_on_right_ = false;
  Point place_;
};

/// Triangular expansion from a place.
class Lookout {
 public:
  Lookout(const FreeSpace& space, Point place)
      : space_(space), mesh_(space.mesh()), place_(place) {}

  [[nodiscard]] std::vector<overlay::Ring> look() {
    const Location place = mesh_.locate(place_);
    switch (place.kind) {
      case Location::Kind::triangle:
        if (is_free(place.edge)) look_from_triangle(place.edge);
        break;
      case Location::Kind::edge:
        look_from_edge(place.edge);
        break;
      case Location::Kind::vertex:
        look_from_vertex(place.edge);
        break;
      case Location::Kind::outside:
      case Location::Kind::nowhere:
        break;
    }
    std::ranges::sort(rings_);
    return std::move(rings_);
  }

 private:
  /// What is seen of an edge, whose left side one looks at: what is between the rays to two
  /// vertices. It begins on the right, at from(edge) or further left.
  struct View {
    EdgeId edge;
    Point right;
    Point left;
  };

  [[nodiscard]] bool is_free(EdgeId e) const { return space_.is_free(Triangulation::triangle(e)); }
  [[nodiscard]] Point from(EdgeId e) const { return mesh_.point(mesh_.from(e)); }
  [[nodiscard]] Point to(EdgeId e) const { return mesh_.point(mesh_.to(e)); }

  void look_from_triangle(EdgeId e) {
    for (unsigned i = 0; i < 3; ++i, e = Triangulation::next(e)) look_at(e);
    close_ring(true);
  }

  void look_from_edge(EdgeId e) {
    const bool is_open = !space_.beyond(e).is_none();
    for (const EdgeId half : {e, mesh_.twin(e)}) {
      if (!is_free(half)) continue;
      look_at(Triangulation::next(half));
      look_at(Triangulation::prev(half));
      if (!is_open) close_ring(false);
    }
    if (is_open) close_ring(true);
  }

  void look_from_vertex(EdgeId e) {
    const EdgeId start = e;
    bool has_sectors = false;
    do {
      if (is_free(e) && space_.beyond(e).is_none()) {
        has_sectors = true;
        look_from_sector(e);
      }
      e = mesh_.rotated(e);
    } while (e != start);
    if (!has_sectors && is_free(start)) look_around(start);
  }

  void look_around(EdgeId start) {
    EdgeId e = start;
    do {
      look_at(Triangulation::next(e));
      e = mesh_.rotated(e);
    } while (e != start);
    close_ring(true);
  }

  /// From a vertex into what is free there, from the edge on that bounds it on the right.
  void look_from_sector(EdgeId first) {
    EdgeId last;
    for (EdgeId e = first; !e.is_none(); e = space_.beyond(Triangulation::prev(e))) {
      look_at(Triangulation::next(e));
      last = e;
    }
    close_ring(Triangulation::prev(last) == mesh_.twin(first));
  }

  /// All that is seen through an edge of a triangle that the place is in, or of its border.
  void look_at(EdgeId e) {
    views_.push_back({e, from(e), to(e)});
    while (!views_.empty()) {
      const View view = views_.back();
      views_.pop_back();
      if (const EdgeId entry = space_.beyond(view.edge); entry.is_none())
        end_at(view);
      else
        look_through(entry, view);
    }
  }

  /// Into the triangle left of an edge; what is on the right comes first.
  void look_through(EdgeId entry, const View& view) {
    const Point apex = mesh_.point(mesh_.apex(entry));
    const int left_side = cdt::orient(place_, view.left, apex);
    const int right_side = cdt::orient(place_, view.right, apex);
    if (left_side < 0)
      views_.push_back(
          {Triangulation::prev(entry), right_side >= 0 ? apex : view.right, view.left});
    if (right_side > 0)
      views_.push_back({Triangulation::next(entry), view.right, left_side <= 0 ? apex : view.left});
  }

  void end_at(const View& view) {
    const Point a = from(view.edge);
    const Point b = to(view.edge);
    add(view.right == a ? a : cdt::intersection(place_, view.right, a, b));
    add(view.left == b ? b : cdt::intersection(place_, view.left, a, b));
  }

  /// Where what is seen between two rays is too narrow for doubles, the ring would only go there
  /// and back.
  void add(Point p) {
    if (!ring_.empty() && ring_.back() == p) return;
    if (ring_.size() > 1 && ring_[ring_.size() - 2] == p) return ring_.pop_back();
    ring_.push_back(p);
  }

  void close_ring(bool is_all_around) {
    if (!is_all_around) add(place_);
    const Point first = ring_.front();
    add(first);
    if (ring_.back() == first) ring_.pop_back();
    std::rotate(ring_.begin(), std::ranges::min_element(ring_), ring_.end());
    if (ring_.size() > 2) rings_.push_back(std::move(ring_));
    ring_.clear();
  }

  const FreeSpace& space_;
  const Triangulation& mesh_;
  Point place_;
  std::vector<View> views_;
  overlay::Ring ring_;
  std::vector<overlay::Ring> rings_;
};

}  // namespace

bool sees(const FreeSpace& space, Point a, Point b) {
  expect_followed(space);
  if (a == b) return Gaze(space, a, {a.x, a.y == 0 ? 1.0 : 0.0}).starts();
  return Gaze(space, a, b).arrives();
}

std::optional<Hit> first_hit(const FreeSpace& space, Point p, Point towards) {
  expect_followed(space);
  if (p == towards) return std::nullopt;
  return Gaze(space, p, towards).hit();
}

std::vector<overlay::Ring> visible_region(const FreeSpace& space, Point p) {
  expect_followed(space);
  return Lookout(space, p).look();
}

}  // namespace loft::paths
