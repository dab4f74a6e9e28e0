// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "overlay/flat_map.h"

namespace loft::overlay {

/// Numbers of edges or vertices: a place for each of them where many will have one, so that those
/// that lie together are kept together; by keys elsewhere. Cost: as FlatMap's.
class Numbers {
 public:
  static constexpr std::uint32_t none = FlatMap::none;

  Numbers() = default;
  /// About `expected` of `bound`. Cost: O(expected).
  Numbers(std::size_t expected, std::size_t bound) {
    constexpr std::size_t few = 16;
    if (bound / few < expected)
      each_.assign(bound, none);
    else
      some_.reserve(expected);
  }

  /// The number of an edge or a vertex; `none` if it has none.
  [[nodiscard]] std::uint32_t find(std::size_t index) const {
    if (each_.empty()) return some_.find(index);
    return index < each_.size() ? each_[index] : none;
  }

  /// Gives it a number, which is not `none`.
  void set(std::size_t index, std::uint32_t number) {
    if (each_.empty()) {
      some_.set(index, number);
      return;
    }
    if (index >= each_.size()) each_.resize(index + each_.size() / 2 + 1, none);
    each_[index] = number;
  }

  void erase(std::size_t index) {
    if (each_.empty())
      some_.erase(index);
    else if (index < each_.size())
      each_[index] = none;
  }

 private:
  FlatMap some_;
  std::vector<std::uint32_t> each_;
};

}  // namespace loft::overlay
