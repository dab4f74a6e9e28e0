// SPDX-License-Identifier: MIT
#include "io/bytes/decimal.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <random>
#include <string>

namespace loft::io {
namespace {

TEST(ShortDecimal, IsWhatTheLibraryReads) {
  const auto seed = std::random_device()();
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  int taken = 0;
  for (int round = 0; round < 200'000; ++round) {
    std::string text = random() % 2 == 0 ? "-" : "";
    for (auto count = random() % 10; count > 0; --count)
      text += static_cast<char>('0' + random() % 10);
    if (random() % 4 != 0) text += '.';
    for (auto count = random() % 9; count > 0; --count)
      text += static_cast<char>('0' + random() % 10);
    if (random() % 8 == 0) text += "e3";
    std::string_view left = text;
    const auto number = take_short_decimal(left);
    double expected = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), expected);
    if (!number) {
      EXPECT_EQ(left.size(), text.size());
      continue;
    }
    ++taken;
    ASSERT_EQ(error, std::errc()) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*number), std::bit_cast<std::uint64_t>(expected))
        << text;
    ASSERT_EQ(left.data(), end) << text;
  }
  EXPECT_GT(taken, 100'000);
}

TEST(ShortDecimal, LeavesOthersAsTheyAre) {
  for (const std::string_view text :
       {"", "-", ".", ".5", "+1", "nan", "1e5", "1.5E-3", "1234567890123456", "0.0000000000000001",
        "1.2.3", "--1", " 1"}) {
    std::string_view left = text;
    EXPECT_FALSE(take_short_decimal(left)) << text;
    EXPECT_EQ(left, text);
  }
}

TEST(ShortDecimal, EndsBehindTheNumber) {
  std::string_view text = "12.50\\-3";
  EXPECT_EQ(take_short_decimal(text), 12.5);
  EXPECT_EQ(text, "\\-3");
}

}  // namespace
}  // namespace loft::io
