// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "cdt/expansion.h"

namespace loft::cdt {

/// An exact sum of doubles and of products of coordinates, however many: an integer of fixed width
/// in digits of 32 bits, whose carries wait (Neal, "Fast exact summation using small and large
/// superaccumulators", 2015). Unlike an Expansion it does not grow, and equal sums are equal
/// whatever was added in whatever order.
///
/// Precondition of what is added: finite, of magnitude 0 or 2^-459 to 2^511, as are coordinates
/// that is_usable(), their products, and what two_product() leaves of these; and fewer than 2^32
/// of the largest.
class ExactSum {
 public:
  ExactSum() = default;

  /// Cost: constant, three digits.
  void add(double term);
  /// Adds a * b.
  void add_product(double a, double b) {
    const auto [high, low] = two_product(a, b);
    add(high);
    add(low);
  }
  /// Subtracts a * b.
  void subtract_product(double a, double b) { add_product(-a, b); }

  ExactSum& operator+=(const ExactSum& other);
  ExactSum& operator-=(const ExactSum& other);
  [[nodiscard]] ExactSum operator-() const;
  friend ExactSum operator+(ExactSum a, const ExactSum& b) { return a += b; }
  friend ExactSum operator-(ExactSum a, const ExactSum& b) { return a -= b; }

  /// -1, 0 or +1.
  [[nodiscard]] int sign() const;
  /// The nearest double, ties to even, of the sum times 2^shift.
  [[nodiscard]] double to_double(int shift = 0) const;

  friend std::strong_ordering operator<=>(const ExactSum& a, const ExactSum& b) {
    return (a - b).sign() <=> 0;
  }
  friend bool operator==(const ExactSum& a, const ExactSum& b) { return (a - b).sign() == 0; }

 private:
  static constexpr int lowest_bit = -512;  // what 1 in the first digit stands for
  static constexpr std::size_t digits = 34;
  static constexpr std::uint32_t most_waiting = 1U << 29;

  using Digits = std::array<std::int64_t, digits>;

  void carry();
  [[nodiscard]] Digits carried() const;

  Digits digits_{};            // of 32 bits and what waits to be carried
  std::uint32_t waiting_ = 0;  // additions since the last carry
};

}  // namespace loft::cdt
