// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace loft::overlay {

/// Numbers by 64-bit keys, in one array: open addressing with linear probing, at most half full.
/// The largest key is not for use. Cost: constant expected, no memory an operation once it has
/// grown.
class FlatMap {
 public:
  static constexpr std::uint32_t none = 0xffff'ffff;

  [[nodiscard]] std::size_t size() const { return size_; }

  void clear() {
    slots_.assign(slots_.size(), Slot());
    size_ = 0;
  }

  /// Makes room for that many keys, where there are none yet.
  void reserve(std::size_t count) {
    if (size_ == 0 && count > 0)
      slots_.assign(std::bit_ceil(std::max<std::size_t>(2 * count, 16)), Slot());
  }

  /// The number of a key; `none` if it has none.
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const {
    return slots_.empty() ? none : slots_[place(key)].number;
  }

  /// Gives a key a number, which is not `none`.
  void set(std::uint64_t key, std::uint32_t number) {
    if (2 * size_ >= slots_.size()) grow();
    Slot& slot = slots_[place(key)];
    if (slot.key == free) ++size_;
    slot = {key, number};
  }

  /// Forgets a key that is there: those behind it close up (Knuth, 6.4, algorithm R).
  void erase(std::uint64_t key) {
    std::size_t hole = place(key);
    if (slots_[hole].key == free) return;
    --size_;
    for (std::size_t at = next(hole); slots_[at].key != free; at = next(at)) {
      const std::size_t home = home_of(slots_[at].key);
      const bool is_behind = hole <= at ? hole < home && home <= at : hole < home || home <= at;
      if (is_behind) continue;
      slots_[hole] = slots_[at];
      hole = at;
    }
    slots_[hole] = Slot();
  }

 private:
  static constexpr std::uint64_t free = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t key = free;
    std::uint32_t number = none;
  };

  [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (slots_.size() - 1); }
  [[nodiscard]] std::size_t home_of(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9e37'79b9'7f4a'7c15) >> 32) & (slots_.size() - 1);
  }
  /// Where a key is, or would be.
  [[nodiscard]] std::size_t place(std::uint64_t key) const {
    std::size_t at = home_of(key);
    while (slots_[at].key != key && slots_[at].key != free) at = next(at);
    return at;
  }

  void grow() {
    std::vector<Slot> old(slots_.empty() ? 16 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.key != free) slots_[place(slot.key)] = slot;
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};

}  // namespace loft::overlay
