// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace loft::cdt {

/// Exact arithmetic on sums of doubles, after Shewchuk, "Adaptive Precision Floating-Point
/// Arithmetic and Fast Robust Geometric Predicates" (1997). Everything here is exact as long as
/// nothing over- or underflows, rounding is to nearest-even and every operation rounds to double
/// (no contraction, no extended precision, no -ffast-math).

/// The exact value of an operation on two doubles: `high` is the rounded result, `low` its error.
struct TwoTerms {
  double high;
  double low;
};

/// a + b.
[[nodiscard]] inline TwoTerms two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  const double a_part = high - b_part;
  return {high, (a - a_part) + (b - b_part)};
}

/// a + b where |a| >= |b| or a == 0.
[[nodiscard]] inline TwoTerms fast_two_sum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

/// a - b.
[[nodiscard]] inline TwoTerms two_diff(double a, double b) { return two_sum(a, -b); }

/// a as a sum of two doubles of 26 bits each, so that products of halves are exact (Dekker 1971).
[[nodiscard]] inline TwoTerms split(double a) {
  constexpr double splitter = 134217729;  // 2^27 + 1
  const double c = splitter * a;
  const double high = c - (c - a);
  return {high, a - high};
}

/// a * b. Not by std::fma, which is a slow library call where the processor has no such
/// instruction.
[[nodiscard]] inline TwoTerms two_product(double a, double b) {
  const double high = a * b;
  const auto [a_high, a_low] = split(a);
  const auto [b_high, b_low] = split(b);
  const double error = high - a_high * b_high - a_low * b_high - a_high * b_low;
  return {high, a_low * b_low - error};
}

/// An exact real number: a sum of at most N doubles that do not overlap, in increasing magnitude,
/// without zeros. The empty sum is 0. The operators return types large enough for every result and
/// cost time in proportion to the terms that are there (product: to the square), not to N.
template <std::size_t N>
class Expansion {
 public:
  Expansion() {}  // not "= default": terms_ stays uninitialised on purpose, it may be large
  explicit Expansion(double value) { append(value); }
  explicit Expansion(TwoTerms value) {
    append(value.low);
    append(value.high);
  }
  Expansion(const Expansion& other) { *this = other; }
  /// The same value in another capacity. Precondition: other.size() <= N.
  template <std::size_t M>
  explicit Expansion(const Expansion<M>& other) {
    for (std::size_t i = 0; i < other.size(); ++i) append(other[i]);
  }
  Expansion& operator=(const Expansion& other) {
    size_ = other.size_;
    for (std::size_t i = 0; i < size_; ++i) terms_[i] = other.terms_[i];
    return *this;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double operator[](std::size_t i) const { return terms_[i]; }

  /// -1, 0 or +1. The last term outweighs all others.
  [[nodiscard]] int sign() const {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0 ? 1 : -1;
  }

  /// The value as one double, off by at most 2^-52 of it.
  [[nodiscard]] double estimate() const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i) sum += terms_[i];
    return sum;
  }

  /// Adds a term that does not overlap the ones there and is larger than they are; 0 adds nothing.
  /// Where something has overflowed nothing is exact any more: infinities and what is not a number
  /// are dropped, and so is what would be one term too many.
  void append(double term) {
    if (term == 0) return;
    const bool fits = size_ < N && std::isfinite(term);
    assert(fits && "exact arithmetic has overflowed");
    if (fits) terms_[size_++] = term;
  }

 private:
  std::size_t size_ = 0;
  std::array<double, N> terms_;
};

/// a - b, exactly.
[[nodiscard]] inline Expansion<2> exact_diff(double a, double b) {
  return Expansion<2>(two_diff(a, b));
}

template <std::size_t N>
[[nodiscard]] Expansion<N> operator-(const Expansion<N>& e) {
  Expansion<N> result;
  for (std::size_t i = 0; i < e.size(); ++i) result.append(-e[i]);
  return result;
}

/// e + sign * f by Shewchuk's fast expansion sum: merge the terms by magnitude, carry the rounded
/// sum upwards.
template <std::size_t N, std::size_t M>
[[nodiscard]] Expansion<N + M> merged(const Expansion<N>& e, const Expansion<M>& f, double sign) {
  Expansion<N + M> result;
  std::size_t i = 0;
  std::size_t j = 0;
  double carry = 0;
  const auto carry_through = [&](double term) {
    const auto [high, low] = two_sum(carry, term);
    result.append(low);
    carry = high;
  };
  while (i < e.size() && j < f.size()) {
    carry_through(std::abs(e[i]) < std::abs(f[j]) ? e[i++] : sign * f[j++]);
  }
  while (i < e.size()) carry_through(e[i++]);
  while (j < f.size()) carry_through(sign * f[j++]);
  result.append(carry);
  return result;
}

template <std::size_t N, std::size_t M>
[[nodiscard]] Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  return merged(e, f, 1);
}

template <std::size_t N, std::size_t M>
[[nodiscard]] Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
  return merged(e, f, -1);
}

/// Shewchuk's scale expansion.
template <std::size_t N>
[[nodiscard]] Expansion<2 * N> operator*(const Expansion<N>& e, double factor) {
  Expansion<2 * N> result;
  double carry = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const auto product = two_product(e[i], factor);
    const auto lower = two_sum(carry, product.low);
    const auto upper = fast_two_sum(product.high, lower.high);
    result.append(lower.low);
    result.append(upper.low);
    carry = upper.high;
  }
  result.append(carry);
  return result;
}

/// The terms of the shorter factor scale the longer one; the sum of that.
template <std::size_t N, std::size_t M>
[[nodiscard]] Expansion<2 * N * M> operator*(const Expansion<N>& e, const Expansion<M>& f) {
  using Product = Expansion<2 * N * M>;
  if constexpr (M > N) {
    return f * e;
  } else {
    if (f.size() == 0) return Product();
    Product result(e * f[0]);
    for (std::size_t j = 1; j < f.size(); ++j) result = Product(result + e * f[j]);
    return result;
  }
}

}  // namespace loft::cdt
