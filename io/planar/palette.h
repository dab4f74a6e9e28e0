// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "reconstruct/stack.h"

namespace loft::io {

/// As SVG and CSS have it: `#e9f1f6`.
[[nodiscard]] std::string to_hex(Colour colour);

/// What is a share of the way, 0 to 1, from one colour to another.
[[nodiscard]] Colour mixed(Colour from, Colour to, double share);

/// Calm hues, told apart by number.
constexpr std::size_t hue_count = 8;

/// What is inside an odd number of constraints; paler, an even number; the line around it.
[[nodiscard]] Colour full_tone(std::size_t hue);
[[nodiscard]] Colour pale_tone(std::size_t hue);
[[nodiscard]] Colour dark_tone(std::size_t hue);

/// From dark to light, 0 to 1, as even to the eye and to those who see fewer colours: viridis, by
/// Nathaniel Smith and Stéfan van der Walt (CC0), from every eighth of it.
[[nodiscard]] Colour value_colour(double share);

constexpr Colour outside_tone{0xe8, 0xf0, 0xf5};  ///< of what nothing encloses
constexpr Colour shared_tone{0x3a, 0x43, 0x50};   ///< of edges with several constraints
constexpr Colour edge_tone{0x6b, 0x7a, 0x8c};     ///< of edges without constraint

}  // namespace loft::io
