// SPDX-License-Identifier: MIT
#include "app/commands/path_scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "app/commands/map_expression.h"
#include "app/exit_code.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "mesh/admitted.h"

namespace loft::app {

namespace {

using cdt::Point;
using overlay::Expression;
using overlay::LayerId;
using overlay::Overlay;
using overlay::Ring;
using overlay::RingId;

constexpr const char* obstacle_layer = "obstacles";
constexpr const char* free_layer = "free";
constexpr const char* frame_layer = "frame";
constexpr const char* wall_layer = "walls";

enum class RingKind { outer, hole };

/// The ring in the direction that it has in a valid polygon: then winding numbers unite polygons.
Ring directed(Ring ring, RingKind kind) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  const int turn = overlay::area(ring).sign();
  if (kind == RingKind::outer ? turn < 0 : turn > 0) std::ranges::reverse(ring);
  return ring;
}

/// Throws InputError unless some feature has the property.
void require_property(const io::Map& map, const std::string& property, const std::string& file) {
  const auto has_it = [&](const io::Feature& one) {
    return io::property(one, property).has_value();
  };
  if (std::ranges::none_of(map.features, has_it))
    throw InputError(file + ": no feature has a text or number " + io::in_quotes(property));
}

cdt::Box box_around(const io::Map& map, std::span<const Point> further) {
  cdt::Box box;
  const auto add_all = [&](std::span<const Point> points) {
    for (const Point& p : points) box.add(p);
  };
  for (const io::Feature& feature : map.features) {
    for (const overlay::Polygon& polygon : feature.polygons) add_all(polygon.outer);
    for (const auto& line : feature.lines) add_all(line);
  }
  add_all(further);
  return box;
}

/// What a coordinate has to be.
double usable(double value) {
  const double largest = admitted::planar.largest;
  if (std::abs(value) < admitted::planar.smallest) return 0;
  return std::clamp(value, -largest, largest);
}

/// A tenth larger, with room for a disc beside everything.
Ring frame_around(const cdt::Box& box, double radius) {
  double margin = std::max(box.high.x - box.low.x, box.high.y - box.low.y) / 10 + 2 * radius;
  if (!(margin > 0)) margin = 1;
  const double left = usable(box.low.x - margin);
  const double low = usable(box.low.y - margin);
  const double right = usable(box.high.x + margin);
  const double high = usable(box.high.y + margin);
  return {{left, low}, {right, low}, {right, high}, {left, high}};
}

}  // namespace

PathScene::PathScene(const io::Map& map, const SceneRules& rules) {
  const std::string property = rules.layer_by.value_or("layer");
  if (rules.layer_by) require_property(map, property, rules.file);
  add_layers(map, rules, property);
  add_features(map, property);
  free_ = rules.free ? expression_over(overlay_, *rules.free, "--free") : free_by_default();
  try {
    space_.emplace(overlay_, free_, std::span(&walls_, 1));
  } catch (const std::invalid_argument&) {
    throw UsageError(without_bounds("--free"));
  }
  if (rules.largest_radius > 0) space_->keep_gaps();
}

LayerId PathScene::layer(const std::string& name) {
  const auto [known, is_new] = layers_.try_emplace(name);
  if (is_new) known->second = overlay_.add_layer(name, overlay::FillRule::nonzero);
  return known->second;
}

/// That of the walls comes last: expressions name the first one of several.
void PathScene::add_layers(const io::Map& map, const SceneRules& rules,
                           const std::string& property) {
  for (const io::Feature& feature : map.features)
    if (!feature.polygons.empty())
      static_cast<void>(layer(io::property(feature, property).value_or(obstacle_layer)));
  static_cast<void>(layer(obstacle_layer));  // for edits
  if (!layers_.contains(frame_layer) && (rules.free || !layers_.contains(free_layer)))
    overlay_.insert(layer(frame_layer),
                    frame_around(box_around(map, rules.ends), rules.largest_radius));
  walls_ = overlay_.add_layer(wall_layer);
}

void PathScene::add_features(const io::Map& map, const std::string& property) {
  std::vector<std::pair<LayerId, Ring>> rings;
  std::vector<overlay::Shape> shapes;
  std::vector<std::size_t> counts;
  for (const io::Feature& feature : map.features) {
    const std::size_t before = rings.size();
    for (const overlay::Polygon& polygon : feature.polygons) {
      const LayerId own = layer(io::property(feature, property).value_or(obstacle_layer));
      rings.emplace_back(own, directed(polygon.outer, RingKind::outer));
      for (const Ring& hole : polygon.holes)
        rings.emplace_back(own, directed(hole, RingKind::hole));
    }
    for (const auto& line : feature.lines) rings.emplace_back(walls_, line);
    counts.push_back(rings.size() - before);
  }
  for (const auto& [own, ring] : rings)
    shapes.push_back({own, ring, own == walls_ ? overlay::open : overlay::closed});
  const std::vector<RingId> ids = overlay_.insert(shapes);
  auto next = ids.begin();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto end = next + static_cast<std::ptrdiff_t>(counts[i]);
    if (const auto name = io::id_or_name(map.features[i])) {
      const bool is_new = features_.try_emplace(*name, next, end).second;
      if (!is_new) ambiguous_.insert(*name);
    }
    next = end;
  }
}

Expression PathScene::free_by_default() const {
  const std::string base = layers_.contains(free_layer) ? free_layer : frame_layer;
  std::vector<LayerId> others;
  for (const auto& [name, id] : layers_)
    if (name != base) others.push_back(id);
  return Expression(layers_.at(base)) - any_of(others);
}

void PathScene::check(std::span<const io::SceneEdit> edits, const std::string& file) const {
  std::map<std::string, std::size_t> there;  // rings and lines of features
  for (const auto& [name, rings] : features_) there[name] = rings.size();
  io::Problems problems;
  const auto complain = [&](const io::SceneEdit& edit, const std::string& problem) {
    problems.add(edit.place + ": " + problem);
  };
  for (const io::SceneEdit& edit : edits) {
    const auto found = there.find(edit.feature);
    const std::string name = io::in_quotes(edit.feature);
    if (edit.kind == io::SceneEdit::Kind::insert) {
      if (!edit.feature.empty() && found != there.end())
        complain(edit, "a feature " + name + " is there already");
      if (!edit.layer.empty() && edit.ends == cdt::closed && !layers_.contains(edit.layer))
        complain(edit, "no layer is called " + io::in_quotes(edit.layer) + "; layers are " +
                           listed_layers(overlay_));
      if (!edit.feature.empty()) there[edit.feature] = 1;
      continue;
    }
    if (found == there.end()) {
      complain(edit, "no feature is called " + name);
      continue;
    }
    if (ambiguous_.contains(edit.feature)) complain(edit, "several features are called " + name);
    if (edit.kind == io::SceneEdit::Kind::reshape && found->second != 1)
      complain(edit, name + " has " + std::to_string(found->second) + " rings and lines, not one");
    if (edit.kind == io::SceneEdit::Kind::remove) there.erase(found);
  }
  problems.raise(file);
}

void PathScene::apply(const io::SceneEdit& edit) {
  overlay_.begin_batch();
  try {
    change(edit);
    overlay_.end_batch();
  } catch (const std::invalid_argument& error) {
    throw InputError(edit.place + ": " + io::one_line(error.what()));
  }
  space_->follow();
}

void PathScene::change(const io::SceneEdit& edit) {
  if (edit.kind == io::SceneEdit::Kind::insert) return insert(edit);
  if (edit.kind == io::SceneEdit::Kind::reshape) return reshape(edit);
  const auto feature = features_.find(edit.feature);
  for (const RingId ring : feature->second) {
    if (edit.kind == io::SceneEdit::Kind::move)
      overlay_.translate(ring, edit.by);
    else
      overlay_.remove(ring);
  }
  if (edit.kind == io::SceneEdit::Kind::remove) features_.erase(feature);
}

void PathScene::reshape(const io::SceneEdit& edit) {
  const RingId ring = features_.at(edit.feature).front();
  const bool is_wall = overlay_.layer(ring) == walls_;
  overlay_.move(ring, is_wall ? edit.points : directed(edit.points, RingKind::outer));
}

void PathScene::insert(const io::SceneEdit& edit) {
  const bool is_wall = edit.ends == cdt::open;
  const LayerId own =
      is_wall ? walls_ : layers_.at(edit.layer.empty() ? obstacle_layer : edit.layer);
  const RingId ring =
      is_wall ? overlay_.insert(own, edit.points, overlay::open)
              : overlay_.insert(own, directed(edit.points, RingKind::outer), overlay::closed);
  if (!edit.feature.empty()) features_[edit.feature] = {ring};
}

io::PathPicture PathScene::picture() {
  const overlay::ResultId shown = overlay_.watch(free_);
  io::PathPicture picture{.free = overlay_.polygons(shown)};
  overlay_.unwatch(shown);
  for (const RingId ring : overlay_.rings(walls_))
    picture.walls.push_back(overlay_.triangulation().points(ring));
  std::ranges::sort(picture.walls);
  return picture;
}

}  // namespace loft::app
