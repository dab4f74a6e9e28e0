// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/edge_tree.h"

namespace loft::overlay {

/// The edges of rings, ring after ring.
class RingEdges {
 public:
  /// A ring of no edge is a ring.
  void add(std::span<const cdt::Point> ring);

  [[nodiscard]] std::uint32_t ring_count() const {
    return static_cast<std::uint32_t>(first_.size() - 1);
  }
  [[nodiscard]] std::span<const RingEdge> all() const { return edges_; }
  [[nodiscard]] std::span<const RingEdge> of(std::uint32_t ring) const {
    return all().subspan(first_[ring], first_[ring + 1] - first_[ring]);
  }
  [[nodiscard]] const RingEdge& operator[](std::uint32_t e) const { return edges_[e]; }
  [[nodiscard]] std::uint32_t next(std::uint32_t e) const {
    const std::uint32_t ring = edges_[e].ring;
    return e + 1 == first_[ring + 1] ? first_[ring] : e + 1;
  }
  [[nodiscard]] std::uint32_t previous(std::uint32_t e) const {
    const std::uint32_t ring = edges_[e].ring;
    return (e == first_[ring] ? first_[ring + 1] : e) - 1;
  }

 private:
  std::vector<RingEdge> edges_;
  std::vector<std::uint32_t> first_{0};  // by ring, and the end
};

/// Where two rings meet, or one meets itself.
struct RingContact {
  enum class Kind {
    crossing,  ///< they change sides in one point
    stretch,   ///< they run along one another; the place is the smaller end
    touch,     ///< they come to a point and stay on their sides
  };
  Kind kind;
  cdt::Point place;  ///< rounded if it is inside two edges
  std::uint32_t ring;
  std::uint32_t other;  ///< not smaller; the same if it meets itself
};

/// All contacts. Of rings that touch in one point, each touches the next: by number, the same ring
/// as often as it is there. Exact. Cost: O(n log n), and the pairs of edges whose boxes meet.
/// Precondition: the edges have different ends, of usable coordinates (Triangulation::is_usable).
[[nodiscard]] std::vector<RingContact> contacts(const RingEdges& edges, const EdgeTree& tree);

}  // namespace loft::overlay
