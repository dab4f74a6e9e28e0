// SPDX-License-Identifier: MIT
#include "io/rounding/place_counts.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace loft::io {
namespace {

TEST(PlaceCounts, AreThoseOfATable) {
  std::mt19937 random(1);
  std::uniform_int_distribution coordinate(-4, 4);
  std::map<Vec3, std::size_t> expected;
  PlaceCounts counts;
  EXPECT_EQ(counts.at({1, 2, 3}), 0U);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 place{0.5 * coordinate(random), 0.5 * coordinate(random), 0.5 * coordinate(random)};
    ASSERT_EQ(counts.at(place), expected[place]);
    if (expected[place] > 0 && i % 3 == 0) {
      counts.remove(place);
      --expected[place];
    } else {
      counts.add(place);
      ++expected[place];
    }
  }
  for (const auto& [place, count] : expected) EXPECT_EQ(counts.at(place), count);
}

TEST(PlaceCounts, HaveOneZero) {
  PlaceCounts counts;
  counts.add({0.0, -0.0, 0.0});
  counts.add({-0.0, 0.0, 0.0});
  EXPECT_EQ(counts.at({0.0, 0.0, 0.0}), 2U);
}

}  // namespace
}  // namespace loft::io
