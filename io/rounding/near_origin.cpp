// SPDX-License-Identifier: MIT
#include "io/rounding/near_origin.h"

#include <cmath>

#include "io/meshes/extent.h"

namespace loft::io {

namespace {

/// Near the middle of a box, in round numbers: multiples of a power of ten that is no larger than
/// the box.
Vec3 round_place_near(const Box3& box) {
  const double size = longest_side(box);
  if (!(size > 0)) return centre_of(box);
  const double step = std::pow(10, std::floor(std::log10(size)));
  Vec3 place = centre_of(box);
  for (double& coordinate : place) coordinate = std::round(coordinate / step) * step;
  return place;
}

}  // namespace

RoundedParts round_as_they_are(std::span<const Part> parts, std::optional<Vec3>& origin,
                               unsigned threads) {
  const auto about = [parts, threads](const Vec3& place) {
    return RoundedParts(parts, {place}, true, threads);
  };
  if (origin) return about(*origin);
  const Box3 box = extent(parts);
  const Vec3 near = round_place_near(box);
  if (!is_coarse(box, 0x1p-13)) {
    RoundedParts about_zero = about({});
    if (about_zero.rounding().left == 0) return about_zero;
    RoundedParts about_near = about(near);
    if (about_near.rounding().left >= about_zero.rounding().left) return about_zero;
  }
  origin = near;
  return about(near);
}

}  // namespace loft::io
