// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/ids.h"

namespace loft::cdt {

/// A segment running along an edge, and in which direction: `upward` if towards the edge's
/// lexicographically larger end.
class Passage {
 public:
  constexpr Passage() = default;
  constexpr Passage(SegmentId segment, bool upward)
      : bits_(segment.index() << 1 | static_cast<std::uint32_t>(upward)) {}

  [[nodiscard]] constexpr SegmentId segment() const { return SegmentId(bits_ >> 1); }
  [[nodiscard]] constexpr bool is_upward() const { return (bits_ & 1) != 0; }
  [[nodiscard]] constexpr Passage reversed() const { return Passage(segment(), !is_upward()); }

  friend constexpr auto operator<=>(Passage, Passage) = default;

 private:
  std::uint32_t bits_ = 0xffff'ffff;
};

/// The passages along one edge, as a 32-bit handle: what KBT calls `crep`. The two commonest, no
/// passage and one, need no storage besides the handle; others own a block of a PassageSets.
class PassageSet {
 public:
  constexpr PassageSet() = default;
  constexpr explicit PassageSet(Passage only) : only_(only) {}

  [[nodiscard]] constexpr bool is_empty() const { return only_ == empty; }

 private:
  friend class PassageSets;
  static constexpr Passage empty{SegmentId(0x7fff'ffff), true};
  static constexpr std::uint32_t first_stored_segment = 0x4000'0000;

  [[nodiscard]] constexpr bool is_stored() const {
    return only_.segment().index() >= first_stored_segment && !is_empty();
  }
  [[nodiscard]] constexpr std::uint32_t block() const {
    return only_.segment().index() - first_stored_segment;
  }

  Passage only_ = empty;
};

/// Storage of the sets that hold two passages or more: blocks of a power of two words, each with
/// its size in front, those no longer needed kept for the next of their size. A set is a multiset:
/// out and back along one edge are two passages. It is sorted.
class PassageSets {
 public:
  /// One more than this many segments cannot be told from stored sets.
  static constexpr std::uint32_t most_segments = PassageSet::first_stored_segment;

  PassageSets() { clear(); }

  /// `set` and one more; `set` is used up. Cost: O(size).
  [[nodiscard]] PassageSet with(PassageSet set, Passage added);
  /// `set` less one that it has; `set` is used up. Cost: O(size).
  [[nodiscard]] PassageSet without(PassageSet set, Passage removed);
  /// Every passage the other way round; `set` is used up.
  [[nodiscard]] PassageSet reversed(PassageSet set);
  /// The same again, with a block of its own.
  [[nodiscard]] PassageSet copy(PassageSet set);
  /// Gives the block back.
  void release(PassageSet set);
  /// The members, sorted. A set of one is viewed in place: `set` must outlive the view, and no
  /// set may be changed meanwhile.
  [[nodiscard]] std::span<const Passage> view(const PassageSet& set) const {
    if (set.is_empty()) return {};
    if (set.is_stored()) return {words_.data() + set.block() + 1, number(set.block())};
    return {&set.only_, 1};
  }

  void clear();

 private:
  static constexpr std::uint32_t no_block = 0x7fff'ffff;
  static constexpr unsigned smallest_class = 2;  // blocks of four words

  [[nodiscard]] static unsigned class_for(std::uint32_t size);
  [[nodiscard]] std::uint32_t number(std::uint32_t word) const {
    return words_[word].segment().index();
  }
  void set_number(std::uint32_t word, std::uint32_t value) {
    words_[word] = Passage(SegmentId(value), false);
  }
  [[nodiscard]] std::uint32_t take_block(unsigned size_class);
  void give_block(std::uint32_t block, unsigned size_class);
  [[nodiscard]] static PassageSet stored(std::uint32_t block) {
    return PassageSet(Passage(SegmentId(PassageSet::first_stored_segment + block), false));
  }
  [[nodiscard]] std::span<Passage> members(std::uint32_t block) {
    return {words_.data() + block + 1, number(block)};
  }

  std::vector<Passage> words_;
  std::array<std::uint32_t, 32> free_{};  // the first free block of each class
};

}  // namespace loft::cdt
