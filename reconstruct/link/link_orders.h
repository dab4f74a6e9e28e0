// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reconstruct/link/ends.h"
#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft {

/// What is wrong with orders that no stack could meet: slices or contours that are not there,
/// slices that are not neighbours, contours of different labels, orders that contradict each other.
/// One line a problem, with the order's place.
[[nodiscard]] std::vector<std::string> find_bad_orders(std::span<const Slice> slices,
                                                       std::span<const LinkOrder> orders);

/// An order to one slab: the loops, or the line, that each of its two contours became.
struct SlabOrder {
  std::uint32_t order = 0;  ///< index among all orders
  bool is_link = true;
  std::vector<std::uint32_t> lower;  ///< loops of the lower region
  std::vector<std::uint32_t> upper;
  std::optional<std::uint32_t> lower_line{};
  std::optional<std::uint32_t> upper_line{};

  /// Whether it is about a point or a line: what ends in one does so without an order.
  [[nodiscard]] bool has_line() const { return lower_line || upper_line; }
};

/// An order that was not met, and why.
struct Refusal {
  std::uint32_t order = 0;
  std::string reason;
};

/// `links.ndjson:3: not linked with slice 4 contour 2: its tiles would meet ...`
[[nodiscard]] std::string describe(const LinkOrder& order, const Refusal& refusal);

/// The orders for contours with that label; all where it is not set. Precondition:
/// find_bad_orders() finds nothing.
[[nodiscard]] std::vector<LinkOrder> orders_for(const std::optional<std::string>& label,
                                                std::span<const Slice> slices,
                                                std::span<const LinkOrder> orders);

/// Sorts orders out among the slabs between `regions`. Those whose contours cleaning has left
/// nothing of are refused; those with contours of none of the regions' slices are left out.
[[nodiscard]] std::vector<std::vector<SlabOrder>> orders_of_slabs(std::span<const Region> regions,
                                                                  std::span<const LinkOrder> orders,
                                                                  std::vector<Refusal>& refusals);

/// The tiles of a slab as its own two slices and orders have them.
struct OrderedTiles {
  TileSet tiles;
  Pieces pieces;
  std::vector<EndLink> wanted;     ///< cavities to link
  std::vector<EndLink> forbidden;  ///< ends that must not be linked, or joined to a piece
  std::vector<Refusal> refusals;
};

/// The parts of both slices are joined into groups: those that overlap, unless that is forbidden,
/// and those that are to be linked. Each group that is not what overlap alone makes is tiled by
/// itself; linked parts that do not overlap are moved over each other; a part without another ends
/// before half way. All these tiles must not meet (exact test), else the last order that takes part
/// in it is refused and the slab done again without it. LinkRule::none leaves only the linked ones.
/// Without orders and for the other rules this is tile(). With LinkRule::automatic, pieces slide.
/// Parts that end in points or lines of the other slice are tiled first (find_tips()), whatever the
/// rule; the rest as if they were not there.
[[nodiscard]] OrderedTiles tile_by_orders(const Region& lower, const Region& upper,
                                          const Options& options, std::span<const SlabOrder> orders,
                                          TileWorkspace& workspace);

}  // namespace loft
