// SPDX-License-Identifier: MIT
// A target for libFuzzer: bytes are what is asked for. What is understood is said again.
#include "app/server/slab_ranges.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const auto ranges = loft::app::parse_slab_ranges(text);
  if (!ranges) return 0;
  std::string again;
  for (const auto& [part, first, last] : *ranges) {
    if (last < first) std::abort();
    if (!again.empty()) again += ',';
    again += std::to_string(part) + '-' + std::to_string(first) + ".." + std::to_string(last);
  }
  if (loft::app::parse_slab_ranges(again) != ranges) std::abort();
  return 0;
}
