// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <iterator>
#include <string>

#include "reconstruct/number_text.h"

namespace loft {

/// `there is no slice at z = 14.603; the nearest is at z = 14.60316`. `by_height` is a map whose
/// keys are the heights that there are; of two as near, the lower one is named.
template <class Map>
[[nodiscard]] std::string no_slice_at(double z, const Map& by_height) {
  const std::string words = "there is no slice at z = " + exact(z);
  if (by_height.empty()) return words + "; there are no slices";
  auto nearest = std::isnan(z) ? by_height.begin() : by_height.lower_bound(z);
  const bool is_above_all = nearest == by_height.end();
  if (nearest != by_height.begin() && !std::isnan(z)) {
    const auto below = std::prev(nearest);
    if (is_above_all || z - below->first <= nearest->first - z) nearest = below;
  }
  return words + "; the nearest is at z = " + exact(nearest->first);
}

}  // namespace loft
