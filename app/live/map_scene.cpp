// SPDX-License-Identifier: MIT
#include "app/live/map_scene.h"

#include <utility>

#include "app/live/made_up_world.h"
#include "overlay/coverage.h"

namespace loft::app {

namespace {

using cdt::Point;
using overlay::LayerId;
using overlay::Ring;

Json names_of(const overlay::Overlay& overlay, const std::vector<LayerId>& layers) {
  Json names = Json::array();
  for (const LayerId layer : layers) names.push_back(overlay.name(layer));
  return names;
}

Json faults_as_json(const overlay::Overlay& overlay,
                    const std::vector<overlay::CoverageFault>& faults) {
  constexpr std::size_t most = 200;
  Json list = Json::array();
  for (const overlay::CoverageFault& fault : faults) {
    if (list.size() == most) break;
    list.push_back({{"owners", names_of(overlay, fault.layers)},
                    {"area", fault.area.to_double()},
                    {"width", fault.width},
                    {"at", as_json(fault.polygon.outer.front())}});
  }
  return list;
}

}  // namespace

MapScene::MapScene() {
  for (MadeUpCountry& country : made_up_world()) {
    const LayerId owner = add_owner(country.name);
    for (Ring& part : country.parts) add_part(owner, {directed(std::move(part), 1)});
  }
  watch_all();
}

MapScene::MapScene(const io::Map& map) {
  std::vector<overlay::Shape> shapes;
  for (const io::Feature& feature : map.features) {
    if (feature.polygons.empty()) continue;
    const auto name = io::property(feature, "name");
    const LayerId owner = add_owner(name ? *name : io::id_or_name(feature).value_or("unnamed"));
    for (const overlay::Polygon& polygon : feature.polygons) {
      const Item& part =
          parts_.emplace(next_++, Item{.rings = directed_rings(polygon), .layer = owner})
              .first->second;
      for (const Ring& ring : part.rings) shapes.push_back({owner, ring});
    }
  }
  const auto ids = overlay_.insert(shapes);
  auto next = ids.begin();
  for (auto& [id, part] : parts_)
    for (std::size_t i = 0; i < part.rings.size(); ++i) part.ids.push_back(*next++);
  watch_all();
}

LayerId MapScene::add_owner(const std::string& name) {
  return overlay_.add_layer(name, overlay::FillRule::nonzero);
}

ItemId MapScene::add_part(LayerId owner, std::vector<Ring> rings, Point at) {
  Item part{.rings = std::move(rings), .layer = owner, .at = at};
  for (const Ring& ring : part.rings) part.ids.push_back(overlay_.insert(owner, ring));
  parts_.emplace(next_, std::move(part));
  return next_++;
}

std::vector<overlay::Expression> MapScene::all_layers() const {
  std::vector<overlay::Expression> all;
  for (std::uint32_t i = 0; i < overlay_.layer_count(); ++i) all.emplace_back(LayerId(i));
  return all;
}

void MapScene::watch_all() {
  land_ = overlay_.watch(overlay::at_least(1, all_layers()));
  overlaps_ = overlay_.watch(overlay::at_least(2, all_layers()));
}

/// With a layer more.
void MapScene::watch_again() {
  overlay_.unwatch(land_);
  overlay_.unwatch(overlaps_);
  watch_all();
}

Json MapScene::as_json(ItemId id, const Item& item) const {
  Json json{{"id", id},
            {"owner", item.layer.index()},
            {"name", overlay_.name(item.layer)},
            {"at", app::as_json(item.at)}};
  json["rings"] = Json::array();
  for (const Ring& ring : item.rings) json["rings"].push_back(flat(ring));
  return json;
}

Json MapScene::state() const {
  Json state;
  state["parts"] = Json::array();
  cdt::Box around;
  for (const auto& [id, part] : parts_) {
    state["parts"].push_back(as_json(id, part));
    for (const Point& p : part.rings.front()) around.add({p.x + part.at.x, p.y + part.at.y});
  }
  if (!around.is_empty()) state["box"] = app::as_json(around);
  state["land"] = all_of_result(overlay_, land_);
  state["overlaps"] = all_of_result(overlay_, overlaps_);
  add_cost(state);
  return state;
}

Json MapScene::apply(const Edit& edit) {
  Json change;
  if (edit.kind == Edit::Kind::insert) {
    insert(edit, change);
    change["land"] = all_of_result(overlay_, land_);
    change["overlaps"] = all_of_result(overlay_, overlaps_);
  } else {
    edit_part(edit, change);
    change["land"] = change_of(overlay_, land_);
    change["overlaps"] = change_of(overlay_, overlaps_);
  }
  add_cost(change);
  return change;
}

void MapScene::edit_part(const Edit& edit, Json& change) {
  const auto part = parts_.find(edit.id.value_or(0));
  if (part == parts_.end()) throw Refusal(422, "there is no such part");
  if (edit.kind == Edit::Kind::move) {
    require_usable(part->second, *edit.at);
    measure_edit([&] {
      overlay_.begin_batch();
      place(overlay_, part->second, *edit.at);
      overlay_.end_batch();
    });
    change["moved"] = Json::array({{{"id", part->first}, {"at", app::as_json(*edit.at)}}});
  } else if (edit.kind == Edit::Kind::remove) {
    measure_edit([&] {
      overlay_.begin_batch();
      for (const overlay::RingId ring : part->second.ids) overlay_.remove(ring);
      overlay_.end_batch();
    });
    change["removed"] = Json::array({part->first});
    parts_.erase(part);
  } else {
    throw Refusal(422, "parts are moved, inserted and removed");
  }
}

void MapScene::insert(const Edit& edit, Json& change) {
  if (overlay_.layer_count() >= 2000 || parts_.size() >= most_items)
    throw Refusal(422, "there are as many owners as there may be");
  ItemId id = 0;
  measure_edit([&] {
    id = add_part(add_owner(edit.name.empty() ? "new" : edit.name), {directed(edit.points, 1)});
    watch_again();
  });
  change["parts"] = Json::array({as_json(id, parts_.at(id))});
}

Json MapScene::answer(const Question& question) {
  if (question.what == "owners" && question.at) return owners_at(*question.at);
  if (question.what == "faults") return faults();
  return Scene::answer(question);
}

Json MapScene::owners_at(Point p) const {
  const overlay::Cover cover = overlay_.cover(p);
  return {{"inside", names_of(overlay_, cover.inside)},
          {"on_border_of", names_of(overlay_, cover.on_border_of)}};
}

Json MapScene::faults() const {
  const overlay::CoverageFaults found = overlay::check_coverage(overlay_);
  return {{"overlaps", faults_as_json(overlay_, found.overlaps)},
          {"gaps", faults_as_json(overlay_, found.gaps)},
          {"overlap_count", found.overlaps.size()},
          {"gap_count", found.gaps.size()}};
}

}  // namespace loft::app
