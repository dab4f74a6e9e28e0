// SPDX-License-Identifier: MIT
#include "cdt/passages.h"

#include <algorithm>

namespace loft::cdt {

namespace {

constexpr std::uint32_t free_slot = 0xffff'ffff;

std::size_t hash_of(std::span<const Passage> members) {
  std::uint64_t hash = 0x9e37'79b9'7f4a'7c15;
  for (const Passage passage : members) {
    const std::uint64_t bits = passage.segment().index() * 2ULL + (passage.is_upward() ? 1 : 0);
    hash = (hash ^ bits) * 0xff51'afd7'ed55'8ccd;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

PassageSet PassageSets::with(PassageSet set, Passage added) {
  if (set.is_empty()) return PassageSet(added);
  const auto old = view(set);
  scratch_.assign(old.begin(), old.end());
  scratch_.insert(std::upper_bound(scratch_.begin(), scratch_.end(), added), added);
  return intern(scratch_);
}

PassageSet PassageSets::reversed(PassageSet set) {
  if (set.is_empty()) return set;
  const auto old = view(set);
  scratch_.clear();
  for (const Passage passage : old) scratch_.push_back(passage.reversed());
  std::sort(scratch_.begin(), scratch_.end());
  return intern(scratch_);
}

std::span<const Passage> PassageSets::view(const PassageSet& set) const {
  if (set.is_empty()) return {};
  if (set.is_stored()) return members(set.stored_index());
  return {&set.only_, 1};
}

void PassageSets::clear() {
  members_.clear();
  stored_.clear();
  table_.clear();
}

PassageSet PassageSets::intern(std::span<const Passage> wanted) {
  if (wanted.size() == 1) return PassageSet(wanted.front());
  if (2 * (stored_.size() + 1) > table_.size()) grow_table();
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = hash_of(wanted) & mask;
  while (table_[slot] != free_slot && !std::ranges::equal(members(table_[slot]), wanted))
    slot = (slot + 1) & mask;
  if (table_[slot] == free_slot) {
    table_[slot] = static_cast<std::uint32_t>(stored_.size());
    stored_.push_back(
        {static_cast<std::uint32_t>(members_.size()), static_cast<std::uint32_t>(wanted.size())});
    members_.insert(members_.end(), wanted.begin(), wanted.end());
  }
  return PassageSet(Passage(SegmentId(PassageSet::first_stored_segment + table_[slot]), false));
}

void PassageSets::grow_table() {
  table_.assign(std::max<std::size_t>(16, 2 * table_.size()), free_slot);
  const std::size_t mask = table_.size() - 1;
  for (std::uint32_t i = 0; i < stored_.size(); ++i) {
    std::size_t slot = hash_of(members(i)) & mask;
    while (table_[slot] != free_slot) slot = (slot + 1) & mask;
    table_[slot] = i;
  }
}

}  // namespace loft::cdt
