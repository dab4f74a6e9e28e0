// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "cdt/point.h"

namespace loft::fields {

/// Values between the ends of a straight line: the same for both directions, bit for bit.
class Along {
 public:
  /// Precondition: a and b are different.
  Along(cdt::Point a, cdt::Point b)
      : is_turned_(b < a),
        low_(is_turned_ ? b : a),
        high_(is_turned_ ? a : b),
        is_steep_(std::abs(high_.y - low_.y) > high_.x - low_.x) {}

  /// How far a place on the line is from the end that comes first to the other, of 0 to 1.
  [[nodiscard]] double part(cdt::Point p) const {
    const double part =
        is_steep_ ? (p.y - low_.y) / (high_.y - low_.y) : (p.x - low_.x) / (high_.x - low_.x);
    return std::clamp(part, 0.0, 1.0);
  }
  /// The value at a place on the line; between those of a and b, and equal to them there.
  [[nodiscard]] double between(double at_a, double at_b, cdt::Point p) const {
    const double start = is_turned_ ? at_b : at_a;
    const double end = is_turned_ ? at_a : at_b;
    const double t = part(p);
    if (t == 1) return end;
    const auto [least, most] = std::minmax(start, end);
    return std::clamp(start + t * (end - start), least, most);
  }
  [[nodiscard]] bool is_turned() const { return is_turned_; }

  /// How much rounding the place, which may put it 2^-50 of its largest coordinate from the line,
  /// and computing can do to the value.
  [[nodiscard]] double slack(double at_a, double at_b) const {
    const double reach =
        std::max({std::abs(low_.x), std::abs(low_.y), std::abs(high_.x), std::abs(high_.y)});
    const double length = is_steep_ ? std::abs(high_.y - low_.y) : high_.x - low_.x;
    const double astray = std::min(1.0, 0x1p-50 * reach / length);
    return std::abs(at_b - at_a) * astray + 0x1p-50 * std::max(std::abs(at_a), std::abs(at_b));
  }

 private:
  bool is_turned_;
  cdt::Point low_;
  cdt::Point high_;
  bool is_steep_;
};

}  // namespace loft::fields
