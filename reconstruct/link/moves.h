// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reconstruct/link/pieces.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/registration/registration.h"

namespace loft {

/// Pieces tiled by themselves, moved over each other first.

/// From the centroid of a piece's upper footprint to that of its lower one, rounded to 2^-40 of it:
/// points moved by it lose little, and it does not depend on the order of sums.
[[nodiscard]] cdt::Point offset(const Piece& piece);

/// Parts that were moved over each other to be linked must overlap that much.
inline constexpr double least_overlap = 0.4;

/// The share of what two footprints cover together that both cover, by the area between them.
[[nodiscard]] double overlap(const Piece& piece, double difference);

/// The area in one of a piece's footprints only, as they are. Measured on tiles that keep their
/// crossings: without them some lie over others, and cover more.
[[nodiscard]] double overlay_difference(const Region& lower, const Region& upper,
                                        const Piece& piece);

/// The tiles of a piece by itself, its upper part moved by its shift; and how far the two parts
/// overlap then.
struct Moved {
  TileSet tiles;
  Piece piece;
  double difference = 0;
};

/// As a whole, by the piece's shift. None if there are no valid tiles, or if it would take tests of
/// more than `most_pairs` pairs of them to know.
[[nodiscard]] std::optional<Moved> move_by_shift(const Region& lower, const Region& upper,
                                                 Piece piece, std::size_t most_pairs = any_number);

/// As the outlines match of a piece that has as many outlines and as many holes in both slices
/// (reconstruct/registration), from where it is or from over each other, whichever leaves
/// less of a difference. None if there are no valid tiles, or if these are not wanted.
[[nodiscard]] std::optional<Moved> move_by_loops(
    const Region& lower, const Region& upper, const Piece& piece,
    const IsWanted& is_wanted = [](const Registered&) { return true; });

/// As the places of its outlines match, however many it has, from where `ways` take them.
[[nodiscard]] std::optional<Moved> move_by_places(const Region& lower, const Region& upper,
                                                  const Piece& piece, const IsWanted& is_wanted,
                                                  const LoopWays& ways = {});

/// Loops that have ways by these, over what the others match with among themselves.
[[nodiscard]] std::optional<Moved> move_by_ways(const Region& lower, const Region& upper,
                                                const Piece& piece, const IsWanted& is_wanted,
                                                const LoopWays& ways);

/// Puts it into the place of some pieces.
[[nodiscard]] Replacement replacement(Moved moved, std::vector<std::uint32_t> replaced);

/// Moves that would take more tests of pairs of tiles than that are not made: a typical one takes
/// a few dozen for each point.
[[nodiscard]] constexpr std::size_t most_pairs_of(std::size_t points) {
  return 1'000'000 + 1000 * points;
}

}  // namespace loft
