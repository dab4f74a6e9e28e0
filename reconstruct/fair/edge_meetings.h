// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// Ends of an edge of a net, the smaller number first.
using NetEdge = std::pair<std::uint32_t, std::uint32_t>;

/// Whether two edges have a place in common but for an end that is the same point of both (exact).
/// Edges without length meet all that they lie on.
[[nodiscard]] bool do_meet(const NetEdge& one, const NetEdge& other,
                           std::span<const cdt::Point> places);

/// The pairs of edges that meet, by their places in `edges`, the smaller first; ascending.
/// Cost: O(n) where few are near each other.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> find_meetings(
    std::span<const NetEdge> edges, std::span<const cdt::Point> places);

}  // namespace loft
