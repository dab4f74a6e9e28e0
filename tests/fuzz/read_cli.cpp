// SPDX-License-Identifier: MIT
#include "io/contours/cli.h"
#include "tests/fuzz/stacks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::read_stack(io::read_cli, fuzz::text_of(bytes, size));
  return 0;
}
