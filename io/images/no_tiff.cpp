// SPDX-License-Identifier: MIT
// In the place of tiff.cpp where there is no libtiff.
#include "io/images/tiff.h"
#include "reconstruct/defect.h"

namespace loft::io {

Stack read_tiff(const StackInput& input, const ReadOptions& options) {
  return read_tiff_series({&input, 1}, options);
}

Stack read_tiff_series(std::span<const StackInput> inputs, const ReadOptions&) {
  throw InputError(inputs.front().name +
                   ": this build reads no TIFF; install libtiff-dev and build loft again");
}

}  // namespace loft::io
