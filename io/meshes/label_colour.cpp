// SPDX-License-Identifier: MIT
#include "io/meshes/label_colour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/bytes/text.h"
#include "io/bytes/utf8.h"

namespace loft::io {

namespace {

/// FNV-1a, and a finaliser that lets each byte move each bit.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 0xcbf2'9ce4'8422'2325;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100'0000'01b3;
  value = (value ^ (value >> 30U)) * 0xbf58'476d'1ce4'e5b9;
  value = (value ^ (value >> 27U)) * 0x94d0'49bb'1331'11eb;
  return value ^ (value >> 31U);
}

/// 16 bits of the hash as a number from 0 to below 1.
double share(std::uint64_t hash, unsigned place) {
  return static_cast<double>((hash >> (16 * place)) & 0xffffU) / 65536.0;
}

}  // namespace

std::array<double, 3> label_colour(std::string_view label) {
  const std::string name = json_text(one_line(label));
  if (name.empty() || name == "surface") return {0.80, 0.72, 0.58};
  const std::uint64_t bits = hash(name);
  const double hue = share(bits, 0) * 6;
  const double brightest = 0.45 + 0.4 * share(bits, 1);
  const double depth = brightest * (0.55 + 0.35 * share(bits, 2));
  const auto channel = [=](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return brightest - depth * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
  };
  return {channel(5), channel(3), channel(1)};
}

std::array<double, 3> linear(Colour colour) {
  const auto channel = [](std::uint8_t value) {
    const double share = value / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

Colour srgb(const std::array<double, 3>& linear) {
  const auto channel = [](double share) {
    const double curved =
        share <= 0.0031308 ? share * 12.92 : 1.055 * std::pow(share, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::round(255 * std::clamp(curved, 0.0, 1.0)));
  };
  return {channel(linear[0]), channel(linear[1]), channel(linear[2])};
}

Colour colour_of(const Part& part) {
  return part.colour ? *part.colour : srgb(label_colour(part.label));
}

}  // namespace loft::io
