// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "reconstruct/origin.h"

namespace loft {

/// Numbers edges by their nodes. All in one table, at most half full: what takes the time is
/// waiting for memory, and here an edge is where it is looked for or next to it.
class EdgeIndex {
 public:
  /// The value of an edge, and whether it was set before. Holds until the next call.
  std::pair<std::uint32_t&, bool> at(std::uint32_t a, std::uint32_t b) {
    if (2 * count_ >= entries_.size()) grow();
    const auto [low, high] = std::minmax(a, b);
    Entry& entry = entries_[slot(low, high)];
    const bool is_known = entry.low != Origin::none;
    if (!is_known) {
      entry = {low, high, Origin::none};
      ++count_;
    }
    return {entry.value, is_known};
  }

  /// The value of an edge that was set before.
  [[nodiscard]] std::uint32_t find(std::uint32_t a, std::uint32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    return entries_[slot(low, high)].value;
  }

 private:
  struct Entry {
    std::uint32_t low = Origin::none;
    std::uint32_t high = Origin::none;
    std::uint32_t value = Origin::none;
  };

  /// Where an edge is, or would be.
  [[nodiscard]] std::size_t slot(std::uint32_t low, std::uint32_t high) const {
    constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15;  // 2^64 by the golden ratio
    const std::uint64_t hash = ((std::uint64_t{low} << 32 | high) * golden) >> 32;
    std::size_t at = (hash * entries_.size()) >> 32;
    while (entries_[at].low != Origin::none &&
           (entries_[at].low != low || entries_[at].high != high))
      at = at + 1 == entries_.size() ? 0 : at + 1;
    return at;
  }

  void grow() {
    std::vector<Entry> old(std::max<std::size_t>(1024, 2 * entries_.size()));
    old.swap(entries_);
    for (const Entry& entry : old)
      if (entry.low != Origin::none) entries_[slot(entry.low, entry.high)] = entry;
  }

  std::vector<Entry> entries_;  // looked up, never walked through in their order
  std::size_t count_ = 0;
};

}  // namespace loft
