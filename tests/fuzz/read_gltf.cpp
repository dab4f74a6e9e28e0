// SPDX-License-Identifier: MIT
// glTF and GLB; there are no files beside it.
#include "io/gltf/gltf.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::try_to([&] {
    fuzz::use(io::read_gltf(fuzz::text_of(bytes, size), "/nowhere/to/be/found", "a.gltf"));
  });
  return 0;
}
