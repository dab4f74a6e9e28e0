// SPDX-License-Identifier: MIT
#include "io/planar/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace loft::io {

namespace {

struct Hue {
  Colour full;
  Colour dark;
};

constexpr std::array<Hue, hue_count> palette_hues{{
    {{0xe6, 0xd3, 0xa3}, {0x8f, 0x6f, 0x22}},  // sand
    {{0xbf, 0xd8, 0xaa}, {0x4c, 0x7d, 0x2c}},  // sage
    {{0xf2, 0xc4, 0xa0}, {0xb3, 0x58, 0x1c}},  // apricot
    {{0xd5, 0xc0, 0xdf}, {0x7d, 0x4b, 0x92}},  // lilac
    {{0xb0, 0xd8, 0xcc}, {0x22, 0x7d, 0x66}},  // mint
    {{0xf1, 0xdf, 0x8e}, {0x96, 0x7a, 0x08}},  // straw
    {{0xea, 0xb8, 0xb2}, {0xa8, 0x3c, 0x34}},  // rose
    {{0xb9, 0xc9, 0xe6}, {0x37, 0x5c, 0xa0}},  // periwinkle
}};

}  // namespace

std::string to_hex(Colour colour) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
    text += digits[part >> 4U];
    text += digits[part & 0xfU];
  }
  return text;
}

Colour mixed(Colour from, Colour to, double share) {
  const auto mix = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
  };
  return {mix(from.red, to.red), mix(from.green, to.green), mix(from.blue, to.blue)};
}

Colour value_colour(double share) {
  constexpr std::array<Colour, 9> viridis{{{0x44, 0x01, 0x54},
                                           {0x47, 0x2d, 0x7b},
                                           {0x3b, 0x52, 0x8b},
                                           {0x2c, 0x72, 0x8e},
                                           {0x21, 0x91, 0x8c},
                                           {0x28, 0xae, 0x80},
                                           {0x5e, 0xc9, 0x62},
                                           {0xad, 0xdc, 0x30},
                                           {0xfd, 0xe7, 0x25}}};
  const double place = std::clamp(share, 0.0, 1.0) * 8;
  const auto low = std::min<std::size_t>(static_cast<std::size_t>(place), 7);
  return mixed(viridis[low], viridis[low + 1], place - static_cast<double>(low));
}

Colour full_tone(std::size_t hue) { return palette_hues[hue].full; }

Colour pale_tone(std::size_t hue) {
  const auto paler = [](std::uint8_t part) {
    return static_cast<std::uint8_t>(255 - (255 - part) * 2 / 5);
  };
  const Colour full = full_tone(hue);
  return {paler(full.red), paler(full.green), paler(full.blue)};
}

Colour dark_tone(std::size_t hue) { return palette_hues[hue].dark; }

}  // namespace loft::io
