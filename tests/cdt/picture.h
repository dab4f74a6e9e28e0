// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// A segment running along an edge: which one of which constraint, and whether it runs towards the
/// edge's lexicographically larger end.
struct Run {
  std::size_t constraint = 0;
  std::size_t segment = 0;
  bool upward = false;
  friend auto operator<=>(const Run&, const Run&) = default;
};

/// A constrained edge and everything that runs along it, sorted.
struct Line {
  Point low;
  Point high;
  std::vector<Run> runs;
  friend bool operator==(const Line&, const Line&) = default;
};

using Corners = std::array<Point, 3>;

/// All that a triangulation says, by coordinates and sorted: equal for equal triangulations,
/// whatever their ids. Triangles are counter-clockwise from their smallest corner and finite.
struct Picture {
  std::vector<Point> vertices;
  std::vector<Corners> triangles;
  std::vector<Line> lines;
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// The picture of a triangulation whose i-th constraint has the i-th id.
[[nodiscard]] Picture picture_of(const Triangulation& mesh, std::span<const ConstraintId> ids);

/// The first thing that two pictures disagree about, in words; empty if they are equal.
[[nodiscard]] std::string difference(const Picture& actual, const Picture& expected);

}  // namespace loft::cdt
