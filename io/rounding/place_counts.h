// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "io/meshes/place_hash.h"
#include "mesh/mesh.h"

namespace loft::io {

/// How many vertices are at each place.
class PlaceCounts {
 public:
  void add(const Vec3& place) { ++counts_[place]; }
  void remove(const Vec3& place) { --counts_[place]; }
  [[nodiscard]] std::size_t at(const Vec3& place) const {
    const auto found = counts_.find(place);
    return found == counts_.end() ? 0 : found->second;
  }

 private:
  std::unordered_map<Vec3, std::uint32_t, PlaceHash> counts_;
};

}  // namespace loft::io
