// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "paths/path.h"

namespace loft::paths {

struct Channel;

/// The side that two neighbouring triangles of a channel share, as one goes through it.
struct Portal {
  Point left;
  Point right;

  friend bool operator==(const Portal&, const Portal&) = default;
};

/// The memory for pulling paths taut, for one thread at a time: once warm, it takes no more.
class Funnel {
 public:
  /// The shortest path in a channel, put in `path`; see pull_taut().
  void pull(const Channel& channel, Path& path);

 private:
  void begin(Point from, std::size_t portals);
  void add_left(Point p, Path& path);
  void add_right(Point p, Path& path);
  void go_to(Point p, Path& path);

  Point at_;  // where the path has come to
  // From the root, where paths part, to the ends of the portal: chain_[root_] back to chain_[left_]
  // and on to chain_[right_].
  std::vector<Point> chain_;
  std::size_t left_ = 0;
  std::size_t root_ = 0;
  std::size_t right_ = 0;
};

/// The shortest path in a channel, by the funnel of Lee and Preparata ("Euclidean shortest paths in
/// the presence of rectilinear barriers", 1984) and Chazelle ("A theorem on polygon cutting with
/// applications", 1982). Every decision is an orientation of given points, and exact: it stays in
/// the channel, turns at vertices alone and only where it must. Its status is that of the channel.
/// Cost: O(triangles of the channel).
[[nodiscard]] Path pull_taut(const Channel& channel);

}  // namespace loft::paths
