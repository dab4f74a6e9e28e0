// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "io/planar/map.h"
#include "io/planar/path_queries.h"

namespace loft::io {

// The formats of the MovingAI benchmarks (Sturtevant, "Benchmarks for Grid-Based Pathfinding",
// 2012): maps of cells, and scenarios of queries in them. Cells are unit squares, x to the right
// and y downwards: the cell in column c of row r is between c and c + 1, r and r + 1.

/// Reads a map: lines `type NAME`, `height H`, `width W`, `map`, then H rows of W cells. `.`, `G`
/// and `S` are free, all else is blocked. What is free is one feature with the property layer,
/// `free`: its outlines along the cells, with corners alone, so integers. Cells that touch in a
/// corner alone do not hang together there. Outer rings are counter-clockwise where y is upwards,
/// holes clockwise, each in its polygon; a ring may touch itself and others in corners.
///
/// Throws InputError that names `name` and line of each bad place, or says that nothing is free.
/// Cost: O(cells); memory goes by the rows that are there, not by what the head says.
[[nodiscard]] Map read_moving_ai_map(std::string_view text, std::string_view name);

/// Reads a scenario: a line `version 1`, then lines of `bucket map width height x0 y0 x1 y1
/// length`. The coordinates are taken as they are: corners of cells, not their middles.
///
/// Throws InputError that names `name` and line of each bad place, or says that there is no query.
/// Cost: O(n).
[[nodiscard]] std::vector<PathQuery> read_moving_ai_scenario(std::string_view text,
                                                             std::string_view name);

}  // namespace loft::io
