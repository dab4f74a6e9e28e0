// SPDX-License-Identifier: MIT
#include "app/live/shapes_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/bytes/text.h"

namespace loft::app {

namespace {

using cdt::Point;
using overlay::Affine;
using overlay::LayerId;
using overlay::NodeId;
using overlay::Operation;
using overlay::Ring;

constexpr std::array<std::pair<const char*, Operation>, 4> operations{
    {{"unite", Operation::unite},
     {"intersect", Operation::intersect},
     {"subtract", Operation::subtract},
     {"exclude", Operation::exclude}}};

const char* word_of(Operation operation) {
  for (const auto& [word, one] : operations)
    if (one == operation) return word;
  return "";
}

Ring disc(double radius, int corners = 64) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

/// As long as that between the middles of its round ends.
Ring stadium(double length, double width) {
  Ring ring;
  for (int i = 0; i < 50; ++i) {
    const double angle =
        std::numbers::pi * (i % 25 + (i > 24 ? 24 : 0)) / 24 - std::numbers::pi / 2;
    const double end = i > 24 ? -length / 2 : length / 2;
    ring.push_back({end + width / 2 * std::cos(angle), width / 2 * std::sin(angle)});
  }
  return ring;
}

Affine transform_of(Point at, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {.xx = c, .xy = -s, .x0 = at.x, .yx = s, .yy = c, .y0 = at.y};
}

Point middle_of(const std::vector<Ring>& rings) {
  cdt::Box around;
  for (const Ring& ring : rings)
    for (const Point& p : ring) around.add(p);
  return {around.low.x / 2 + around.high.x / 2, around.low.y / 2 + around.high.y / 2};
}

std::vector<Ring> around(std::vector<Ring> rings, Point middle) {
  for (Ring& ring : rings) ring = shifted(ring, {-middle.x, -middle.y});
  return rings;
}

std::vector<Ring> rings_of(const io::Feature& feature) {
  std::vector<Ring> rings;
  for (const overlay::Polygon& polygon : feature.polygons) {
    rings.push_back(polygon.outer);
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  }
  return rings;
}

}  // namespace

// --- What there is at first ---

ShapesScene::ShapesScene() {
  root_ = add_operation("gasket", Operation::subtract, {add_plate(), add_cuts()});
  solid_.set_root(nodes_.at(root_).id);
}

ShapesScene::ShapesScene(const io::Map& map) {
  std::vector<ItemId> shapes;
  for (const io::Feature& feature : map.features) {
    std::vector<Ring> rings = rings_of(feature);
    if (rings.empty()) continue;
    const Point middle = middle_of(rings);
    const std::string name = io::id_or_name(feature).value_or("shape");
    shapes.push_back(add_shape(free_name(name), around(std::move(rings), middle), middle));
  }
  root_ = add_operation("all", Operation::unite, shapes);
  solid_.set_root(nodes_.at(root_).id);
}

/// A box with a round end each side, and ears for the bolts.
ItemId ShapesScene::add_plate() {
  std::vector<ItemId> parts{add_shape(free_name("body"), {stadium(100, 60)}, {0, 0})};
  for (const double x : {-40.0, 40.0})
    for (const double y : {28.0, -28.0})
      parts.push_back(add_shape(free_name("ear"), {disc(12)}, {x, y}));
  return add_operation("plate", Operation::unite, parts);
}

ItemId ShapesScene::add_cuts() {
  std::vector<ItemId> all{add_shape(free_name("bore"), {disc(20)}, {0, 0}),
                          add_shape(free_name("port"), {disc(8)}, {52, 0})};
  std::vector<ItemId> bolts;
  for (const double x : {-40.0, 40.0})
    for (const double y : {28.0, -28.0})
      bolts.push_back(add_shape(free_name("bolt"), {disc(5, 32)}, {x, y}));
  all.push_back(add_operation("bolts", Operation::unite, bolts));
  std::vector<ItemId> slots;
  for (const double angle : {-0.9, 0.0, 0.9})
    slots.push_back(add_slot(free_name("slot"), {-18 * std::cos(angle), 18 * std::sin(angle)},
                             std::numbers::pi / 2 - angle));
  all.push_back(add_operation("slots", Operation::unite, slots, {-50, 0}));
  return add_operation("cuts", Operation::unite, all);
}

ItemId ShapesScene::add_slot(const std::string& name, Point at, double angle) {
  const ItemId id = add_shape(name, {stadium(8, 5)}, at);
  set_place(nodes_.at(id), at, angle);
  return id;
}

ItemId ShapesScene::add(Node node) {
  const ItemId id = next_++;
  ids_[node.id] = id;
  nodes_.emplace(id, std::move(node));
  return id;
}

ItemId ShapesScene::add_shape(std::string name, std::vector<Ring> rings, Point at) {
  const NodeId node = solid_.shape(rings);
  try {
    solid_.set_transform(node, transform_of(at, 0));
  } catch (...) {
    solid_.remove(node);
    throw;
  }
  return add({.id = node, .name = std::move(name), .rings = std::move(rings), .at = at});
}

ItemId ShapesScene::add_operation(std::string name, Operation operation,
                                  const std::vector<ItemId>& operands, Point at, double angle) {
  std::vector<NodeId> nodes;
  for (const ItemId operand : operands) nodes.push_back(nodes_.at(operand).id);
  const NodeId node = solid_.combine(operation, nodes);
  const ItemId id = add({.id = node, .name = std::move(name), .operation = operation});
  set_place(nodes_.at(id), at, angle);
  return id;
}

// --- What the page is told ---

Json ShapesScene::state() const {
  Json nodes = Json::array();
  for (const auto& [id, node] : nodes_) nodes.push_back(described(id, node));
  cdt::Box around;
  for (const overlay::BorderEdge& edge : solid_.overlay().border(solid_.result()))
    around.add(edge.from);
  Json state{{"nodes", std::move(nodes)},
             {"root", root_},
             {"result", all_of_result(solid_.overlay(), result())},
             {"expression", expression()},
             {"is_typed", typed_.has_value()}};
  if (!around.is_empty()) state["box"] = app::as_json(around);
  add_cost(state);
  return state;
}

/// What may change of it.
Json ShapesScene::as_json(ItemId id, const Node& node) const {
  const NodeId parent = solid_.parent(node.id);
  Json json{{"id", id}, {"at", app::as_json(node.at)}, {"angle", node.angle}};
  json["parent"] = parent.is_none() ? Json(nullptr) : Json(id_of(parent));
  if (node.operation) json["operation"] = word_of(*node.operation);
  return json;
}

Json ShapesScene::described(ItemId id, const Node& node) const {
  Json json = as_json(id, node);
  json["name"] = node.name;
  if (node.operation) return json;
  json["rings"] = Json::array();
  for (const Ring& ring : node.rings) json["rings"].push_back(flat(ring));
  return json;
}

std::string ShapesScene::expression() const {
  if (typed_) return text_;
  std::map<LayerId, std::string> names;
  for (const auto& [id, node] : nodes_)
    if (!node.operation) names[solid_.layer(node.id)] = node.name;
  const auto& tree = solid_.overlay().expression(solid_.result());
  return to_string(tree, [&](LayerId layer) { return names[layer]; });
}

// --- Edits ---

Json ShapesScene::apply(const Edit& edit) {
  Json change;
  bool is_tree_as_before = false;
  switch (edit.kind) {
    case Edit::Kind::move: {
      Node& node = known(edit);
      measure_edit([&] { set_place(node, *edit.at, node.angle); });
      change["nodes"] = Json::array({as_json(*edit.id, node)});
      is_tree_as_before = true;
      break;
    }
    case Edit::Kind::reshape: {
      Node& node = known(edit);
      if (node.operation) throw Refusal(422, "that is no shape");
      measure_edit([&] { solid_.set_shape(node.id, {edit.points}); });
      node.rings = {edit.points};
      change["shapes"] = Json::array({described(*edit.id, node)});
      is_tree_as_before = true;
      break;
    }
    case Edit::Kind::insert:
      insert(edit, change);
      break;
    case Edit::Kind::remove:
      remove(edit, change);
      break;
    case Edit::Kind::set:
      is_tree_as_before = edit.name == "angle";
      set(edit, change);
  }
  if (!is_tree_as_before) {
    keep_expression_right();
    change["expression"] = expression();
    change["is_typed"] = typed_.has_value();
  }
  // An edit of the tree is several of the overlay, which says what the last one did.
  change["result"] = is_tree_as_before ? change_of(solid_.overlay(), result())
                                       : all_of_result(solid_.overlay(), result());
  add_cost(change);
  return change;
}

ShapesScene::Node& ShapesScene::known(const Edit& edit) {
  const auto found = nodes_.find(edit.id.value_or(0));
  if (found == nodes_.end()) throw Refusal(422, "there is no such node");
  return found->second;
}

ItemId ShapesScene::id_of(NodeId node) const { return ids_.at(node); }

std::vector<ItemId> ShapesScene::with_all_below(ItemId id) const {
  std::vector<ItemId> all{id};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const NodeId operand : solid_.operands(nodes_.at(all[i]).id))
      all.push_back(id_of(operand));
  return all;
}

/// `bolt`, `bolt2`, `bolt3`, ...: each name is given once.
std::string ShapesScene::free_name(const std::string& wanted) {
  std::string name = wanted;
  while (!names_.insert(name).second) name = wanted + std::to_string(++numbers_[wanted] + 1);
  return name;
}

void ShapesScene::set_place(Node& node, Point at, double angle) {
  solid_.set_transform(node.id, transform_of(at, angle));
  node.at = at;
  node.angle = angle;
}

void ShapesScene::insert(const Edit& edit, Json& change) {
  if (nodes_.size() >= most_items) throw Refusal(422, "there are as many shapes as there may be");
  const auto parent = nodes_.find(edit.id.value_or(root_));
  if (parent == nodes_.end() || !parent->second.operation)
    throw Refusal(422, "there is no such operation");
  const Point middle = middle_of({edit.points});
  const std::string name = free_name(edit.name.empty() ? "shape" : edit.name);
  ItemId id = 0;
  measure_edit([&] {
    id = add_shape(name, around({edit.points}, middle), middle);
    put_below(id, parent->second.id);
  });
  change["shapes"] = Json::array({described(id, nodes_.at(id))});
}

void ShapesScene::put_below(ItemId id, NodeId parent) {
  const NodeId node = nodes_.at(id).id;
  try {
    solid_.set_parent(node, parent);
  } catch (...) {
    solid_.remove(node);
    ids_.erase(node);
    nodes_.erase(id);
    throw;
  }
}

void ShapesScene::remove(const Edit& edit, Json& change) {
  const Node& node = known(edit);
  if (*edit.id == root_) throw Refusal(422, "the root stays");
  const std::vector<ItemId> gone = with_all_below(*edit.id);
  measure_edit([&] { solid_.remove(node.id); });
  for (const ItemId id : gone) {
    ids_.erase(nodes_.at(id).id);
    nodes_.erase(id);
  }
  change["removed"] = gone;
}

void ShapesScene::set(const Edit& edit, Json& change) {
  if (edit.name == "expression") {
    if (!edit.text) throw Refusal(422, "an expression is a text");
    return measure_edit([&] { set_expression(*edit.text); });
  }
  Node& node = known(edit);
  if (edit.name == "operation")
    measure_edit([&] { set_operation(edit); });
  else if (edit.name == "parent")
    measure_edit([&] { set_parent(edit); });
  else if (edit.name == "angle" && edit.value && std::abs(*edit.value) < 1e6)
    measure_edit([&] { set_place(node, node.at, *edit.value); });
  else
    throw Refusal(422, "operation, parent, angle or expression can be set");
  change["nodes"] = Json::array({as_json(*edit.id, node)});
}

void ShapesScene::set_operation(const Edit& edit) {
  Node& node = known(edit);
  if (!node.operation) throw Refusal(422, "that is no operation");
  for (const auto& [word, operation] : operations) {
    if (word != edit.text.value_or("")) continue;
    solid_.set_operation(node.id, operation);
    node.operation = operation;
    return;
  }
  throw Refusal(422, "operations are unite, intersect, subtract and exclude");
}

void ShapesScene::set_parent(const Edit& edit) {
  const Node& node = known(edit);
  const double wanted = edit.value.value_or(0);
  const auto parent = std::ranges::find_if(
      nodes_, [&](const auto& one) { return static_cast<double>(one.first) == wanted; });
  if (*edit.id == root_ || parent == nodes_.end() || !parent->second.operation)
    throw Refusal(422, "there is no such operation, or it is the root that is to move");
  solid_.set_parent(node.id, parent->second.id);
}

// --- The expression ---

overlay::Expression ShapesScene::parsed(const std::string& text) const {
  std::map<std::string, LayerId, std::less<>> layers;
  for (const auto& [id, node] : nodes_)
    if (!node.operation) layers.emplace(node.name, solid_.layer(node.id));
  return overlay::parse_expression(text, [&](std::string_view name) -> std::optional<LayerId> {
    const auto found = layers.find(name);
    if (found == layers.end()) return {};
    return found->second;
  });
}

void ShapesScene::set_expression(const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) return forget_expression();
  try {
    const auto other = solid_.watch(parsed(text));
    forget_expression();
    typed_ = other;
    text_ = text;
  } catch (const overlay::ExpressionError& error) {
    throw Refusal(422, io::one_line(error.what()));
  } catch (const std::invalid_argument&) {
    throw Refusal(422, "that is true where no shape is, so it has no bounds");
  }
}

void ShapesScene::forget_expression() {
  if (typed_) solid_.unwatch(*typed_);
  typed_.reset();
}

/// Layers of removed shapes are taken again: the names say which ones are meant.
void ShapesScene::keep_expression_right() {
  if (!typed_) return;
  try {
    if (parsed(text_) != solid_.overlay().expression(*typed_)) forget_expression();
  } catch (const overlay::ExpressionError&) {
    forget_expression();
  }
}

}  // namespace loft::app
