// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "overlay/overlay.h"

namespace loft::overlay {

struct NodeTag {
  static constexpr char prefix = 'n';
};
/// A shape, or an operation, of a solid.
using NodeId = cdt::Id<NodeTag>;

enum class Operation {
  unite,
  intersect,
  subtract,  ///< the first operand without all others
  exclude,   ///< an odd number of the operands
};

/// Constructive solid geometry in the plane: a tree of operations over shapes, each node with a
/// transform of its own, that is edited while its result follows. What the designer sees is the
/// tree, not the triangulation (KBT, section 7).
///
/// Nodes are made without a parent and are part of the result if they are below root(). Ids of
/// removed nodes are used again. Edits throw std::invalid_argument, and change nothing, for ids
/// that name nothing, trees that would contain themselves, and points that are no usable
/// coordinates. Points are transformed from where they were given, so that turning to and fro adds
/// up no rounding.
///
/// Cost: of an edit of shapes and transforms, that of an Overlay's for the shapes below; of an
/// operation, O(nodes + covers) and the triangles whose truth changes.
class Solid {
 public:
  Solid();

  /// A shape of several rings, by a rule: with holes, or none.
  NodeId shape(std::vector<Ring> rings, FillRule rule = FillRule::even_odd);
  /// Takes nodes that have no parent.
  NodeId combine(Operation operation, std::vector<NodeId> operands);

  void set_shape(NodeId shape, std::vector<Ring> rings);
  void set_operation(NodeId node, Operation operation);
  /// How a node lies in its parent.
  void set_transform(NodeId node, const Affine& transform);
  /// Makes a node an operand of another, the last one; `none` takes it out of the tree.
  void set_parent(NodeId node, NodeId parent);
  /// Removes a node and all below it.
  void remove(NodeId node);

  /// Whose result is shown; none at first.
  void set_root(NodeId root);
  [[nodiscard]] NodeId root() const { return root_; }
  [[nodiscard]] bool is_node(NodeId node) const;
  [[nodiscard]] std::span<const NodeId> operands(NodeId node) const;
  [[nodiscard]] NodeId parent(NodeId node) const;
  [[nodiscard]] const Affine& transform(NodeId node) const;

  // The result below the root, as Overlay has them.
  [[nodiscard]] MultiPolygon polygons() const { return overlay_.polygons(result_); }
  [[nodiscard]] const ExactArea& area() const { return overlay_.area(result_); }
  [[nodiscard]] const ResultChange& change() const { return overlay_.change(result_); }
  /// The overlay beneath: a layer a shape.
  [[nodiscard]] const Overlay& overlay() const { return overlay_; }
  [[nodiscard]] ResultId result() const { return result_; }
  /// The layer of a shape. Those of removed shapes are taken again.
  [[nodiscard]] LayerId layer(NodeId shape) const;
  /// Results of other expressions over the shapes, beside that of the tree, as Overlay has them.
  ResultId watch(Expression what) { return overlay_.watch(std::move(what)); }
  void unwatch(ResultId other) { overlay_.unwatch(other); }

 private:
  struct Node {
    bool is_there = false;
    bool is_shape = false;
    Operation operation = Operation::unite;
    Affine transform;
    NodeId parent;
    std::vector<NodeId> operands;
    LayerId layer;            // of a shape
    std::vector<Ring> rings;  // as they were given
    std::vector<RingId> ids;  // of the same in the overlay
  };

  [[nodiscard]] Node& known(NodeId node);
  [[nodiscard]] const Node& known(NodeId node) const;
  [[nodiscard]] Node& known_shape(NodeId node);
  NodeId add(Node node);
  void detach(NodeId node);
  [[nodiscard]] LayerId take_layer(FillRule rule);
  [[nodiscard]] Affine whole_transform(NodeId node) const;
  [[nodiscard]] std::vector<NodeId> below(NodeId node) const;
  void place_all_below(NodeId node);
  void insert_rings(Node& shape, const std::vector<Ring>& placed);
  [[nodiscard]] Expression expression() const;
  void update_result() { overlay_.set(result_, expression()); }

  Overlay overlay_;
  ResultId result_;
  NodeId root_;
  std::vector<Node> nodes_;
  std::vector<NodeId> free_;
  std::vector<LayerId> free_layers_;
};

}  // namespace loft::overlay
