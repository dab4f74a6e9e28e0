// SPDX-License-Identifier: MIT
#include "cdt/exact_sum.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace loft::cdt {
namespace {

using Rational = boost::multiprecision::cpp_rational;

double random_double(std::mt19937_64& random) {
  const int exponent = static_cast<int>(random() % 400) - 160;
  const auto mantissa = static_cast<double>(random() >> 11);
  return std::ldexp(random() % 2 == 0 ? mantissa : -mantissa, exponent - 53);
}

/// Whether no double is nearer, and none as near with an even mantissa where this has an odd one.
::testing::AssertionResult is_nearest(double value, const Rational& exact) {
  const auto distance = [&](double x) { return Rational(abs(exact - Rational(x))); };
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  const bool is_odd = std::fmod(mantissa, 2) != 0;
  for (const double other : {std::nextafter(value, -INFINITY), std::nextafter(value, INFINITY)})
    if (distance(other) < distance(value) || (is_odd && distance(other) == distance(value)))
      return ::testing::AssertionFailure() << other << " is nearer than " << value;
  return ::testing::AssertionSuccess();
}

TEST(ExactSum, IsWhatRationalsSay) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    ExactSum sum;
    Rational exact = 0;
    for (int i = 0; i < 12; ++i) {
      const double a = random_double(random);
      const double b = random_double(random);
      if (random() % 3 == 0) {
        sum.add(a);
        exact += Rational(a);
      } else {
        sum.add_product(a, b);
        exact += Rational(a) * Rational(b);
      }
      ASSERT_EQ(sum.sign(), exact.sign());
      ASSERT_TRUE(is_nearest(sum.to_double(), exact));
      ASSERT_TRUE(is_nearest(sum.to_double(-1), exact / 2));
      ASSERT_TRUE(is_nearest((-sum).to_double(), -exact));
    }
  }
}

TEST(ExactSum, TiesGoToEven) {
  for (const double low : {1.0, 0x1p52 + 1, 0x1p52 + 2}) {
    ExactSum sum;
    sum.add(low);
    sum.add(std::nextafter(low, INFINITY) - low == 1 ? 0.5 : 0x1p-53);
    const double up = std::nextafter(low, INFINITY);
    const bool is_low_even = std::fmod(std::ldexp(low, low < 2 ? 52 : 0), 2) == 0;
    EXPECT_EQ(sum.to_double(), is_low_even ? low : up);
    sum.add(0x1p-300);
    EXPECT_EQ(sum.to_double(), up);
    sum.add(-0x1p-299);
    EXPECT_EQ(sum.to_double(), low);
  }
}

TEST(ExactSum, EqualSumsAreEqualInWhateverOrder) {
  std::mt19937_64 random(7);
  ExactSum upwards;
  ExactSum downwards;
  std::vector<double> terms;
  for (int i = 0; i < 1000; ++i) terms.push_back(random_double(random));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    upwards.add(terms[i]);
    downwards += [&] {
      ExactSum one;
      one.add(terms[terms.size() - 1 - i]);
      return one;
    }();
  }
  EXPECT_EQ(upwards, downwards);
  EXPECT_EQ((upwards - downwards).to_double(), 0);
  downwards.add(0x1p-240);
  EXPECT_LT(upwards, downwards);
}

TEST(ExactSum, TheLargestAndTheSmallestFitTogether) {
  ExactSum sum;
  for (int i = 0; i < 1000; ++i) sum.add_product(1e75, 1e75);
  sum.add_product(1e-50, 1e-50);
  for (int i = 0; i < 1000; ++i) sum.subtract_product(1e75, 1e75);
  EXPECT_EQ(sum.to_double(), 1e-50 * 1e-50);
  sum.subtract_product(1e-50, 1e-50);
  EXPECT_EQ(sum.sign(), 0);
}

}  // namespace
}  // namespace loft::cdt
