// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "paths/free_space.h"

namespace loft::paths {

/// Where a search need not look. Sides over which alone one gets from some triangles to others are
/// bridges; what is joined without them is a part, and the parts are a tree. A shortest path enters
/// no triangle twice, so it goes from part to part as the tree has it, straight to that of its
/// goal, and leaves out all others: dead ends, and rooms behind one door.
///
/// Built once for a state of the space, and worth it after some searches in that. Cost:
/// O(triangles) to build, then for each search the parts between the goals and the root of the
/// tree.
class DeadEnds {
 public:
  /// A search begins, for these goals. Builds if searches before it, in this state of the space,
  /// took more steps than that costs.
  void begin(const FreeSpace& space, std::span<const TriangleId> goals);
  /// It has ended, after so many steps.
  void end(const FreeSpace& space, std::size_t expansions) { prepare(space, expansions); }

  /// The twin of an edge, if a path may go there: all that can be crossed, until something is
  /// built.
  [[nodiscard]] EdgeId beyond(const FreeSpace& space, EdgeId e) const {
    const EdgeId entry = space.beyond(e);
    if (!is_built_ || entry.is_none()) return entry;
    return leads_on(Triangulation::triangle(e), Triangulation::triangle(entry)) ? entry
                                                                                : EdgeId::none();
  }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;

  /// Triangles that are joined without bridges.
  struct Part {
    std::uint32_t above = none;  // the next one towards the root; none for that
    std::uint32_t mark = 0;      // mark_ if goals are on this side of it
    std::uint32_t goals = 0;     // and how many
  };

  /// Whether a path may go on from a triangle to one beside it.
  [[nodiscard]] bool leads_on(TriangleId from, TriangleId to) const {
    const std::uint32_t here = part_of_[from.index()];
    const std::uint32_t there = part_of_[to.index()];
    if (here == there) return true;
    if (parts_[here].above == there) return !has_all_goals(parts_[here]);
    return parts_[there].mark == mark_;
  }
  [[nodiscard]] bool has_all_goals(const Part& part) const {
    return part.mark == mark_ && part.goals == goals_;
  }

  void prepare(const FreeSpace& space, std::size_t expansions);
  void build(const FreeSpace& space);
  void gather_parts(const FreeSpace& space, TriangleId start);
  void come_to(TriangleId t, EdgeId entry);
  void lead_back(TriangleId t, std::uint32_t to);
  void close_part(TriangleId first, std::uint32_t before);
  void mark(std::span<const TriangleId> goals);

  std::uint64_t state_ = 0;  // FreeSpace::state()
  std::size_t spent_ = 0;
  bool is_built_ = false;
  std::vector<std::uint32_t> part_of_;  // by triangle
  std::vector<Part> parts_;
  std::uint32_t mark_ = 0;
  std::uint32_t goals_ = 0;

  // Of one build (Tarjan, "A note on finding the bridges of a graph", 1974).
  struct Visit {
    TriangleId triangle;
    EdgeId entry;  // the edge it was come to over
    unsigned corner = 0;
  };
  std::vector<std::uint32_t> order_;   // by triangle: when it was come to
  std::vector<std::uint32_t> oldest_;  // by triangle: what leads back from it, without a bridge
  std::vector<Visit> way_;
  std::vector<TriangleId> open_;  // come to, and in no part yet
  std::uint32_t count_ = 0;
};

}  // namespace loft::paths
