// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "mesh/mesh.h"

namespace loft::io {

/// For tables of places: equal ones have equal hashes, -0 and 0 too.
struct PlaceHash {
  [[nodiscard]] std::size_t operator()(const Vec3& place) const {
    std::uint64_t hash = 0;
    for (const double coordinate : place) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9e37'79b9'7f4a'7c15U;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

}  // namespace loft::io
