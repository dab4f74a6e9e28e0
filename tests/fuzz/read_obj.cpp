// SPDX-License-Identifier: MIT
#include "io/meshes/obj.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::try_to([&] { fuzz::use(io::read_obj(fuzz::text_of(bytes, size), "a.obj")); });
  return 0;
}
