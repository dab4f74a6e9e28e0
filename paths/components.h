// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/triangulation.h"

namespace loft::paths {

class FreeSpace;

/// Which free triangles are joined: each has the number of its component, kept from edit to edit.
///
/// An edit cuts holes in what there was and fills them anew. Searches start at all that is beside
/// a hole, in turn, each a step, and become one where they meet. What a search has gone through to
/// the end is a component of its own now; what is left over stays what it was. Where all that is
/// beside a hole is still joined, ways that led through it lead around it, so holes need not be
/// joined to one another, unless a search gets from one to the other. So an edit costs O(made +
/// what the smaller sides of the cut have), or, where nothing is cut, what it takes to find ways
/// around the holes.
class Components {
 public:
  static constexpr std::uint32_t none = 0xffff'ffff;

  /// Forgets all. Cost: O(triangles).
  void build(const FreeSpace& space);
  /// Takes over an edit. `touched`: the triangles that were made, are free now or are no longer, or
  /// have other sides that can be crossed; each once.
  void update(const FreeSpace& space, std::span<const cdt::TriangleId> touched);

  /// The number of a triangle's component; none if it is not free.
  [[nodiscard]] std::uint32_t of(cdt::TriangleId t) const {
    const std::uint32_t label = labels_[t.index()];
    return label == none ? none : root(label);
  }

 private:
  /// What is joined to a place beside the hole, as far as it is known.
  struct Search {
    std::vector<cdt::TriangleId> reached;
    std::size_t next = 0;               // the first one of `reached` whose neighbours are unknown
    std::vector<std::uint32_t> labels;  // of what stayed, beside the hole
    std::uint32_t hole = none;
    bool is_over = false;
  };

  [[nodiscard]] std::uint32_t root(std::uint32_t label) const {
    while (joined_[label] != label) label = joined_[label];
    return label;
  }
  [[nodiscard]] std::uint32_t new_label();
  void flood_from(const FreeSpace& space, cdt::TriangleId start);
  void find_holes(const FreeSpace& space, std::span<const cdt::TriangleId> touched);
  void start_searches(const FreeSpace& space, std::span<const cdt::TriangleId> touched);
  std::uint32_t new_search(std::uint32_t hole);
  std::uint32_t reach(cdt::TriangleId t, std::uint32_t search);
  std::uint32_t meet(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint32_t leader(std::uint32_t search) const;
  [[nodiscard]] std::uint32_t whole_hole(std::uint32_t hole) const;
  void join_holes(std::uint32_t a, std::uint32_t b);
  void step(const FreeSpace& space, std::uint32_t search);
  [[nodiscard]] bool is_settled(std::uint32_t search) const;
  void give_label(const Search& search);

  std::vector<std::uint32_t> labels_;  // by triangle
  std::vector<std::uint32_t> joined_;  // by label: another one for the same component, or itself

  // Of one update.
  std::vector<Search> all_searches_;  // those of this update come first; others spare memory
  std::span<Search> searches_;
  std::vector<std::uint32_t> leaders_;    // by search: one that it has met, or itself
  std::vector<std::uint32_t> search_of_;  // by triangle
  std::vector<std::uint32_t> hole_of_;    // by triangle
  std::vector<std::uint32_t> holes_;      // by hole: one that a search led to from it, or itself
  std::vector<bool> is_touched_;
  std::vector<cdt::TriangleId> front_;
};

}  // namespace loft::paths
