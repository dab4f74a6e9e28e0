// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/live/scene.h"
#include "io/planar/map.h"

namespace loft::app {

/// Tab Map: areas that should belong to one owner each, in parts (islands) that can be dragged;
/// where several claim a place or, between them, nobody, follows.
///
///     move      a part
///     insert    a part of an owner of its own, called `name`
///     remove    a part
///
/// It knows `owners` (at): names of those around a place and of those on whose border it is, and
/// `faults`: overlaps and gaps, with owners, areas and widths.
class MapScene : public Scene {
 public:
  /// Some countries of no world, with a coast and islands.
  MapScene();
  /// An owner a feature.
  explicit MapScene(const io::Map& map);

  [[nodiscard]] Json state() const override;
  Json apply(const Edit& edit) override;
  [[nodiscard]] Json answer(const Question& question) override;
  [[nodiscard]] const cdt::Triangulation& mesh() const override { return overlay_.triangulation(); }
  [[nodiscard]] const overlay::Overlay& map() const { return overlay_; }
  [[nodiscard]] overlay::ResultId overlaps() const { return overlaps_; }
  [[nodiscard]] overlay::ResultId land() const { return land_; }

 private:
  overlay::LayerId add_owner(const std::string& name);
  ItemId add_part(overlay::LayerId owner, std::vector<overlay::Ring> rings, cdt::Point at = {});
  void watch_all();
  void watch_again();
  [[nodiscard]] std::vector<overlay::Expression> all_layers() const;
  void edit_part(const Edit& edit, Json& change);
  void insert(const Edit& edit, Json& change);
  [[nodiscard]] Json as_json(ItemId id, const Item& item) const;
  [[nodiscard]] Json owners_at(cdt::Point p) const;
  [[nodiscard]] Json faults() const;

  overlay::Overlay overlay_;
  std::map<ItemId, Item> parts_;
  ItemId next_ = 1;
  overlay::ResultId land_;      // where somebody is; its holes are gaps
  overlay::ResultId overlaps_;  // where several are
};

}  // namespace loft::app
