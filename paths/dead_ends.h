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
  /// Takes note of a search of so many steps to come or gone; builds when they were more than it
  /// costs. Returns whether there is anything for this state of the space.
  bool prepare(const FreeSpace& space, std::size_t expansions);
  /// The goals of the next search.
  void mark(std::span<const TriangleId> goals);

  /// Whether a path may go on from a triangle to one beside it.
  [[nodiscard]] bool leads_on(TriangleId from, TriangleId to) const {
    const std::uint32_t onward = onward_[to.index()];
    if (onward == core) return true;
    if (onward_[from.index()] == to.index()) return !has_all_goals(from);
    return marks_[to.index()] == mark_;
  }

 private:
  static constexpr std::uint32_t core = 0xffff'ffff;
  static constexpr std::uint32_t root = 0xffff'fffe;

  void build(const FreeSpace& space);
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
