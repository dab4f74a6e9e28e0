// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/registration/matching.h"
#include "reconstruct/registration/outline.h"

namespace loft {

/// Finds that of some stretches which is nearest to another by place and direction: the square of
/// their distance and `direction_weight` (a length, squared) times the difference of their
/// directions (1 - cosine) together are the square of a distance in four dimensions, in which the
/// stretches are put into a tree (Bentley, 1975).
class StretchTree {
 public:
  /// Cost: O(n log n).
  StretchTree(std::span<const Stretch> stretches, double direction_weight);

  struct Nearest {
    std::uint32_t index;
    double cost;
  };
  /// The first of equal ones. Precondition: there is one. Cost: O(log n) in practice.
  [[nodiscard]] Nearest nearest(const Stretch& stretch) const;
  /// All that are nearest, but for rounding, in no special order. Cost: that of one, and each.
  void all_nearest(const Stretch& stretch, std::vector<std::uint32_t>& found) const;

 private:
  using Key = std::array<double, 4>;
  struct Item {
    Key key;
    std::uint32_t index;
    unsigned axis = 0;  // along which it parts its range
  };

  [[nodiscard]] Key key(const Stretch& stretch) const;
  void build(std::size_t first, std::size_t last);
  void search(std::size_t first, std::size_t last, const Key& wanted, Nearest& best) const;
  void gather(std::size_t first, std::size_t last, const Key& wanted, double most,
              std::vector<std::uint32_t>& found) const;

  double direction_;         // how long a direction is
  std::vector<Item> items_;  // the middle one of a range parts the others
};

/// Which stretches of two regions belong together, if nothing is known of their loops: each with
/// that of the other which is nearest to it by place and direction, or with all that are, but for
/// rounding. Cost: O(n log n) in practice.
[[nodiscard]] std::vector<Match> match_nearest(std::span<const Stretch> lower,
                                               std::span<const Stretch> upper,
                                               double direction_weight);

/// The mean square, over their lengths, of the way to the nearest stretch of the other: the larger
/// of both means.
/// Cost: O(n log n) in practice.
[[nodiscard]] double mean_square_distance(std::span<const Stretch> lower,
                                          std::span<const Stretch> upper);

}  // namespace loft
