// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/fair/outline_net.h"

namespace loft::io {

/// Outlines of pixels that run from one square between four pixel centres to the next, with one
/// point in each, or two where it is halved. Centres are whole numbers.
class SquareOutlines {
 public:
  /// Halves of a square: on the side of its lower left corner and of the opposite one, or of the
  /// lower right one and the opposite one.
  enum class Half : std::uint8_t { none, lower_left, upper_right, lower_right, upper_left };

  /// A line goes through the square whose lower left corner is there.
  void add(std::uint32_t x, std::uint32_t y, Half half);
  void end_outline() { net_.end_loop(); }

  /// The places of all points, fair.
  [[nodiscard]] std::vector<cdt::Point> fair() const;
  [[nodiscard]] const OutlineNet& net() const { return net_; }

 private:
  [[nodiscard]] cdt::Point inside(std::uint32_t point, cdt::Point wanted) const;

  OutlineNet net_;  // points: the middles of the squares
  std::vector<Half> halves_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_;  // of a square's point
};

}  // namespace loft::io
