// SPDX-License-Identifier: MIT
#include <zlib.h>

#include "io/bytes/little_endian.h"
#include "io/images/png.h"
#include "tests/fuzz/stacks.h"

namespace {

/// With the sums that its chunks should have: what is behind them is to be reached.
std::string summed(std::string bytes) {
  constexpr std::size_t signature = 8;
  for (std::size_t at = signature; at + 12 <= bytes.size();) {
    const auto size = loft::io::get<std::uint32_t>(&bytes[at], std::endian::big);
    if (size > bytes.size() - at - 12) break;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(&bytes[at + 4]), size + 4);
    for (std::size_t i = 0; i < 4; ++i)
      bytes[at + 8 + size + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += size + 12;
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  fuzz::read_stack(io::read_png, summed(fuzz::text_of(bytes, size)), {.spacing = Vec3{1, 1, 2}});
  return 0;
}
