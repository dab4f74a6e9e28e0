// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "fields/separator.h"

namespace loft::fields {

/// Sign vectors by numbers, and how many points have each.
class ClassTable {
 public:
  /// Forgets all; from now on vectors have that many signs.
  void begin(std::size_t signs);

  /// The number of a vector. Cost: O(signs log classes).
  [[nodiscard]] std::uint32_t number(std::span<const Sign> signs);
  /// The number of what differs from another one in one sign. Cost: constant but for the first
  /// time.
  [[nodiscard]] std::uint32_t with(std::uint32_t number, std::size_t place, Sign sign);

  [[nodiscard]] std::span<const Sign> signs(std::uint32_t number) const {
    return classes_[number].signs;
  }
  [[nodiscard]] std::size_t& count(std::uint32_t number) { return classes_[number].count; }

  /// Calls visit(signs, number, count) for all that have a point, by their signs: right, on, left.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto& [signs, number] : numbers_)
      if (classes_[number].count > 0) visit(signs, number, classes_[number].count);
  }

 private:
  static constexpr std::uint32_t unknown = 0xffff'ffff;
  struct Class {
    std::vector<Sign> signs;
    std::size_t count = 0;
    std::vector<std::uint32_t> others;  // by place and sign: what differs there
  };

  std::size_t sign_count_ = 0;
  std::map<std::vector<Sign>, std::uint32_t> numbers_;
  std::vector<Class> classes_;
};

}  // namespace loft::fields
