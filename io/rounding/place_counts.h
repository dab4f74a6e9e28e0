// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/meshes/place_hash.h"
#include "mesh/mesh.h"

namespace loft::io {

/// How many vertices are at each place: a table in one piece, at most half of it taken. A place
/// that nothing is at any more stays in it.
class PlaceCounts {
 public:
  void add(const Vec3& place) {
    if (2 * (taken_ + 1) > entries_.size()) grow();
    Entry& entry = entries_[find(place)];
    if (!entry.is_taken) {
      entry = {place, 0, true};
      ++taken_;
    }
    ++entry.count;
  }
  /// Precondition: it was added.
  void remove(const Vec3& place) { --entries_[find(place)].count; }
  [[nodiscard]] std::size_t at(const Vec3& place) const {
    return entries_.empty() ? 0 : entries_[find(place)].count;
  }

 private:
  struct Entry {
    Vec3 place{};
    std::uint32_t count = 0;
    bool is_taken = false;
  };

  /// Where it is, or would be.
  [[nodiscard]] std::size_t find(const Vec3& place) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t at = PlaceHash()(place) & mask;
    while (entries_[at].is_taken && entries_[at].place != place) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    std::vector<Entry> before = std::move(entries_);
    entries_.assign(std::max<std::size_t>(16, 2 * before.size()), {});
    for (const Entry& entry : before)
      if (entry.is_taken) entries_[find(entry.place)] = entry;
  }

  std::vector<Entry> entries_;  // a power of two
  std::size_t taken_ = 0;
};

}  // namespace loft::io
