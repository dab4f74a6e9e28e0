// SPDX-License-Identifier: MIT
#include "cdt/passages.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace loft::cdt {

PassageSet PassageSets::with(PassageSet set, Passage added) {
  if (set.is_empty()) return PassageSet(added);
  if (!set.is_stored()) {
    const std::uint32_t block = take_block(smallest_class);
    set_number(block, 2);
    words_[block + 1] = std::min(set.only_, added);
    words_[block + 2] = std::max(set.only_, added);
    return stored(block);
  }
  std::uint32_t block = set.block();
  const std::uint32_t size = number(block);
  if (class_for(size + 1) != class_for(size)) {
    const std::uint32_t larger = take_block(class_for(size + 1));
    std::copy_n(words_.begin() + block, size + 1, words_.begin() + larger);
    give_block(block, class_for(size));
    block = larger;
  }
  set_number(block, size + 1);
  const auto grown = members(block);
  const auto place = std::upper_bound(grown.begin(), grown.end() - 1, added);
  std::copy_backward(place, grown.end() - 1, grown.end());
  *place = added;
  return stored(block);
}

PassageSet PassageSets::without(PassageSet set, Passage removed) {
  if (!set.is_stored()) return {};
  std::uint32_t block = set.block();
  const auto old = members(block);
  const auto place = std::lower_bound(old.begin(), old.end(), removed);
  std::copy(place + 1, old.end(), place);
  const auto size = static_cast<std::uint32_t>(old.size()) - 1;
  if (size == 1) {
    const Passage only = old[0];
    give_block(block, smallest_class);
    return PassageSet(only);
  }
  set_number(block, size);
  if (class_for(size) != class_for(size + 1)) {
    const std::uint32_t smaller = take_block(class_for(size));
    std::copy_n(words_.begin() + block, size + 1, words_.begin() + smaller);
    give_block(block, class_for(size + 1));
    block = smaller;
  }
  return stored(block);
}

PassageSet PassageSets::reversed(PassageSet set) {
  if (set.is_empty()) return set;
  if (!set.is_stored()) return PassageSet(set.only_.reversed());
  const auto turned = members(set.block());
  for (Passage& passage : turned) passage = passage.reversed();
  std::ranges::sort(turned);
  return set;
}

PassageSet PassageSets::copy(PassageSet set) {
  if (!set.is_stored()) return set;
  const std::uint32_t size = number(set.block());
  const std::uint32_t block = take_block(class_for(size));
  std::copy_n(words_.begin() + set.block(), size + 1, words_.begin() + block);
  return stored(block);
}

void PassageSets::release(PassageSet set) {
  if (set.is_stored()) give_block(set.block(), class_for(number(set.block())));
}

void PassageSets::clear() {
  words_.clear();
  free_.fill(no_block);
}

unsigned PassageSets::class_for(std::uint32_t size) {
  return std::max(smallest_class, static_cast<unsigned>(std::bit_width(size)));
}

std::uint32_t PassageSets::take_block(unsigned size_class) {
  if (const std::uint32_t block = free_[size_class]; block != no_block) {
    free_[size_class] = number(block);
    return block;
  }
  const std::size_t block = words_.size();
  const std::size_t end = block + (std::size_t{1} << size_class);
  if (end >= PassageSet::first_stored_segment) throw std::length_error("too many overlaps");
  words_.resize(end);
  return static_cast<std::uint32_t>(block);
}

void PassageSets::give_block(std::uint32_t block, unsigned size_class) {
  set_number(block, free_[size_class]);
  free_[size_class] = block;
}

}  // namespace loft::cdt
