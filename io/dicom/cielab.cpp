// SPDX-License-Identifier: MIT
#include "io/dicom/cielab.h"

#include <algorithm>
#include <cmath>

namespace loft::io {

namespace {

double from_curve(double t) {
  constexpr double bend = 6.0 / 29;
  return t > bend ? t * t * t : 3 * bend * bend * (t - 4.0 / 29);
}

std::uint8_t to_srgb(double linear) {
  const double share = std::clamp(linear, 0.0, 1.0);
  const double curved =
      share <= 0.0031308 ? 12.92 * share : 1.055 * std::pow(share, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(curved * 255));
}

}  // namespace

Colour from_cielab(const std::array<std::uint16_t, 3>& scaled) {
  constexpr double most = 65535;
  const double lightness = scaled[0] * 100 / most;
  const double a = scaled[1] * 255 / most - 128;
  const double b = scaled[2] * 255 / most - 128;
  const double y = (lightness + 16) / 116;
  // White D65, as that of sRGB.
  constexpr double white_x = 0.95047;
  constexpr double white_z = 1.08883;
  const double tristimulus_x = white_x * from_curve(y + a / 500);
  const double tristimulus_y = from_curve(y);
  const double tristimulus_z = white_z * from_curve(y - b / 200);
  return {
      to_srgb(3.2404542 * tristimulus_x - 1.5371385 * tristimulus_y - 0.4985314 * tristimulus_z),
      to_srgb(-0.9692660 * tristimulus_x + 1.8760108 * tristimulus_y + 0.0415560 * tristimulus_z),
      to_srgb(0.0556434 * tristimulus_x - 0.2040259 * tristimulus_y + 1.0572252 * tristimulus_z)};
}

}  // namespace loft::io
