// SPDX-License-Identifier: MIT
// In the place of png.cpp and png_write.cpp where there is no libpng.
#include <stdexcept>

#include "io/images/png.h"
#include "io/images/png_write.h"
#include "reconstruct/defect.h"

namespace loft::io {

Stack read_png(const StackInput& input, const ReadOptions& options) {
  return read_png_series({&input, 1}, options);
}

Stack read_png_series(std::span<const StackInput> inputs, const ReadOptions&) {
  throw InputError(inputs.front().name +
                   ": this build reads no PNG; install libpng-dev and build loft again");
}

std::string to_png(std::span<const std::uint8_t>, std::size_t) {
  throw std::runtime_error("this build writes no PNG");
}

bool writes_png() { return false; }

}  // namespace loft::io
