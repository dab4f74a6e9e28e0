// SPDX-License-Identifier: MIT
#include "app/live/scenes.h"

#include <algorithm>
#include <array>

#include "app/live/classes_scene.h"
#include "app/live/field_scene.h"
#include "app/live/map_scene.h"
#include "app/live/paths_scene.h"
#include "app/live/shapes_scene.h"

namespace loft::app {

namespace {

template <class Kind>
std::unique_ptr<Scene> scene_of(const io::Map* map) {
  if (map == nullptr) return std::make_unique<Kind>();
  return std::make_unique<Kind>(*map);
}

struct TabKind {
  const char* name;
  std::unique_ptr<Scene> (*make)(const io::Map* map);
};

constexpr std::array kinds{
    TabKind{"shapes", scene_of<ShapesScene>}, TabKind{"map", scene_of<MapScene>},
    TabKind{"paths", scene_of<PathsScene>}, TabKind{"field", scene_of<FieldScene>},
    TabKind{"classes", scene_of<ClassesScene>}};

}  // namespace

std::vector<std::string> tab_names() {
  std::vector<std::string> names;
  for (const TabKind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

std::unique_ptr<Scene> make_scene(const std::string& tab, const io::Map* map) {
  return std::ranges::find(kinds, tab, &TabKind::name)->make(map);
}

std::string tab_for(const io::Map& map) {
  const auto is_way = [](const io::Feature& one) {
    return !one.lines.empty() || !one.points.empty() || io::property(one, "layer").has_value();
  };
  const auto has_name = [](const io::Feature& one) { return io::id_or_name(one).has_value(); };
  const auto has_value = [](const io::Feature& one) {
    return !one.points.empty() && io::property(one, "value").has_value();
  };
  const auto has_area = [](const io::Feature& one) { return !one.polygons.empty(); };
  if (std::ranges::any_of(map.features, has_value)) return "field";
  if (std::ranges::none_of(map.features, has_area)) return "classes";
  if (std::ranges::any_of(map.features, is_way)) return "paths";
  return std::ranges::all_of(map.features, has_name) ? "map" : "shapes";
}

}  // namespace loft::app
