// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "cdt/point.h"

namespace loft::paths {

using cdt::Point;

/// What became of a query.
enum class Status {
  found,
  unreachable,    ///< start and goal are free, and no way leads from one to the other
  start_blocked,  ///< the start is inside an obstacle, outside of everything, or nearer than the
                  ///< radius to what is not free
  goal_blocked,   ///< the same of the goal, where the start is free
  gave_up,        ///< the query's bound on expansions was met, or, for a disc, rounding hid the way
};

/// As it is told: "found", "start blocked".
[[nodiscard]] std::string_view name_of(Status status);

/// From where to where.
struct Query {
  Point from;
  Point to;
  /// Of the disc whose centre moves: 0 or more, and finite.
  double radius = 0;
  /// How many steps a search may take before it gives up.
  std::size_t most_expansions = std::numeric_limits<std::size_t>::max();
};

/// Which way a piece bends.
enum class Turn { straight, left, right };

/// A straight piece of a path, or an arc of the circle around `centre` from one point of it to
/// another, less than half a turn.
struct Piece {
  Point from;
  Point to;
  Turn turn = Turn::straight;
  Point centre{};  ///< of an arc; what the disc rolls around

  friend bool operator==(const Piece&, const Piece&) = default;
};

/// A way that a disc's centre takes. Pieces join: each starts where the one before ended. Equal
/// start and goal give none. Where nothing was found there is none, and the length is infinite.
struct Path {
  Status status = Status::unreachable;
  double length = std::numeric_limits<double>::infinity();
  std::vector<Piece> pieces;

  friend bool operator==(const Path&, const Path&) = default;
};

}  // namespace loft::paths
