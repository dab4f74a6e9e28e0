// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/json.h"
#include "app/terminal.h"
#include "io/planar/map.h"
#include "overlay/overlay.h"

namespace loft::app {

/// The name of the layer that each feature belongs to, by map.
using LayerNames = std::vector<std::vector<std::string>>;

/// What messages call an input: the file, or `standard input`.
[[nodiscard]] std::string shown_name(const std::filesystem::path& input);

/// What inputs are called as layers: files without folder and extension, `stdin`. Throws UsageError
/// where two are called the same.
[[nodiscard]] std::vector<std::string> layer_names(std::span<const std::filesystem::path> inputs);

/// A layer for each map.
[[nodiscard]] LayerNames by_input(std::span<const io::Map> maps,
                                  std::span<const std::string> names);
/// A layer for each value of a property. Throws InputError that lists features without it, and
/// values that are in several inputs.
[[nodiscard]] LayerNames by_property(std::span<const io::Map> maps,
                                     std::span<const std::filesystem::path> inputs,
                                     const std::string& property);
/// The same; where `property` is none: by the property `name`, features without it each by its
/// number, `feature 7`.
[[nodiscard]] LayerNames by_feature(std::span<const io::Map> maps,
                                    std::span<const std::filesystem::path> inputs,
                                    const std::optional<std::string>& property);

/// The polygons of maps, in layers that are numbered as their names appear.
[[nodiscard]] overlay::Overlay overlay_of(std::span<const io::Map> maps, const LayerNames& names,
                                          overlay::FillRule rule = overlay::FillRule::even_odd);

/// Each feature of a map in a layer of its own, of the same number, whatever they are called.
[[nodiscard]] overlay::Overlay overlay_of_features(const io::Map& map,
                                                   std::span<const std::string> names);

/// The coordinate system that the maps have, as they say it. Throws InputError if they say
/// different things.
[[nodiscard]] std::string common_crs(std::span<const io::Map> maps,
                                     std::span<const std::filesystem::path> inputs);

/// The names of layers for reports; as the text of a JSON list; and with semicolons between them,
/// as CSV has them.
[[nodiscard]] Json names_as_json(const overlay::Overlay& overlay,
                                 std::span<const overlay::LayerId> layers);
[[nodiscard]] std::string json_list(const overlay::Overlay& overlay,
                                    std::span<const overlay::LayerId> layers);
[[nodiscard]] std::string joined_names(const overlay::Overlay& overlay,
                                       std::span<const overlay::LayerId> layers);

/// What is said of maps whose lines or points are not used; nothing where there are none.
[[nodiscard]] std::optional<std::string> note_on_lines(std::span<const io::Map> maps);
/// Says what rings enclose nothing, where rounding decides, and what was written.
void say_notes(Terminal& terminal, const overlay::Overlay& overlay,
               std::span<const std::filesystem::path> outputs);

}  // namespace loft::app
