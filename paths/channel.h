// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "paths/dead_ends.h"
#include "paths/free_space.h"
#include "paths/path.h"

namespace loft::paths {

/// The side that two neighbouring triangles of a channel share, as one goes through it.
struct Portal {
  Point left;
  Point right;

  friend bool operator==(const Portal&, const Portal&) = default;
};

/// Free triangles from one point to another, each once and each beside the one before.
struct Channel {
  Status status = Status::unreachable;
  Point from;
  Point to;
  /// The first has the start in it or on its border, the last the goal; none unless found. Valid
  /// until the next edit.
  std::vector<TriangleId> triangles;
  /// Between these, so one fewer.
  std::vector<Portal> portals;

  friend bool operator==(const Channel&, const Channel&) = default;
};

/// The memory of a search for channels, for one thread at a time: once warm, it takes no more.
class ChannelSearch {
 public:
  /// A channel, put in `channel`; see find_channel().
  void find(const FreeSpace& space, Point from, Point to, Channel& channel);
  /// How many steps the last search took.
  [[nodiscard]] std::size_t expansions() const { return expansions_; }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;

  /// A channel so far, to where it enters a triangle: the end of its taut paths.
  struct Entrance {
    EdgeId edge;                  // the triangle on its left is entered
    std::uint32_t before = none;  // the entrance before
    Point root;                   // where these paths turned last, or start
    Point left;                   // the first turns from there, or the ends of the edge
    Point right;
    double length = 0;  // to the root
  };
  struct Entry {
    double estimate;
    std::uint32_t entrance;
  };
  /// The best that is known of an edge.
  struct Best {
    double estimate = 0;
    std::uint32_t search = 0;  // of which query
  };

  [[nodiscard]] EdgeId beyond(EdgeId e) const;
  void begin(const FreeSpace& space, Point from, Point to);
  void start(TriangleId t);
  void expand(std::uint32_t index);
  void enter(const Entrance& entrance);
  [[nodiscard]] bool is_goal(TriangleId t) const;
  [[nodiscard]] double estimate(const Entrance& entrance) const;
  [[nodiscard]] double estimate_goal(const Entrance& entrance) const;
  void put_together(Channel& channel);

  const FreeSpace* space_ = nullptr;
  const Triangulation* mesh_ = nullptr;
  Point from_;
  Point to_;
  std::size_t expansions_ = 0;
  double length_ = 0;          // of the best channel known
  std::uint32_t last_ = none;  // and its last entrance
  bool is_here_ = false;       // the goal is in a triangle of the start
  std::uint32_t search_ = 0;
  std::vector<TriangleId> starts_;
  std::vector<TriangleId> goals_;
  std::vector<Entrance> entrances_;
  std::vector<Entry> heap_;
  std::vector<Best> best_;                // by edge
  std::vector<std::uint32_t> positions_;  // by triangle: in the channel, while it is put together
  std::vector<EdgeId> edges_;             // through which it is entered
  DeadEnds dead_ends_;
  bool knows_dead_ends_ = false;
};

/// A channel in which the way from one point to another is short, by A* over the free triangles
/// (KBT, section 7). What is known of a triangle is one entrance, the most promising, with where
/// taut paths through the channel so far turned last and between which vertices they leave there;
/// the estimate is the length of these, and straight on. Each triangle is entered at most once over
/// each of its sides, so the cost is at most the triangles times log, whatever the scene; the
/// shortest path of all is what shortest_path() finds.
///
/// Statuses are as there; the same scene gives the same channel, whatever was edited before, where
/// the triangulation has no snaps(). Throws std::logic_error if the space is stale.
[[nodiscard]] Channel find_channel(const FreeSpace& space, Point from, Point to);

}  // namespace loft::paths
