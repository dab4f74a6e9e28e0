// SPDX-License-Identifier: MIT
#include "io/meshes/ply.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::try_to([&] { fuzz::use(io::read_ply(fuzz::text_of(bytes, size), "a.ply")); });
  return 0;
}
