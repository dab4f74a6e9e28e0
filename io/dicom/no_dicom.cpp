// SPDX-License-Identifier: MIT
// In the place of dicom.cpp where there is no DCMTK.
#include "io/dicom/dicom.h"
#include "reconstruct/defect.h"

namespace loft::io {

Stack read_dicom(const StackInput& input, const ReadOptions&) {
  throw InputError(
      input.name +
      ": this build reads no DICOM; install libdcmtk-dev (DCMTK) and build loft again");
}

}  // namespace loft::io
