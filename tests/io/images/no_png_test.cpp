// SPDX-License-Identifier: MIT
// In the place of the tests of PNG where there is no libpng.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/images/png.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

TEST(Png, IsNotReadInThisBuild) {
  EXPECT_THAT(testing::message_of<InputError>([] {
                static_cast<void>(read_png({"", "a.png"}, {}));
              }),
              ::testing::HasSubstr("a.png: this build reads no PNG; install libpng-dev"));
  GTEST_SKIP() << "built without libpng: its other tests are left out";
}

}  // namespace
}  // namespace loft::io
