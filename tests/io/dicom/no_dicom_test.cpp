// SPDX-License-Identifier: MIT
// In the place of the tests of DICOM where there is no DCMTK.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/dicom/dicom.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

TEST(StructureSet, IsNotReadInThisBuild) {
  EXPECT_THAT(testing::message_of<InputError>([] {
                static_cast<void>(read_dicom({"", "plan.dcm"}, {}));
              }),
              ::testing::HasSubstr("plan.dcm: this build reads no DICOM; install libdcmtk-dev"));
  GTEST_SKIP() << "built without DCMTK: its other tests are left out";
}

}  // namespace
}  // namespace loft::io
