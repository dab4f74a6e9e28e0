// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/live/scene.h"
#include "io/planar/map.h"

namespace loft::app {

/// The names of all tabs, in the order of the page.
[[nodiscard]] std::vector<std::string> tab_names();

/// The scene of a tab: its own, or one made of a map. Precondition: it is a name of a tab.
[[nodiscard]] std::unique_ptr<Scene> make_scene(const std::string& tab, const io::Map* map);

/// The tab that a map is for, by what is in it: points with a property `value` are for `field`,
/// points and lines without polygons for `classes`; lines, points and layers among polygons are
/// walls, agents and obstacles of `paths`; polygons with names are a `map`, others `shapes`.
[[nodiscard]] std::string tab_for(const io::Map& map);

}  // namespace loft::app
