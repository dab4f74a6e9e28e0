// SPDX-License-Identifier: MIT
#include "io/images/tiff.h"
#include "tests/fuzz/stacks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::read_stack(io::read_tiff, fuzz::text_of(bytes, size), {.spacing = Vec3{1, 1, 2}});
  return 0;
}
