// SPDX-License-Identifier: MIT
#pragma once

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
  constexpr Passage(SegmentId segment, bool upward)
      : bits_(segment.index() << 1 | static_cast<std::uint32_t>(upward)) {}

  [[nodiscard]] constexpr SegmentId segment() const { return SegmentId(bits_ >> 1); }
  [[nodiscard]] constexpr bool is_upward() const { return (bits_ & 1) != 0; }
  [[nodiscard]] constexpr Passage reversed() const { return Passage(segment(), !is_upward()); }

  friend constexpr auto operator<=>(Passage, Passage) = default;

 private:
  std::uint32_t bits_;
};

/// The passages along one edge, as a 32-bit handle: what KBT calls `crep`. Equal sets have equal
/// handles. The two commonest, no passage and one, need no storage besides the handle.
class PassageSet {
 public:
  constexpr PassageSet() = default;
  constexpr explicit PassageSet(Passage only) : only_(only) {}

  [[nodiscard]] constexpr bool is_empty() const { return only_ == empty; }

  friend constexpr bool operator==(PassageSet, PassageSet) = default;

 private:
  friend class PassageSets;
  static constexpr Passage empty{SegmentId(0x7fff'ffff), true};
  static constexpr std::uint32_t first_stored_segment = 0x4000'0000;

  [[nodiscard]] constexpr bool is_stored() const {
    return only_.segment().index() >= first_stored_segment && !is_empty();
  }
  [[nodiscard]] constexpr std::uint32_t stored_index() const {
    return only_.segment().index() - first_stored_segment;
  }

  Passage only_ = empty;
};

/// Storage of the sets that hold two passages or more. Each different one is kept once, however
/// many edges have it. A set is a multiset: out and back along one edge are two passages.
class PassageSets {
 public:
  /// `set` and one more. Cost: O(size).
  [[nodiscard]] PassageSet with(PassageSet set, Passage added);
  /// Every passage the other way round.
  [[nodiscard]] PassageSet reversed(PassageSet set);
  /// The members, sorted. A set of one is viewed in place: `set` must outlive the view, and no
  /// set may be added meanwhile.
  [[nodiscard]] std::span<const Passage> view(const PassageSet& set) const;

  void clear();

 private:
  struct Stored {
    std::uint32_t first;
    std::uint32_t size;
  };

  [[nodiscard]] PassageSet intern(std::span<const Passage> members);
  [[nodiscard]] std::span<const Passage> members(std::uint32_t index) const {
    return {members_.data() + stored_[index].first, stored_[index].size};
  }
  void grow_table();

  std::vector<Passage> members_;
  std::vector<Stored> stored_;
  std::vector<std::uint32_t> table_;  // open addressing: index into stored_, or free_slot
  std::vector<Passage> scratch_;
};

}  // namespace loft::cdt
