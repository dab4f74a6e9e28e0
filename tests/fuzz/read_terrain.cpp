// SPDX-License-Identifier: MIT
#include "io/contours/terrain.h"
#include "tests/fuzz/stacks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::read_stack(io::read_terrain, text);
  io::ReadOptions options;
  options.open_lines = io::OpenLines::close_along_border;
  fuzz::read_stack(io::read_terrain, text, options);
  return 0;
}
