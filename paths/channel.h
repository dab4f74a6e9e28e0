// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "paths/dead_ends.h"
#include "paths/ends.h"
#include "paths/free_space.h"
#include "paths/funnel.h"
#include "paths/path.h"

namespace loft::paths {

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

  /// What taut paths turn around, or start or end at; with what comes before each, a tree.
  struct Turning {
    Point place;
    double length = 0;            // of the way here
    std::uint32_t before = none;  // the one before
  };
  /// A channel so far, to where it enters a triangle: paths to the ends of that side part at a
  /// root, and from there one turns left, and one right, only.
  struct Entrance {
    EdgeId edge;                  // the triangle on its left is entered
    std::uint32_t before = none;  // the entrance before
    std::uint32_t root = none;    // turnings
    std::uint32_t left = none;    // at the ends of the edge
    std::uint32_t right = none;
  };
  struct Entry {
    double estimate = 0;
    std::uint32_t entrance = none;
  };
  /// How near the ends of an edge are, through whichever entrance.
  struct Best {
    double to_left = 0;
    double to_right = 0;
    std::uint32_t search = 0;  // of which query
  };
  enum class Chain : std::uint8_t { none, left, right };
  /// Where a path to a point beyond an entrance turns last, and on which side.
  struct LastTurn {
    std::uint32_t turning;
    Chain chain;
  };

  [[nodiscard]] EdgeId beyond(EdgeId e) const { return dead_ends_.beyond(*space_, e); }
  void begin(const FreeSpace& space, Point from, Point to);
  void start(TriangleId t);
  void expand(std::uint32_t index);
  void enter(const Entrance& entrance);
  void push(Entry entry);
  [[nodiscard]] std::uint32_t pop();
  [[nodiscard]] std::uint32_t add_turning(Point place, std::uint32_t before);
  [[nodiscard]] LastTurn last_turn(const Entrance& entrance, Point p) const;
  [[nodiscard]] double estimate(const Entrance& entrance) const;
  void put_together(Channel& channel);

  const FreeSpace* space_ = nullptr;
  const Triangulation* mesh_ = nullptr;
  Point to_;
  std::size_t expansions_ = 0;
  std::uint32_t last_ = none;  // the entrance to the goal's triangle
  std::uint32_t search_ = 0;
  Ends ends_;
  std::vector<Turning> turnings_;
  std::vector<Entrance> entrances_;
  Entry next_;                            // the most promising one found since the last pop()
  std::vector<Entry> heap_;               // all others
  std::vector<Best> best_;                // by edge
  std::vector<std::uint32_t> positions_;  // by triangle: in the channel, while it is put together
  std::vector<EdgeId> edges_;             // through which it is entered
  DeadEnds dead_ends_;
};

/// A channel in which the way from one point to another is short, by A* over the free triangles
/// (KBT, section 7). Of all ways to a side of a triangle, those are kept through which one of its
/// ends is nearer than through any known before. Estimates are lengths of paths that are taut in
/// the channel so far, with nothing in the way from there to the goal. So the path pulled taut is
/// seldom longer than shortest_path(), and takes less time to find: where that looks through a side
/// from every corner before it, this comes through once or twice.
///
/// Cost: to locate both points if there is no way; else in practice the triangles nearer to the
/// start than the goal is, times log.
///
/// Statuses are those of shortest_path(); the same scene gives the same channel, whatever was
/// edited before, where the triangulation has no snaps(). Throws std::logic_error if the space is
/// stale.
[[nodiscard]] Channel find_channel(const FreeSpace& space, Point from, Point to);

}  // namespace loft::paths
