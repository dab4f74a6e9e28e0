// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace loft::io {

/// A number at each of many places, of which few have one, mostly beside others that have: memory
/// is taken in blocks, when one of their places gets a number.
class SparseTable {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  explicit SparseTable(std::size_t size) : blocks_((size + block - 1) / block, none) {}

  [[nodiscard]] std::uint32_t operator[](std::size_t place) const {
    const std::uint32_t at = blocks_[place / block];
    return at == none ? none : numbers_[std::size_t{at} * block + place % block];
  }

  void set(std::size_t place, std::uint32_t number) {
    std::uint32_t& at = blocks_[place / block];
    if (at == none) {
      at = static_cast<std::uint32_t>(numbers_.size() / block);
      numbers_.resize(numbers_.size() + block, none);
    }
    numbers_[std::size_t{at} * block + place % block] = number;
  }

  /// No place has a number then. Keeps memory for those to come.
  void clear() {
    std::ranges::fill(blocks_, none);
    numbers_.clear();
  }

 private:
  static constexpr std::size_t block = 256;

  std::vector<std::uint32_t> blocks_;  // where their numbers are, in blocks
  std::vector<std::uint32_t> numbers_;
};

}  // namespace loft::io
