// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "reconstruct/reconstruction.h"

namespace loft::edits {

/// A live surface before an edit, to see whether what the edit says of itself is so.
class ChangeWatch {
 public:
  explicit ChangeWatch(const Reconstruction& live);

  /// What is not true in the change that an edit has given; empty if all of it is.
  [[nodiscard]] std::string lie(const Reconstruction& live, const SurfaceChange& change) const;

 private:
  using Place = std::array<double, 3>;
  struct Face {
    std::array<int, 3> vertices;
    std::array<Place, 3> places;
    std::uint32_t slab;
  };

  [[nodiscard]] static bool is_same(const Face& a, const Face& b) {
    return a.vertices == b.vertices && a.places == b.places;
  }

  std::map<int, Face> faces_;  // by their handles
  std::map<int, Place> vertices_;
  std::vector<SlabInfo> slabs_;
  std::size_t face_count_;
  std::size_t vertex_count_;
};

}  // namespace loft::edits
