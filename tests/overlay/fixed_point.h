// SPDX-License-Identifier: MIT
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <compare>

namespace loft::overlay {

/// Rational numbers to so many binary places that different ones are told apart: those are equal
/// that differ by less than 2^-same. A number has so many bits at most, and so do intermediate
/// products. No allocation.
template <unsigned bits, unsigned places, unsigned same>
class FixedPoint {
 public:
  using Whole = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
      bits, bits, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;

  FixedPoint() = default;
  explicit FixedPoint(const Whole& whole) : units_(whole << places) {}

  [[nodiscard]] static FixedPoint quotient(const Whole& a, const Whole& b) {
    return in_units((a << places) / b);
  }
  /// Of a double times 2^shift, exactly.
  [[nodiscard]] static FixedPoint scaled(double x, int shift) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    const Whole digits(static_cast<long long>(std::ldexp(mantissa, 53)));
    const int up = exponent - 53 + shift + static_cast<int>(places);
    return in_units(up >= 0 ? Whole(digits << up) : Whole(digits >> -up));
  }
  /// The nearest double of this times 2^-shift.
  [[nodiscard]] double to_double(int shift) const {
    constexpr unsigned unsure = places / 4;
    const Whole sure = (abs(units_) + (Whole(1) << (unsure - 1))) >> unsure;
    const double size = std::ldexp(static_cast<double>(sure), int(unsure) - int(places) - shift);
    return units_ < 0 ? -size : size;
  }

  friend FixedPoint operator+(const FixedPoint& a, const FixedPoint& b) {
    return in_units(a.units_ + b.units_);
  }
  friend FixedPoint operator-(const FixedPoint& a, const FixedPoint& b) {
    return in_units(a.units_ - b.units_);
  }
  friend FixedPoint operator*(const FixedPoint& a, const FixedPoint& b) {
    return in_units((a.units_ * b.units_) >> places);
  }
  friend FixedPoint operator*(const FixedPoint& a, const Whole& b) {
    return in_units(a.units_ * b);
  }
  friend FixedPoint operator/(const FixedPoint& a, const Whole& b) {
    return in_units(a.units_ / b);
  }

  friend std::weak_ordering operator<=>(const FixedPoint& a, const FixedPoint& b) {
    const Whole difference = a.units_ - b.units_;
    static const Whole noise = Whole(1) << (places - same);
    if (difference > noise) return std::weak_ordering::greater;
    return difference < -noise ? std::weak_ordering::less : std::weak_ordering::equivalent;
  }
  friend bool operator==(const FixedPoint& a, const FixedPoint& b) { return (a <=> b) == 0; }

 private:
  [[nodiscard]] static FixedPoint in_units(Whole units) {
    FixedPoint result;
    result.units_ = std::move(units);
    return result;
  }

  Whole units_ = 0;  // 2^-places each
};

}  // namespace loft::overlay
