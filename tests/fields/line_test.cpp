// SPDX-License-Identifier: MIT
#include "fields/line.h"

#include <gtest/gtest.h>

namespace loft::fields {
namespace {

TEST(LineKind, IsReadAsItIsWritten) {
  for (const LineKind kind : {LineKind::feature, LineKind::soft, LineKind::wall, LineKind::barrier})
    EXPECT_EQ(line_kind(name_of(kind)), kind);
  EXPECT_EQ(line_kind("fence"), std::nullopt);
}

TEST(LineKind, SeparatesIfNothingCrosses) {
  EXPECT_TRUE(separates(LineKind::wall) && separates(LineKind::barrier));
  EXPECT_FALSE(separates(LineKind::feature) || separates(LineKind::soft));
}

}  // namespace
}  // namespace loft::fields
