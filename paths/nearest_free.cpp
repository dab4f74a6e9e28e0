// SPDX-License-Identifier: MIT
#include "paths/nearest_free.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "overlay/distance.h"
#include "overlay/flat_map.h"
#include "paths/distance.h"
#include "paths/expect_followed.h"

namespace loft::paths {

namespace {

/// From a point's triangle outward, the nearest first, up to those that are wanted.
template <class IsWanted>
class Outward {
 public:
  Outward(const FreeSpace& space, Point p, IsWanted is_wanted)
      : space_(space), mesh_(space.mesh()), p_(p), is_wanted_(is_wanted) {}

  [[nodiscard]] std::optional<Point> nearest() {
    if (is_at_wanted(p_)) return p_;
    start();
    while (!front_.empty() && front_.top().distance <= best_.distance) {
      const Step step = front_.top();
      front_.pop();
      expand(step);
    }
    if (best_.edge.is_none()) return std::nullopt;
    return best_.place;
  }

 private:
  struct Step {
    double distance;  // of the furthest edge on the way
    TriangleId triangle;
    bool operator<(const Step& other) const { return distance > other.distance; }
  };
  /// A point of an edge beyond which is what is wanted.
  struct Candidate {
    double distance = std::numeric_limits<double>::infinity();
    Point place;
    EdgeId edge;

    [[nodiscard]] bool operator<(const Candidate& other) const {
      return distance != other.distance ? distance < other.distance : place < other.place;
    }
  };

  [[nodiscard]] Point from(EdgeId e) const { return mesh_.point(mesh_.from(e)); }
  [[nodiscard]] Point to(EdgeId e) const { return mesh_.point(mesh_.to(e)); }

  [[nodiscard]] bool is_at_wanted(Point p) {
    space_.triangles_at(p, at_);
    return std::ranges::any_of(at_, is_wanted_);
  }

  void start() {
    const cdt::Location place = mesh_.locate(p_);
    if (place.kind == cdt::Location::Kind::nowhere) return;
    front_.push({0, Triangulation::triangle(place.edge)});
    if (place.kind == cdt::Location::Kind::edge)
      front_.push({0, Triangulation::triangle(mesh_.twin(place.edge))});
  }

  void expand(const Step& step) {
    if (seen_.find(step.triangle.index()) != overlay::FlatMap::none) return;
    seen_.set(step.triangle.index(), 0);
    for (unsigned corner = 0; corner < 3; ++corner)
      look_beyond(step, Triangulation::edge(step.triangle, corner));
  }

  void look_beyond(const Step& step, EdgeId e) {
    const TriangleId other = Triangulation::triangle(mesh_.twin(e));
    if (mesh_.from(e) == Triangulation::infinite || mesh_.to(e) == Triangulation::infinite)
      return front_.push({step.distance, other});
    const Point place = overlay::nearest_on_segment(p_, from(e), to(e));
    const Candidate here = candidate(place, e);
    if (is_wanted_(other)) {
      if (here < best_) best_ = std::min(best_, settled(here));
    } else if (here.distance <= best_.distance) {
      front_.push({std::max(step.distance, here.distance), other});
    }
  }

  [[nodiscard]] Candidate candidate(Point place, EdgeId e) const {
    return {distance_between(p_, place), place, e};
  }

  /// A candidate as near as rounding allows that is where it should be: beside the nearest one, or,
  /// in what is too narrow for that, along the edge.
  [[nodiscard]] Candidate settled(const Candidate& nearest) {
    if (is_at_wanted(nearest.place)) return nearest;
    const EdgeId e = nearest.edge;
    const Point unit{0x1p-52 * std::max(std::abs(from(e).x), std::abs(to(e).x)),
                     0x1p-52 * std::max(std::abs(from(e).y), std::abs(to(e).y))};
    Candidate best;
    for (double reach = 1; reach <= 8 && best.edge.is_none(); reach *= 2)
      best = wanted_beside(nearest, {reach * unit.x, reach * unit.y});
    for (double share = 0x1p-48; share < 1 && best.edge.is_none(); share *= 2)
      for (const Point end : {from(e), to(e)})
        best = std::min(best, wanted_beside(moved(nearest, end, share), unit));
    if (!best.edge.is_none()) return best;
    return std::min(candidate(from(e), e), candidate(to(e), e));
  }

  [[nodiscard]] Candidate moved(const Candidate& from, Point to, double share) const {
    return candidate({from.place.x + share * (to.x - from.place.x),
                      from.place.y + share * (to.y - from.place.y)},
                     from.edge);
  }

  /// The best of a place and eight around it that is where it should be.
  [[nodiscard]] Candidate wanted_beside(const Candidate& middle, Point step) {
    Candidate best;
    for (const double x : {-step.x, 0.0, step.x}) {
      for (const double y : {-step.y, 0.0, step.y}) {
        const Candidate here = candidate({middle.place.x + x, middle.place.y + y}, middle.edge);
        if (here < best && is_at_wanted(here.place)) best = here;
      }
    }
    return best;
  }

  const FreeSpace& space_;
  const Triangulation& mesh_;
  Point p_;
  IsWanted is_wanted_;
  Candidate best_;
  std::priority_queue<Step> front_;
  overlay::FlatMap seen_;
  std::vector<TriangleId> at_;
};

}  // namespace

std::optional<Point> nearest_free(const FreeSpace& space, Point p) {
  expect_followed(space);
  return Outward(space, p, [&](TriangleId t) { return space.is_free(t); }).nearest();
}

std::optional<Point> nearest_reachable(const FreeSpace& space, Point from, Point p) {
  expect_followed(space);
  std::vector<TriangleId> starts;
  space.triangles_at(from, starts);
  if (starts.empty()) return std::nullopt;
  const auto is_reachable = [&](TriangleId t) {
    return std::ranges::any_of(
        starts, [&](TriangleId start) { return space.component(start) == space.component(t); });
  };
  return Outward(space, p, is_reachable).nearest();
}

}  // namespace loft::paths
