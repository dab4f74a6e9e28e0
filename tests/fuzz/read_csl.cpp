// SPDX-License-Identifier: MIT
// Planes in both formats that have them.
#include "io/contours/csl.h"
#include "tests/fuzz/stacks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::read_stack(io::read_csl, fuzz::text_of(bytes, size));
  fuzz::read_stack(io::read_contour, fuzz::text_of(bytes, size));
  return 0;
}
