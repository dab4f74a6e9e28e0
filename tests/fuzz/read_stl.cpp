// SPDX-License-Identifier: MIT
#include "io/meshes/stl.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::try_to([&] { fuzz::use(io::read_stl(fuzz::text_of(bytes, size), "a.stl")); });
  return 0;
}
