// SPDX-License-Identifier: MIT
#include "fields/class_table.h"

namespace loft::fields {

void ClassTable::begin(std::size_t signs) {
  sign_count_ = signs;
  numbers_.clear();
  classes_.clear();
}

std::uint32_t ClassTable::number(std::span<const Sign> signs) {
  const auto next = static_cast<std::uint32_t>(classes_.size());
  const auto [found, is_new] =
      numbers_.try_emplace(std::vector<Sign>(signs.begin(), signs.end()), next);
  if (is_new)
    classes_.push_back(
        {.signs = found->first, .others = std::vector<std::uint32_t>(3 * sign_count_, unknown)});
  return found->second;
}

std::uint32_t ClassTable::with(std::uint32_t number, std::size_t place, Sign sign) {
  const std::size_t way = 3 * place + static_cast<std::size_t>(static_cast<int>(sign) + 1);
  if (classes_[number].others[way] == unknown) {
    std::vector<Sign> signs = classes_[number].signs;
    signs[place] = sign;
    const std::uint32_t other = this->number(signs);
    classes_[number].others[way] = other;
  }
  return classes_[number].others[way];
}

}  // namespace loft::fields
