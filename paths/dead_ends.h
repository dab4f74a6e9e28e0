// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "paths/free_space.h"

namespace loft::paths {

/// The free triangles from which nothing leads on: what is left over when those with one open side
/// are taken away, again and again, is the core; the others are trees, each triangle of which has a
/// side that leads towards the core, or, where a component has none, to the tree's root. A shortest
/// path enters a tree only where its goal is in it.
///
/// Built once for a state of the space, and worth it after some searches in that.
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
  /// Whether a path may go on from a triangle to one beside it.
  [[nodiscard]] bool leads_on(TriangleId from, TriangleId to) const {
    const std::uint32_t onward = onward_[to.index()];
    if (onward == core) return true;
    if (onward_[from.index()] == to.index()) return !has_all_goals(from);
    return marks_[to.index()] == mark_;
  }

  static constexpr std::uint32_t core = 0xffff'ffff;
  static constexpr std::uint32_t root = 0xffff'fffe;

  void prepare(const FreeSpace& space, std::size_t expansions);
  void build(const FreeSpace& space);
  void mark(std::span<const TriangleId> goals);
  [[nodiscard]] bool has_all_goals(TriangleId t) const {
    return marks_[t.index()] == mark_ && goals_here_[t.index()] == goals_;
  }

  std::uint64_t state_ = 0;  // FreeSpace::state()
  std::size_t spent_ = 0;
  bool is_built_ = false;
  std::vector<std::uint32_t> onward_;      // by triangle: the next one towards the core
  std::vector<std::uint32_t> marks_;       // by triangle: mark_ if goals are on this side of it
  std::vector<std::uint32_t> goals_here_;  // and how many
  std::uint32_t mark_ = 0;
  std::uint32_t goals_ = 0;
};

}  // namespace loft::paths
