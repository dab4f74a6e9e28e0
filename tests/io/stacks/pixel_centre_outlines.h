// SPDX-License-Identifier: MIT
// Outlines through the centres of pixels, as OpenCV finds them and rt-utils writes them.
#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace loft::io::testing {

using Pixel = std::array<int, 2>;  ///< column, row
using Mask = std::set<Pixel>;

/// Follows the border of a mask, whose pixels hang together by corners, from one that has a pixel
/// outside at its left (of outer borders) or right (of holes); notes the pixels that have outside
/// on their right on the way. (S. Suzuki, K. Abe, 1985)
inline std::vector<Pixel> followed(const Mask& mask, const Pixel& start, bool is_hole,
                                   Mask& right_is_outside, Mask& met) {
  constexpr std::array<Pixel, 8> around{
      {{1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  const auto at = [&](const Pixel& from, std::size_t direction) {
    return Pixel{from[0] + around[direction % 8][0], from[1] + around[direction % 8][1]};
  };
  met.insert(start);
  // Clockwise from the pixel outside to the first one inside.
  std::size_t to_last = is_hole ? 8 : 4;
  std::size_t turns = 0;
  while (turns < 8 && !mask.contains(at(start, to_last))) {
    to_last += 7;
    ++turns;
  }
  if (turns == 8) {
    right_is_outside.insert(start);
    return {start};
  }
  const Pixel last = at(start, to_last);
  std::vector<Pixel> border;
  Pixel here = start;
  std::size_t from = to_last % 8;
  while (true) {
    // Counter-clockwise from where it came.
    std::size_t to = from + 1;
    while (!mask.contains(at(here, to))) {
      if (to % 8 == 0) right_is_outside.insert(here);
      ++to;
    }
    border.push_back(here);
    met.insert(here);
    const Pixel next = at(here, to);
    if (next == start && here == last) return border;
    from = (to + 4) % 8;
    here = next;
  }
}

/// The corners of a border.
inline std::vector<Pixel> corners(const std::vector<Pixel>& border) {
  std::vector<Pixel> result;
  const std::size_t n = border.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Pixel& a = border[(i + n - 1) % n];
    const Pixel& b = border[i];
    const Pixel& c = border[(i + 1) % n];
    if (n < 3 || b[0] - a[0] != c[0] - b[0] || b[1] - a[1] != c[1] - b[1]) result.push_back(b);
  }
  return result;
}

/// All borders of a mask, around parts and around their holes.
inline std::vector<std::vector<Pixel>> pixel_centre_outlines(const Mask& mask) {
  std::vector<std::vector<Pixel>> result;
  Mask right_is_outside;
  Mask met;
  std::set<std::pair<int, int>> rows;  // row, column: as they are read
  for (const Pixel& pixel : mask) rows.insert({pixel[1], pixel[0]});
  for (const auto& [row, column] : rows) {
    const Pixel pixel{column, row};
    const bool is_outer = !mask.contains({column - 1, row}) && !met.contains(pixel);
    const bool is_hole = !mask.contains({column + 1, row}) && !right_is_outside.contains(pixel);
    if (is_outer) result.push_back(corners(followed(mask, pixel, false, right_is_outside, met)));
    if (!is_outer && is_hole)
      result.push_back(corners(followed(mask, pixel, true, right_is_outside, met)));
  }
  return result;
}

}  // namespace loft::io::testing
