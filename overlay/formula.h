// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/expression.h"

namespace loft::overlay {

/// An expression made ready to be asked often: what it says where no layer is, is known, and a
/// place is asked for from the layers that cover it, upwards as far as that makes a difference. So
/// of a tree with thousands of leaves only the ways from a few of them to the root are looked at.
class Formula {
 public:
  /// Cost: O(terms).
  explicit Formula(const Expression& expression);

  /// Whether a place with these layers, each once, belongs to it. Cost: for each occurrence of
  /// each, at most the height of the tree.
  [[nodiscard]] bool is_true(std::span<const LayerId> cover);
  /// Whether places that no layer covers belong to it.
  [[nodiscard]] bool is_true_outside() const { return nodes_[root()].is_true; }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;

  struct Node {
    Expression::Term::Kind kind;
    bool is_true = false;
    std::uint32_t parent = none;
    std::uint32_t asked = 0;     // how many operands it wants
    std::uint32_t are_true = 0;  // how many are true
  };

  [[nodiscard]] std::uint32_t root() const { return static_cast<std::uint32_t>(nodes_.size() - 1); }
  [[nodiscard]] static bool is_satisfied(const Node& node);
  void adopt(std::uint32_t parent, std::span<const std::uint32_t> operands);
  void list_leaves(std::span<const Expression::Term> terms);
  void turn(LayerId layer);
  void turn_leaf(std::uint32_t leaf);

  std::vector<Node> nodes_;                  // by term
  std::vector<std::uint32_t> leaves_;        // terms, by layer
  std::vector<std::uint32_t> first_leaves_;  // by layer: where its own begin
};

}  // namespace loft::overlay
