// SPDX-License-Identifier: MIT
#include "overlay/solid.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace loft::overlay {

namespace {

using Term = Expression::Term;
using Kind = Expression::Term::Kind;

/// The terms of an operation, after those of its operands.
void append_operation(std::vector<Term>& terms, Operation operation, std::uint32_t operands) {
  const auto append = [&](Kind kind, std::uint32_t of, std::uint32_t count) {
    terms.push_back({.kind = kind, .layer = {}, .operands = of, .count = count});
  };
  switch (operation) {
    case Operation::unite:
      return append(Kind::at_least, operands, 1);
    case Operation::intersect:
      return append(Kind::at_least, operands, std::max(operands, 1U));
    case Operation::exclude:
      return append(Kind::odd, operands, 0);
    case Operation::subtract:
      if (operands < 2) return append(Kind::at_least, operands, 1);
      append(Kind::exactly, operands - 1, 0);
      append(Kind::at_least, 2, 2);
  }
}

}  // namespace

Solid::Solid() : result_(overlay_.watch(Expression())) {}

Solid::Node& Solid::known(NodeId node) {
  if (!is_node(node)) throw std::invalid_argument("solid: there is no such node");
  return nodes_[node.index()];
}

const Solid::Node& Solid::known(NodeId node) const {
  if (!is_node(node)) throw std::invalid_argument("solid: there is no such node");
  return nodes_[node.index()];
}

bool Solid::is_node(NodeId node) const {
  return node.index() < nodes_.size() && nodes_[node.index()].is_there;
}

std::span<const NodeId> Solid::operands(NodeId node) const { return known(node).operands; }
NodeId Solid::parent(NodeId node) const { return known(node).parent; }
const Affine& Solid::transform(NodeId node) const { return known(node).transform; }
LayerId Solid::layer(NodeId shape) const { return known(shape).layer; }

NodeId Solid::add(Node node) {
  node.is_there = true;
  if (free_.empty()) {
    nodes_.push_back(std::move(node));
    return NodeId(static_cast<std::uint32_t>(nodes_.size() - 1));
  }
  const NodeId id = free_.back();
  free_.pop_back();
  nodes_[id.index()] = std::move(node);
  return id;
}

namespace {

/// Rings where a map puts them. Throws std::invalid_argument for points that cannot be there.
std::vector<Ring> placed(const std::vector<Ring>& rings, const Affine& map) {
  std::vector<Ring> result = rings;
  for (Ring& ring : result) {
    if (ring.empty()) throw std::invalid_argument("solid: a ring has no point");
    for (Point& p : ring) {
      p = map(p);
      if (!cdt::Triangulation::is_usable(p))
        throw std::invalid_argument(
            "solid: a point comes to where it is not usable: coordinates are 0 or between 1e-50 "
            "and "
            "1e75 in magnitude");
    }
  }
  return result;
}

}  // namespace

NodeId Solid::shape(std::vector<Ring> rings, FillRule rule) {
  const std::vector<Ring> as_given = placed(rings, {});
  Node node;
  node.is_shape = true;
  node.layer = take_layer(rule);
  node.rings = std::move(rings);
  overlay_.begin_batch();
  insert_rings(node, as_given);
  overlay_.end_batch();
  return add(std::move(node));
}

void Solid::insert_rings(Node& shape, const std::vector<Ring>& placed_rings) {
  shape.ids.clear();
  for (const Ring& ring : placed_rings)
    shape.ids.push_back(overlay_.insert(shape.layer, ring, closed));
}

/// One that is left over, or a new one.
LayerId Solid::take_layer(FillRule rule) {
  const auto spare = std::ranges::find_if(
      free_layers_, [&](LayerId layer) { return overlay_.rule(layer) == rule; });
  if (spare == free_layers_.end())
    return overlay_.add_layer("shape " + std::to_string(overlay_.layer_count()), rule);
  const LayerId layer = *spare;
  free_layers_.erase(spare);
  return layer;
}

NodeId Solid::combine(Operation operation, std::vector<NodeId> operands) {
  for (const NodeId operand : operands)
    if (!known(operand).parent.is_none() || std::ranges::count(operands, operand) > 1)
      throw std::invalid_argument("solid: an operand has a parent already");
  Node node;
  node.operation = operation;
  node.operands = operands;
  const NodeId id = add(std::move(node));
  for (const NodeId operand : operands) nodes_[operand.index()].parent = id;
  return id;
}

Solid::Node& Solid::known_shape(NodeId node) {
  Node& result = known(node);
  if (!result.is_shape) throw std::invalid_argument("solid: the node is no shape");
  return result;
}

void Solid::set_shape(NodeId shape, std::vector<Ring> rings) {
  Node& node = known_shape(shape);
  const std::vector<Ring> there = placed(rings, whole_transform(shape));
  node.rings = std::move(rings);
  overlay_.begin_batch();
  for (const RingId id : node.ids) overlay_.remove(id);
  insert_rings(node, there);
  overlay_.end_batch();
}

void Solid::set_operation(NodeId node, Operation operation) {
  Node& one = known(node);
  if (one.is_shape) throw std::invalid_argument("solid: a shape has no operation");
  one.operation = operation;
  update_result();
}

void Solid::set_transform(NodeId node, const Affine& transform) {
  const Affine before = std::exchange(known(node).transform, transform);
  try {
    place_all_below(node);
  } catch (...) {
    known(node).transform = before;
    throw;
  }
}

/// All shapes below a node go where the transforms put them, as one edit.
void Solid::place_all_below(NodeId node) {
  std::vector<std::pair<NodeId, std::vector<Ring>>> there;
  for (const NodeId one : below(node))
    if (known(one).is_shape)
      there.emplace_back(one, placed(known(one).rings, whole_transform(one)));
  overlay_.begin_batch();
  for (const auto& [shape, rings] : there)
    for (std::size_t i = 0; i < rings.size(); ++i) overlay_.move(known(shape).ids[i], rings[i]);
  overlay_.end_batch();
}

void Solid::set_parent(NodeId node, NodeId parent) {
  (void)known(node);
  if (!parent.is_none() && known(parent).is_shape)
    throw std::invalid_argument("solid: a shape has no operands");
  for (NodeId at = parent; !at.is_none(); at = known(at).parent)
    if (at == node) throw std::invalid_argument("solid: a node would contain itself");
  const NodeId before = known(node).parent;
  const auto move_to = [&](NodeId other) {
    detach(node);
    known(node).parent = other;
    if (!other.is_none()) known(other).operands.push_back(node);
  };
  move_to(parent);
  try {
    place_all_below(node);
  } catch (...) {
    move_to(before);
    throw;
  }
  update_result();
}

void Solid::detach(NodeId node) {
  Node& one = known(node);
  if (!one.parent.is_none()) std::erase(known(one.parent).operands, node);
  one.parent = NodeId::none();
}

void Solid::remove(NodeId node) {
  const std::vector<NodeId> all = below(node);
  detach(node);
  overlay_.begin_batch();
  for (const NodeId one : all) {
    Node& gone = nodes_[one.index()];
    if (gone.is_shape) {
      overlay_.clear(gone.layer);
      free_layers_.push_back(gone.layer);
    }
    if (one == root_) root_ = NodeId::none();
    gone = {};
    free_.push_back(one);
  }
  overlay_.end_batch();
  update_result();
}

void Solid::set_root(NodeId root) {
  if (!root.is_none()) (void)known(root);
  root_ = root;
  update_result();
}

Affine Solid::whole_transform(NodeId node) const {
  Affine whole;
  for (NodeId at = node; !at.is_none(); at = known(at).parent) whole = known(at).transform * whole;
  return whole;
}

/// A node and all below it, each before its operands.
std::vector<NodeId> Solid::below(NodeId node) const {
  (void)known(node);
  std::vector<NodeId> result{node};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto& operands = known(result[i]).operands;
    result.insert(result.end(), operands.begin(), operands.end());
  }
  return result;
}

Expression Solid::expression() const {
  if (root_.is_none()) return {};
  struct Step {
    NodeId node;
    std::size_t next = 0;  // operand
  };
  std::vector<Term> terms;
  std::vector<Step> stack{{root_}};
  while (!stack.empty()) {
    Step& step = stack.back();
    const Node& node = known(step.node);
    if (node.is_shape) {
      terms.push_back({.kind = Kind::layer, .layer = node.layer});
    } else if (step.next < node.operands.size()) {
      stack.push_back({node.operands[step.next++]});
      continue;
    } else {
      append_operation(terms, node.operation, static_cast<std::uint32_t>(node.operands.size()));
    }
    stack.pop_back();
  }
  return Expression::of(std::move(terms));
}

}  // namespace loft::overlay
