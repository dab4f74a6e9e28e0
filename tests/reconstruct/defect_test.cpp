// SPDX-License-Identifier: MIT
#include "reconstruct/defect.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace loft {
namespace {

Defect defect_in(std::uint32_t slice, double z, const std::string& message) {
  Defect defect;
  defect.kind = DefectKind::self_crossing;
  defect.slice = slice;
  defect.z = z;
  defect.message = message;
  return defect;
}

TEST(Defect, IsDescribedAsFarAsItIsKnown) {
  Defect defect = defect_in(42, 10.5, "");
  EXPECT_EQ(describe(defect), "slice 42 (z = 10.5): self_crossing");
  defect.message = "crosses itself";
  EXPECT_EQ(describe(defect), "slice 42 (z = 10.5): crosses itself");
  defect.contour = 3;
  defect.point = 7;
  defect.place = cdt::Point{12.1, 40.7};
  EXPECT_EQ(describe(defect),
            "slice 42 (z = 10.5) contour 3 point 7 near (12.1, 40.7): crosses itself");
}

TEST(InputError, ListsAllDefectsOneALine) {
  const InputError error({defect_in(0, 1, "one"), defect_in(1, 2, "two")});
  EXPECT_STREQ(error.what(), "slice 0 (z = 1): one\nslice 1 (z = 2): two");
  EXPECT_EQ(error.defects().size(), 2U);
}

TEST(InputError, MayBeAPlainMessage) {
  const InputError error("no slices");
  EXPECT_STREQ(error.what(), "no slices");
  EXPECT_TRUE(error.defects().empty());
}

}  // namespace
}  // namespace loft
