// SPDX-License-Identifier: MIT
// In the place of the tests of TIFF where there is no libtiff.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/images/tiff.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

TEST(Tiff, IsNotReadInThisBuild) {
  EXPECT_THAT(testing::message_of<InputError>([] {
                static_cast<void>(read_tiff({"", "a.tif"}, {}));
              }),
              ::testing::HasSubstr("a.tif: this build reads no TIFF; install libtiff-dev"));
  GTEST_SKIP() << "built without libtiff: its other tests are left out";
}

}  // namespace
}  // namespace loft::io
