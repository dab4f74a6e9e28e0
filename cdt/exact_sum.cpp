// SPDX-License-Identifier: MIT
#include "cdt/exact_sum.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace loft::cdt {

namespace {

constexpr std::int64_t digit_mask = 0xffff'ffff;

/// From the first digit to the last, each left between 0 and 2^32; the last takes what remains, and
/// with it the sign.
template <class Digits>
void carry_through(Digits& digits) {
  for (std::size_t i = 0; i + 1 < digits.size(); ++i) {
    digits[i + 1] += digits[i] >> 32;
    digits[i] &= digit_mask;
  }
}

}  // namespace

void ExactSum::add(double term) {
  const auto bits = std::bit_cast<std::uint64_t>(term);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  if (biased == 0) return;  // 0: what is smaller than 2^-459 is not for this
  const std::uint64_t mantissa = (bits & ((std::uint64_t{1} << 52) - 1)) | std::uint64_t{1} << 52;
  const int place = biased - 1075 - lowest_bit;
  assert(place >= 0 && place / 32 + 2 < static_cast<int>(digits));
  const auto first = static_cast<std::size_t>(place) / 32;
  const auto shift = static_cast<unsigned>(place) % 32;
  const std::int64_t sign = term < 0 ? -1 : 1;
  const auto low = static_cast<std::int64_t>(mantissa << shift & digit_mask);
  const auto rest = static_cast<std::int64_t>(mantissa >> (32 - shift));
  digits_[first] += sign * low;
  digits_[first + 1] += sign * (rest & digit_mask);
  digits_[first + 2] += sign * (rest >> 32);
  if (++waiting_ == most_waiting) carry();
}

void ExactSum::carry() {
  carry_through(digits_);
  waiting_ = 0;
}

ExactSum::Digits ExactSum::carried() const {
  Digits result = digits_;
  carry_through(result);
  return result;
}

ExactSum& ExactSum::operator+=(const ExactSum& other) {
  if (waiting_ + other.waiting_ + 2 >= most_waiting) carry();
  const Digits added = other.carried();
  for (std::size_t i = 0; i < digits; ++i) digits_[i] += added[i];
  ++waiting_;
  return *this;
}

ExactSum ExactSum::operator-() const {
  ExactSum result = *this;
  for (std::int64_t& digit : result.digits_) digit = -digit;
  return result;
}

ExactSum& ExactSum::operator-=(const ExactSum& other) { return *this += -other; }

int ExactSum::sign() const {
  const Digits all = carried();
  if (all.back() < 0) return -1;
  for (const std::int64_t digit : all)
    if (digit != 0) return 1;
  return 0;
}

double ExactSum::to_double(int shift) const {
  const int side = sign();
  if (side == 0) return 0;
  const Digits all = side < 0 ? (-*this).carried() : carried();
  std::size_t top = digits - 1;
  while (all[top] == 0) --top;
  // The first 64 bits from the highest one; the last of them stands for all that comes after.
  const auto digit = [&](std::size_t below) {
    return below <= top ? static_cast<std::uint64_t>(all[top - below]) : 0;
  };
  const int zeros = std::countl_zero(digit(0)) - 32;
  const std::uint64_t two = digit(0) << 32 | digit(1);
  std::uint64_t leading = zeros == 0 ? two : two << zeros | digit(2) >> (32 - zeros);
  bool is_more = zeros < 32 && (digit(2) << (32 + zeros)) != 0;
  for (std::size_t below = 3; below <= top; ++below) is_more = is_more || digit(below) != 0;
  if (is_more) leading |= 1;
  // 11 bits too many: to nearest, ties to even.
  std::uint64_t mantissa = leading >> 11;
  const std::uint64_t rest = leading & 0x7ff;
  if (rest > 0x400 || (rest == 0x400 && (mantissa & 1) != 0)) ++mantissa;
  const int exponent = lowest_bit + 32 * (static_cast<int>(top) - 1) - zeros + 11 + shift;
  return side * std::ldexp(static_cast<double>(mantissa), exponent);
}

}  // namespace loft::cdt
