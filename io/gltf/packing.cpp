// SPDX-License-Identifier: MIT
#include "io/gltf/meshopt.h"

namespace loft::io {

namespace {

bool fits_filter(const Packing& packing) {
  switch (packing.filter) {
    case PackedFilter::none:
      return true;
    case PackedFilter::octahedral:
      return packing.stride == 4 || packing.stride == 8;
    case PackedFilter::quaternion:
      return packing.stride == 8;
    case PackedFilter::exponential:
      return true;
  }
  return false;
}

}  // namespace

bool is_fit(const Packing& packing, std::size_t packed_size) {
  // 16 bytes take two bits at least, a triangle takes one byte.
  constexpr std::size_t most_growth = 64;
  if (packing.stride == 0 || packing.count == 0) return false;
  if (packing.count > most_growth * packed_size / packing.stride) return false;
  if (packing.mode == PackedMode::attributes)
    return packing.stride % 4 == 0 && packing.stride <= 256 && fits_filter(packing);
  const bool is_index = packing.stride == 2 || packing.stride == 4;
  const bool is_whole = packing.mode != PackedMode::triangles || packing.count % 3 == 0;
  return is_index && is_whole && packing.filter == PackedFilter::none;
}

}  // namespace loft::io
