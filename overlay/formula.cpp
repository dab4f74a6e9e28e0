// SPDX-License-Identifier: MIT
#include "overlay/formula.h"

#include <algorithm>

namespace loft::overlay {

Formula::Formula(const Expression& expression) {
  const auto terms = expression.terms();
  nodes_.reserve(terms.size());
  std::vector<std::uint32_t> stack;
  for (const Expression::Term& term : terms) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({.kind = term.kind, .asked = term.count});
    if (term.kind != Expression::Term::Kind::layer) {
      const std::size_t first = stack.size() - term.operands;
      adopt(number, std::span(stack).subspan(first));
      stack.resize(first);
    }
    stack.push_back(number);
  }
  list_leaves(terms);
}

void Formula::adopt(std::uint32_t parent, std::span<const std::uint32_t> operands) {
  Node& node = nodes_[parent];
  for (const std::uint32_t operand : operands) {
    nodes_[operand].parent = parent;
    node.are_true += nodes_[operand].is_true ? 1U : 0U;
  }
  node.is_true = is_satisfied(node);
}

void Formula::list_leaves(std::span<const Expression::Term> terms) {
  std::uint32_t bound = 0;
  for (const Expression::Term& term : terms)
    if (term.kind == Expression::Term::Kind::layer) {
      leaves_.push_back(static_cast<std::uint32_t>(&term - terms.data()));
      bound = std::max(bound, term.layer.index() + 1);
    }
  const auto layer_of = [&](std::uint32_t leaf) { return terms[leaf].layer.index(); };
  std::stable_sort(leaves_.begin(), leaves_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return layer_of(a) < layer_of(b); });
  first_leaves_.assign(bound + 1, 0);
  for (const std::uint32_t leaf : leaves_) ++first_leaves_[layer_of(leaf) + 1];
  for (std::size_t i = 1; i < first_leaves_.size(); ++i) first_leaves_[i] += first_leaves_[i - 1];
}

bool Formula::is_satisfied(const Node& node) {
  switch (node.kind) {
    case Expression::Term::Kind::at_least:
      return node.are_true >= node.asked;
    case Expression::Term::Kind::exactly:
      return node.are_true == node.asked;
    case Expression::Term::Kind::odd:
      return node.are_true % 2 != 0;
    case Expression::Term::Kind::layer:
      break;
  }
  return false;
}

bool Formula::is_true(std::span<const LayerId> cover) {
  for (const LayerId layer : cover) turn(layer);
  const bool result = nodes_[root()].is_true;
  for (const LayerId layer : cover) turn(layer);  // as it was
  return result;
}

/// A layer that did not cover does, or the other way round.
void Formula::turn(LayerId layer) {
  if (layer.index() + 1 >= first_leaves_.size()) return;
  for (auto i = first_leaves_[layer.index()]; i < first_leaves_[layer.index() + 1]; ++i)
    turn_leaf(leaves_[i]);
}

void Formula::turn_leaf(std::uint32_t leaf) {
  nodes_[leaf].is_true = !nodes_[leaf].is_true;
  for (std::uint32_t at = leaf; nodes_[at].parent != none;) {
    Node& parent = nodes_[nodes_[at].parent];
    parent.are_true += nodes_[at].is_true ? 1U : -1U;
    const bool was_true = parent.is_true;
    parent.is_true = is_satisfied(parent);
    if (parent.is_true == was_true) return;
    at = nodes_[at].parent;
  }
}

}  // namespace loft::overlay
