// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace loft::io {

/// Heights that files scatter by rounding (36.000003814697266 beside 36), brought together.
///
/// Those that are apart by no more than a hundredth of the median gap are one: the one that most of
/// them have, the lowest of these; never a mean. Gaps of a millionth of the heights are rounding,
/// and no part of the median, unless all are.
class HeightGroups {
 public:
  /// `heights`: one of each contour. Precondition: finite. Cost: O(n log n).
  explicit HeightGroups(std::vector<double> heights);

  /// The height of the group that a height belongs to; itself where it is none of those known.
  [[nodiscard]] double of(double height) const;
  /// What is apart by no more is one.
  [[nodiscard]] double tolerance() const { return tolerance_; }

 private:
  struct Group {
    double lowest;
    double highest;
    double height;
  };
  std::vector<Group> groups_;  // ascending
  double tolerance_ = 0;
};

}  // namespace loft::io
