// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// What a contour draws, whatever way it is written.
struct NormalForm {
  /// Its places in an order that does not depend on where it starts and which way round it goes,
  /// once if it goes round several times, none given twice in a row.
  std::vector<cdt::Point> places;
  std::vector<std::uint32_t> numbers;  ///< of the points that say it once
  std::size_t laps = 1;                ///< how often it goes round the same points
  bool turns_left = true;              ///< whether it encloses more on its left
};

/// Cost: O(n).
[[nodiscard]] NormalForm normal_form(std::span<const cdt::Point> points);

/// Whether all points are in one line (exact).
[[nodiscard]] bool are_in_line(std::span<const cdt::Point> points);

}  // namespace loft
