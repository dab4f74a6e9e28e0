// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"
#include "tests/cdt/picture.h"

namespace loft::cdt {

/// A constraint as it is inserted. One point alone is a point constraint.
struct Outline {
  std::vector<Point> points;
  Ends ends = open;
  friend bool operator==(const Outline&, const Outline&) = default;
};

/// The constrained Delaunay triangulation of some constraints by brute force, knowing nothing of
/// Triangulation: what it should be, whatever the order of insertion and whatever was there before.
///
/// Vertices are all points and, for every pair of segments that properly cross, the exact crossing
/// correctly rounded. A segment's chain leads through its ends and the vertices that one of its
/// points rounds to, in the order of their coordinates. Cost: squares and worse.
class Reference {
 public:
  explicit Reference(std::span<const Outline> constraints);

  /// Whether the chains' edges meet in common vertices only and no vertex is on an edge that it is
  /// no end of, nor between a segment and its chain. If not, rounding has made the answer above
  /// impossible.
  [[nodiscard]] bool is_embeddable() const;

  /// Vertices, triangles and lines. Precondition: is_embeddable().
  [[nodiscard]] Picture picture() const;

 private:
  /// Smaller end first.
  using Straight = std::pair<Point, Point>;

  void gather_points(std::span<const Outline> constraints);
  void trace_chains(std::span<const Outline> constraints);
  void lead_runs(std::span<const Outline> constraints);
  [[nodiscard]] bool leaves_aside(const std::pair<const Straight, std::vector<Point>>& entry) const;

  std::vector<Point> inputs_;                      // sorted, each once
  std::map<Straight, std::vector<Point>> chains_;  // from the smaller end to the larger
  std::vector<Point> vertices_;                    // sorted, each once
  std::map<Straight, std::vector<Run>> lines_;     // the chains' edges, smaller end first
};

}  // namespace loft::cdt
