// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/follow.h"
#include "cdt/triangulation.h"
#include "paths/directions.h"

namespace loft::paths {

class FreeSpace;

/// Which gaps between obstacles a disc passes: of any radius, kept from edit to edit.
///
/// A triangulation of its own has nothing but what blocks the way, and the feet: from each corner
/// of an obstacle the foot of the perpendicular to what it sees on the other side, where that is
/// nearest: neither is anything between nearer, nor do the corner's own walls come nearer to the
/// foot. So each narrowest place on any way, between two corners, or a corner and a side, is an
/// edge here, as the disc over it is empty (compare Kallmann, "Dynamic and Robust Local Clearance
/// Triangulations", 2014, which refines for the same end): a disc of radius r gets from one place
/// to another if and only if its centre can stand at both and triangles lead there, over edges that
/// are no gap below 2 r.
class Gaps {
 public:
  Gaps() : free_(mesh_, 0, Cross{this}) { mesh_.record_changes(true); }
  Gaps(const Gaps&) = delete;
  Gaps& operator=(const Gaps&) = delete;

  /// Forgets all. Cost: that of bulk insertion, then of the feet.
  void build(const FreeSpace& space);
  /// Takes over an edit: the triangles of the space that are no more as they were, and those that
  /// are new, are free or no longer, or have other sides that can be crossed.
  void follow(const FreeSpace& space, std::span<const cdt::TriangleId> unmade,
              std::span<const cdt::TriangleId> touched);

  [[nodiscard]] const cdt::Triangulation& mesh() const { return mesh_; }
  [[nodiscard]] bool is_free(cdt::TriangleId t) const { return free_[t] != 0; }
  /// The twin of an edge that can be crossed by a point, if it can; none otherwise.
  [[nodiscard]] cdt::EdgeId beyond(cdt::EdgeId e) const { return ways_[e.index()].beyond; }
  /// The same for a disc.
  [[nodiscard]] cdt::EdgeId beyond(cdt::EdgeId e, double radius) const {
    const cdt::EdgeId twin = beyond(e);
    return twin.is_none() || is_passable(e, radius) ? twin : cdt::EdgeId::none();
  }
  /// The width of the gap along an edge that can be crossed, rounded; infinite where it is none.
  [[nodiscard]] double width(cdt::EdgeId e) const { return ways_[e.index()].width; }
  /// Whether a disc passes the gap along an edge that can be crossed: exact, one as wide as the
  /// disc is passed.
  [[nodiscard]] bool is_passable(cdt::EdgeId e, double radius) const {
    constexpr double clear = 1 - 0x1p-44;
    const double width = this->width(e);
    if (2 * radius < clear * width) return true;
    return width >= clear * 2 * radius && is_passable_exactly(e, radius);
  }
  /// As FreeSpace::corner().
  [[nodiscard]] cdt::EdgeId corner(cdt::EdgeId e) const { return ways_[e.index()].corner; }
  [[nodiscard]] bool is_foot(cdt::VertexId v) const {
    return v.index() < is_foot_.size() && is_foot_[v.index()];
  }

 private:
  /// What is on the two sides of a constraint.
  struct Wall {
    bool is_free_on_left = false;
    bool is_free_on_right = false;

    friend bool operator==(const Wall&, const Wall&) = default;
  };
  /// What there is to an edge: beyond(), corner(), width().
  struct Way {
    cdt::EdgeId beyond;
    cdt::EdgeId corner;
    double width = 0;
  };
  struct Cross {
    const Gaps* gaps;
    char operator()(cdt::EdgeId e, char here) const;
  };
  /// A wall that comes or goes.
  struct Edit {
    cdt::Point from;
    cdt::Point to;
    Wall wall;
    cdt::EdgeId edge;  // of the space
    cdt::ConstraintId constraint;

    [[nodiscard]] bool is_at(const Edit& other) const {
      return from == other.from && to == other.to && wall == other.wall;
    }
  };
  /// What is seen from a corner: between two walls, the first one clockwise.
  struct Sight {
    cdt::Point from;
    Direction first;
    Direction last;

    [[nodiscard]] bool is_narrower_between(Direction a, Direction b) const;
  };

  [[nodiscard]] bool is_passable_exactly(cdt::EdgeId e, double radius) const;
  [[nodiscard]] Edit wall_at(const FreeSpace& space, cdt::EdgeId e) const;
  [[nodiscard]] static bool is_blocked(const FreeSpace& space, cdt::EdgeId e);
  [[nodiscard]] bool has_wall(cdt::EdgeId e) const { return !wall_of_[e.index()].is_none(); }
  void take_out(cdt::EdgeId e);
  void check(const FreeSpace& space, cdt::EdgeId e);
  void keep_common();
  void lay(Edit& edit);
  void remove_gone();
  void settle();
  void find_feet();
  void look_around(cdt::VertexId v);
  void look_between(cdt::EdgeId first, cdt::EdgeId last);
  [[nodiscard]] Direction along_wall(cdt::EdgeId e, cdt::VertexId end) const;
  void find_foot(const Sight& sight, cdt::EdgeId e, int depth);
  [[nodiscard]] bool is_made(cdt::EdgeId e) const {
    return made_in_[cdt::Triangulation::triangle(e).index()] == round_;
  }
  void find_idle_feet();
  [[nodiscard]] bool is_idle(cdt::VertexId foot) const;
  void insert_foot(cdt::Point p);
  void remove_idle_feet();
  void take_over_edit();
  void take_over();
  void open_side(cdt::EdgeId e);
  [[nodiscard]] double gap(cdt::EdgeId e) const;
  [[nodiscard]] cdt::SegmentId side_with(cdt::VertexId foot) const;

  cdt::Triangulation mesh_;
  std::vector<Wall> walls_;  // by constraint
  cdt::Follower<char, Cross> free_;
  std::vector<Way> ways_;                   // by edge
  std::vector<bool> is_foot_;               // by vertex
  std::vector<cdt::ConstraintId> wall_of_;  // by edge of the space, the upward one of two

  // Of one update.
  std::vector<Edit> gone_;
  std::vector<Edit> come_;
  std::vector<cdt::ConstraintId> walls_gone_;
  std::vector<cdt::Point> feet_;
  std::vector<cdt::VertexId> idle_;
  std::vector<cdt::TriangleId> made_;
  std::vector<std::uint64_t> made_in_;  // by triangle: which take_over() had it in made_ last
  std::uint64_t round_ = 0;
  std::vector<cdt::VertexId> around_;
  std::vector<bool> is_around_;
};

/// The foot of the perpendicular from p to the line ab, rounded so that the segment leads through
/// it (cdt::rounds_to), if it is between a and b.
[[nodiscard]] cdt::Point foot_on(cdt::Point p, cdt::Point a, cdt::Point b);

}  // namespace loft::paths
