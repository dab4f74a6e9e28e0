// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>

namespace loft::cdt {

/// A typed 32-bit index. `Tag::prefix` is the letter it prints with (`v12`, `t7`).
/// A default-constructed id is `none`: it names nothing.
template <class Tag>
class Id {
 public:
  static constexpr std::uint32_t none_value = 0xffff'ffff;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t index) : index_(index) {}

  [[nodiscard]] static constexpr Id none() { return Id(); }
  [[nodiscard]] constexpr bool is_none() const { return index_ == none_value; }
  [[nodiscard]] constexpr std::uint32_t index() const { return index_; }

  friend constexpr auto operator<=>(Id, Id) = default;

  friend std::ostream& operator<<(std::ostream& out, Id id) {
    out << Tag::prefix;
    return id.is_none() ? out << "none" : out << id.index_;
  }

 private:
  std::uint32_t index_ = none_value;
};

struct VertexTag {
  static constexpr char prefix = 'v';
};
struct EdgeTag {
  static constexpr char prefix = 'e';
};
struct TriangleTag {
  static constexpr char prefix = 't';
};
struct SegmentTag {
  static constexpr char prefix = 's';
};
struct ConstraintTag {
  static constexpr char prefix = 'c';
};

using VertexId = Id<VertexTag>;
/// An oriented edge: `3 * triangle + corner`, from that corner to the next, triangle on the left.
using EdgeId = Id<EdgeTag>;
using TriangleId = Id<TriangleTag>;
/// One straight piece of a constraint as it was inserted, between two consecutive points.
using SegmentId = Id<SegmentTag>;
using ConstraintId = Id<ConstraintTag>;

}  // namespace loft::cdt
/// @cond Doxygen stumbles over specialisations of what it has not seen.
template <class Tag>
struct std::hash<loft::cdt::Id<Tag>> {
  std::size_t operator()(loft::cdt::Id<Tag> id) const noexcept { return id.index(); }
};  /// @endcond
