// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/live/scene.h"
#include "io/planar/map.h"
#include "overlay/solid.h"

namespace loft::app {

/// Tab Shapes: a tree of operations over shapes, and its result, or that of an expression that was
/// typed over the names of the shapes.
///
///     move      a node: `at` is where its origin lies in its parent
///     reshape   a shape: points around its origin
///     insert    a shape, an operand of the node `id` (default: the root); points in that one's
///     frame remove    a node with all below it set       operation (id, text: unite, intersect,
///     subtract, exclude), angle (id, value), parent
///               (id, value), expression (text; empty: that of the tree)
class ShapesScene : public Scene {
 public:
  /// A gasket: a plate less its bore, bolt holes and slots.
  ShapesScene();
  /// All polygons of a map, united.
  explicit ShapesScene(const io::Map& map);

  [[nodiscard]] Json state() const override;
  Json apply(const Edit& edit) override;
  [[nodiscard]] const cdt::Triangulation& mesh() const override {
    return solid_.overlay().triangulation();
  }
  [[nodiscard]] const overlay::Solid& solid() const { return solid_; }
  /// What is shown.
  [[nodiscard]] overlay::ResultId result() const { return typed_ ? *typed_ : solid_.result(); }

 private:
  struct Node {
    overlay::NodeId id;
    std::string name;
    std::vector<overlay::Ring> rings = {};  // of a shape
    std::optional<overlay::Operation> operation = {};
    cdt::Point at{};
    double angle = 0;
  };

  ItemId add(Node node);
  ItemId add_shape(std::string name, std::vector<overlay::Ring> rings, cdt::Point at);
  ItemId add_operation(std::string name, overlay::Operation operation,
                       const std::vector<ItemId>& operands, cdt::Point at = {}, double angle = 0);
  ItemId add_slot(const std::string& name, cdt::Point at, double angle);
  ItemId add_plate();
  ItemId add_cuts();

  [[nodiscard]] Node& known(const Edit& edit);
  [[nodiscard]] ItemId id_of(overlay::NodeId node) const;
  [[nodiscard]] std::vector<ItemId> with_all_below(ItemId id) const;
  [[nodiscard]] std::string free_name(const std::string& wanted);

  void set_place(Node& node, cdt::Point at, double angle);
  void insert(const Edit& edit, Json& change);
  void put_below(ItemId id, overlay::NodeId parent);
  void remove(const Edit& edit, Json& change);
  void set(const Edit& edit, Json& change);
  void set_operation(const Edit& edit);
  void set_parent(const Edit& edit);
  void set_expression(const std::string& text);
  void forget_expression();
  void keep_expression_right();
  [[nodiscard]] overlay::Expression parsed(const std::string& text) const;
  [[nodiscard]] std::string expression() const;
  [[nodiscard]] Json as_json(ItemId id, const Node& node) const;
  [[nodiscard]] Json described(ItemId id, const Node& node) const;

  overlay::Solid solid_;
  std::map<ItemId, Node> nodes_;
  std::map<overlay::NodeId, ItemId> ids_;
  std::set<std::string> names_;
  std::map<std::string, std::size_t> numbers_;  // of names that were wanted several times
  ItemId next_ = 1;
  ItemId root_ = 0;
  std::optional<overlay::ResultId> typed_;
  std::string text_;  // as it was typed
};

}  // namespace loft::app
