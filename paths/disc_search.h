// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "paths/directions.h"
#include "paths/free_space.h"
#include "paths/path.h"
#include "paths/sweep.h"

namespace loft::paths {

/// The search of Workspace for a disc: on the triangles of the gaps, over edges that the disc
/// passes, with circles around the corners in the place of corners, and tangents in that of rays.
/// What a root sees of an edge is between the tangents to the circles at its sides.
///
/// Whether there is a way is decided exactly, by the gaps; tangents are rounded. Each straight
/// piece is swept before it counts, so that what is looked at may be more than what is seen.
class DiscSearch {
 public:
  /// Puts the shortest path in `path`. Precondition: radius > 0; the space keeps gaps.
  void find(const FreeSpace& space, const Query& query, Path& path);
  [[nodiscard]] std::size_t expansions() const { return expansions_; }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;

  /// What a path bends around, or its start.
  struct Root {
    Circle circle;
    Direction in;                 // as it comes there
    double length = 0;            // of the way to where it touches the circle
    std::uint32_t before = none;  // the root before
    std::uint32_t key = none;     // of the corner and the side, for best_
    std::uint32_t name = 0;       // of all that come to corners
  };
  /// A side of what is seen: the tangent to a circle that is passed.
  struct Bound {
    Circle circle;
    Direction along;
    bool is_at_end = false;  // the circle is around the edge's own end
  };
  struct Interval {
    EdgeId edge;
    std::uint32_t root = none;
    Bound left;
    Bound right;
  };
  /// A path that comes to a corner, to bend around it through the triangle left of `edge` on.
  struct Bend {
    EdgeId edge;
    Root root;
  };
  struct Step {
    Interval interval;
    Bend bend;
    bool is_bend = false;
  };
  struct Entry {
    double estimate;
    std::uint32_t step;
  };
  struct Best {
    double length = 0;
    Direction in;
    std::uint32_t name = 0;
    std::uint32_t search = 0;
  };

  void begin(const FreeSpace& space, const Query& query);
  void find_triangles(Point p, std::vector<TriangleId>& found) const;
  void start(TriangleId t);
  void start_through(EdgeId e);
  void expand(const Interval& interval);
  void expand(const Bend& bend);
  void turn_at(EdgeId corner, std::uint32_t root, const Circle& circle);
  void push(const Interval& interval);
  void push(double estimate, const Step& step);
  /// A corner of the goal's triangle. What a path has passed it may not leave on the other side.
  struct Corner {
    Circle circle;
    double side = 1;  // 1 where the path keeps it on its left, -1 on its right
    bool is_passed = false;
  };

  void see_goal(std::uint32_t root, std::span<const Corner> corners, const Direction* left,
                const Direction* right);
  void pull_to_goal(std::uint32_t root, std::span<const Corner> corners, int depth);
  [[nodiscard]] Corner left_corner(EdgeId e, bool is_passed) const {
    return {on_left(e), 1, is_passed};
  }
  [[nodiscard]] Corner right_corner(EdgeId e, bool is_passed) const {
    return {on_right(e), -1, is_passed};
  }
  [[nodiscard]] Corner corner_beside(Direction way_to_goal, EdgeId e) const;
  [[nodiscard]] bool comes_first(const Root& root, const Bound& bound, const Circle& other) const;
  [[nodiscard]] bool is_way_clear(std::uint32_t root, const Tangent& way, const Circle& to);
  void finish(std::uint32_t root, const Tangent& last);
  void put_together(Path& path) const;

  [[nodiscard]] bool is_goal(TriangleId t) const;
  [[nodiscard]] bool is_joined() const;
  [[nodiscard]] EdgeId beyond(EdgeId e) const { return gaps_->beyond(e, radius_); }
  /// The radius of the circle around from(e), as seen from the left of e.
  [[nodiscard]] double radius_at(EdgeId e) const {
    return gaps_->corner(e).is_none() ? 0 : radius_;
  }
  [[nodiscard]] Point from(EdgeId e) const { return mesh_->point(mesh_->from(e)); }
  [[nodiscard]] Circle on_left(EdgeId e) const { return {from(e), radius_at(e)}; }
  [[nodiscard]] Circle on_right(EdgeId e) const { return {from(e), -radius_at(e)}; }
  /// The bound at from(e). Where ways do not turn, at feet and in hollow corners, that is a point:
  /// what is beside it bounds more.
  [[nodiscard]] Bound left_bound(const Root& root, EdgeId e) const {
    return {on_left(e), tangent(root.circle, on_left(e)).along, true};
  }
  [[nodiscard]] Bound right_bound(const Root& root, EdgeId e) const {
    return {on_right(e), tangent(root.circle, on_right(e)).along, true};
  }
  /// The length of a path that leaves a root in a direction, up to there.
  [[nodiscard]] double length_to(const Root& root, Direction out) const;
  [[nodiscard]] bool reaches(const Root& root, const Bound& bound, double side, Point other) const;
  [[nodiscard]] static bool turns_back(const Root& root, Direction out);
  /// Whether whatever goes on from `other` can as well go on from what is known.
  [[nodiscard]] bool covers(const Best& best, const Root& other) const;
  [[nodiscard]] std::uint32_t key_of(EdgeId e, bool is_left) const;
  [[nodiscard]] double estimate(const Interval& interval) const;
  [[nodiscard]] double through_bound(const Root& root, const Bound& bound, Point a, Point b,
                                     Point goal) const;

  const Gaps* gaps_ = nullptr;
  const Triangulation* mesh_ = nullptr;
  Point goal_;
  double radius_ = 0;
  std::size_t expansions_ = 0;
  double length_ = 0;
  std::uint32_t last_ = none;
  std::uint32_t search_ = 0;
  std::uint32_t names_ = 0;
  std::vector<TriangleId> starts_;
  std::vector<TriangleId> goals_;
  std::vector<Root> roots_;
  std::vector<Step> steps_;
  std::vector<Entry> heap_;
  Sweep sweep_;
  std::vector<Best> best_;  // by twice the corner, and side
};

}  // namespace loft::paths
