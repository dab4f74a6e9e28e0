// SPDX-License-Identifier: MIT
// In the place of png.cpp where there is no libpng.
#include "io/images/png.h"
#include "reconstruct/defect.h"

namespace loft::io {

Stack read_png(const StackInput& input, const ReadOptions& options) {
  return read_png_series({&input, 1}, options);
}

Stack read_png_series(std::span<const StackInput> inputs, const ReadOptions&) {
  throw InputError(inputs.front().name +
                   ": this build reads no PNG; install libpng-dev and build loft again");
}

}  // namespace loft::io
