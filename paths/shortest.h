// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "paths/dead_ends.h"
#include "paths/disc_search.h"
#include "paths/ends.h"
#include "paths/free_space.h"
#include "paths/path.h"

namespace loft::paths {

/// The memory of a search, for one thread at a time: once warm, queries take no more.
class Workspace {
 public:
  /// The shortest path, put in `path`; see shortest_path().
  void find(const FreeSpace& space, const Query& query, Path& path);
  /// How many steps the last search took.
  [[nodiscard]] std::size_t expansions() const { return expansions_; }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;

  /// Where a path turns, or starts.
  struct Root {
    Point place;
    double length = 0;            // of the way here
    std::uint32_t before = none;  // the root before
    EdgeId corner;                // FreeSpace::corner(); none for the start
  };
  /// An end of what a root sees of an edge: on the ray to a vertex, or, turned, on the ray along
  /// which the path came to the root.
  struct Ray {
    Point to;
    bool is_extension = false;
    bool is_at_end = false;  // the vertex is the edge's own end
  };
  /// What a root sees of an edge. The triangle on its left is next; the root is on its right.
  struct Interval {
    EdgeId edge;
    std::uint32_t root = none;
    Ray left;
    Ray right;
  };
  enum class Side : std::uint8_t { left, right };
  /// A path that comes to a vertex, to turn there: around what is free from `edge` on.
  struct Bend {
    EdgeId edge;
    std::uint32_t root = none;
    Side side = Side::left;
    bool is_cut = false;  // the ray that came here goes through the triangle left of `edge`
    double length = 0;
  };
  struct Step {
    Interval interval;
    Bend bend;
    bool is_bend = false;
  };
  struct Entry {
    double estimate;  // no path through here is shorter
    std::uint32_t step;
  };
  /// The shortest way known to a corner.
  struct Best {
    double length = 0;
    std::uint32_t search = 0;  // of which query
    std::uint8_t sides = 0;    // on which it was reached so
  };

  /// The twin of an edge, if a path may go there.
  [[nodiscard]] EdgeId beyond(EdgeId e) const { return dead_ends_.beyond(*space_, e); }
  void begin(const FreeSpace& space, const Query& query);
  void start(TriangleId t);
  void expand(Interval interval);
  void expand(const Bend& bend);
  void turn_at(EdgeId corner, const Interval& interval, Side side, EdgeId fan, bool is_cut);
  void push(const Interval& interval);
  void push(double estimate, const Step& step);
  void see_goal(std::uint32_t root);
  void put_together(Path& path) const;
  void straighten(const Query& query, Path& path) const;
  [[nodiscard]] int side_of(const Interval& interval, const Ray& ray, Point p) const;
  [[nodiscard]] double estimate(const Interval& interval) const;
  [[nodiscard]] double through_end(const Interval& interval, const Ray& ray, Point end, Point a,
                                   Point b, Point goal) const;

  const FreeSpace* space_ = nullptr;
  const Triangulation* mesh_ = nullptr;
  Point goal_;
  std::size_t expansions_ = 0;
  double length_ = 0;          // of the shortest path known
  std::uint32_t last_ = none;  // and its last root
  std::uint32_t search_ = 0;
  Ends ends_;
  std::vector<Root> roots_;
  std::vector<Step> steps_;
  std::vector<Entry> heap_;
  std::vector<Best> best_;  // by FreeSpace::corner()
  DeadEnds dead_ends_;
  DiscSearch disc_;
};

/// The shortest path from one point to another (Polyanya: Cui, Harabor, Grastien, "Compromise-free
/// Pathfinding on a Navigation Mesh", 2017), on the triangles that there are. What is seen of an
/// edge is kept as the vertices that bound the view, so that every decision is an orientation of
/// given points, and exact: a path never crosses an obstacle, turns at vertices of obstacles alone
/// and there only where it must. Its length is off by rounding, of sums of square roots, alone.
///
/// Where several are as short, coordinates decide: the same scene and query give the same path, bit
/// for bit, whatever was edited before, where the triangulation has no snaps().
///
/// A disc, radius above 0, finds its way by the gaps (FreeSpace::keep_gaps(), gaps.h), around
/// circles instead of corners, in straight pieces and arcs. Whether there is a way is decided
/// exactly, and a gap as wide as the disc is passed; no piece comes nearer to anything than the
/// radius, but for rounding (sweep.h). That the way is the shortest is not proven: it was, in
/// tests, to 1e-9.
///
/// Cost: to locate both points if there is no way for a point; else in practice the edges nearer to
/// the start than the goal is, times log. A disc that has no way looks at all that it gets to.
/// Throws std::logic_error if the space is stale, or keeps no gaps and the radius is above 0, and
/// std::invalid_argument if that is negative or not finite.
[[nodiscard]] Path shortest_path(const FreeSpace& space, const Query& query);

}  // namespace loft::paths
