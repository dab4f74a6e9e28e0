// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "overlay/flat_map.h"

namespace loft::overlay {

/// Lists that are kept once each, in one array, and go by numbers, from 0 in the order in which
/// they came. A list's hash is made of what hash_of(item) says.
template <class Item>
class Interned {
 public:
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(ends_.size()); }

  [[nodiscard]] std::span<const Item> operator[](std::uint32_t number) const {
    const std::size_t first = number == 0 ? 0 : ends_[number - 1];
    return std::span(items_).subspan(first, ends_[number] - first);
  }

  /// The number of a list, which is not one of those here but a copy. Cost: its length.
  std::uint32_t number_of(std::span<const Item> list) {
    std::uint64_t hash = list.size();
    for (const Item& item : list) hash = (hash ^ hash_of(item)) * 0x9e37'79b9'7f4a'7c15 >> 1;
    const std::uint32_t first = by_hash_.find(hash);
    for (std::uint32_t at = first; at != FlatMap::none; at = next_[at])
      if (std::ranges::equal((*this)[at], list)) return at;
    by_hash_.set(hash, size());
    next_.push_back(first);
    items_.insert(items_.end(), list.begin(), list.end());
    ends_.push_back(items_.size());
    return size() - 1;
  }

 private:
  std::vector<Item> items_;
  std::vector<std::size_t> ends_;    // by number
  std::vector<std::uint32_t> next_;  // by number: the one before it with the same hash
  FlatMap by_hash_;
};

}  // namespace loft::overlay
