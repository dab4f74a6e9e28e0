// SPDX-License-Identifier: MIT
// Whatever the stack and its options, what is made of it is a valid solid, and the region of each
// slice has the exact area of its contours.
#include "tests/reconstruct/any_stack.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/cases.h"

namespace loft {
namespace {

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* value = std::getenv(variable);
  return value == nullptr ? otherwise : std::strtoull(value, nullptr, 10);
}

TEST(AnyStack, MakesASolidAndKeepsItsAreas) {
  const std::uint64_t first = number_from("LOFT_SOAK_FIRST", 0);
  const std::uint64_t wanted = number_from("LOFT_SOAK_STACKS", cases(300));
  int failures = 0;
  for (std::uint64_t seed = first; seed < first + wanted && failures < 8; ++seed) {
    const stacks::AnyStack any = stacks::stack_from_seed(seed);
    const std::string wrong = stacks::complaint(any);
    if (wrong.empty()) continue;
    ++failures;
    ADD_FAILURE() << "seed " << seed << ": " << wrong << '\n' << stacks::as_words(any);
  }
}

// The link to a tip, which has no edges, ran on to a corner exactly: 0 of 0 was how freely it
// bends.
TEST(AnyStack, ATipInLineWithACornerIsBent) {
  EXPECT_EQ(stacks::complaint(stacks::stack_from_seed(47)), "");
}

TEST(AnyStack, TwoCrossingsALastPlaceApartKeepTheCornerBetweenThem) {
  stacks::AnyStack any;
  any.options.fill = Fill::nonzero;
  const std::vector<Contour> contours{
      {{{0.30000000000000004, 0.2}, {0.4, 0.2}, {0.4, 0.30000000000000004}}, ""},
      {{{0.33960784313725517, 0.3000000000000003},
        {0.4109803921568626, 0.2000000000000001},
        {0.4, 0.2},
        {0.4000000000000003, 0.36745098039215696}},
       ""}};
  any.slices = {{0.1, contours}, {0.2, contours}};
  EXPECT_EQ(stacks::complaint(any), "");
}

}  // namespace
}  // namespace loft
