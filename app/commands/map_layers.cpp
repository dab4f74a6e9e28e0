// SPDX-License-Identifier: MIT
#include "app/commands/map_layers.h"

#include <algorithm>
#include <map>

#include "app/exit_code.h"
#include "app/report.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "reconstruct/defect.h"

namespace loft::app {

using std::filesystem::path;

namespace {

/// `; its properties are 'a', 'b'`
std::string known_properties(const io::Feature& feature) {
  std::string known;
  for (const std::string& name : io::property_names(feature))
    known += (known.empty() ? "; its properties are " : ", ") + io::in_quotes(name);
  return known.empty() ? "; it has no properties" : known;
}

/// Finds names that several inputs have.
class NameClashes {
 public:
  explicit NameClashes(std::span<const path> inputs) : inputs_(inputs) {}

  /// A complaint, once for each name and input.
  std::optional<std::string> add(const std::string& name, std::size_t input) {
    const auto [known, is_new] = inputs_of_.try_emplace(name, input);
    if (is_new || std::exchange(known->second, input) == input) return {};
    return shown_name(inputs_[input]) + ": a layer " + io::in_quotes(name) +
           " is in an input before it, too";
  }

 private:
  std::span<const path> inputs_;
  std::map<std::string, std::size_t> inputs_of_;  // the last one
};

/// Adds the rings of a feature as shapes of its layer.
void add_rings(std::vector<overlay::Shape>& shapes, const io::Feature& feature,
               overlay::LayerId layer) {
  for (const overlay::Polygon& polygon : feature.polygons) {
    shapes.push_back({layer, polygon.outer});
    for (const overlay::Ring& hole : polygon.holes) shapes.push_back({layer, hole});
  }
}

}  // namespace

std::string shown_name(const path& input) {
  return input == "-" ? std::string("standard input") : input.string();
}

std::vector<std::string> layer_names(std::span<const path> inputs) {
  std::vector<std::string> names;
  for (const path& input : inputs) {
    names.push_back(input == "-" ? "stdin" : io::json_text(input.stem().string()));
    const auto same = std::ranges::find(names, names.back()) - names.begin();
    if (static_cast<std::size_t>(same) + 1 < names.size())
      throw UsageError(shown_name(inputs[static_cast<std::size_t>(same)]) + " and " +
                       shown_name(input) + " would both be the layer " +
                       io::in_quotes(names.back()) + "; rename one");
  }
  return names;
}

LayerNames by_input(std::span<const io::Map> maps, std::span<const std::string> names) {
  LayerNames result;
  for (const io::Map& map : maps) result.emplace_back(map.features.size(), names[result.size()]);
  return result;
}

LayerNames by_property(std::span<const io::Map> maps, std::span<const path> inputs,
                       const std::string& property) {
  LayerNames result;
  io::Problems problems;
  NameClashes clashes(inputs);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    std::vector<std::string>& names = result.emplace_back();
    for (const io::Feature& feature : maps[i].features) {
      const auto name = io::property(feature, property);
      if (!name)
        problems.add(shown_name(inputs[i]) + ": feature " + std::to_string(names.size()) +
                     ": has no text or number " + io::in_quotes(property) +
                     known_properties(feature));
      names.push_back(name.value_or(""));
      if (!name) continue;
      if (const auto clash = clashes.add(*name, i)) problems.add(*clash);
    }
  }
  problems.raise(shown_name(inputs.front()));
  return result;
}

LayerNames by_feature(std::span<const io::Map> maps, std::span<const path> inputs,
                      const std::optional<std::string>& property) {
  if (property) return by_property(maps, inputs, *property);
  LayerNames result;
  for (const io::Map& map : maps) {
    std::vector<std::string>& names = result.emplace_back();
    for (const io::Feature& feature : map.features)
      names.push_back(
          io::property(feature, "name").value_or("feature " + std::to_string(names.size())));
  }
  return result;
}

overlay::Overlay overlay_of(std::span<const io::Map> maps, const LayerNames& names,
                            overlay::FillRule rule) {
  overlay::Overlay overlay;
  std::map<std::string, overlay::LayerId> layers;
  std::vector<overlay::Shape> shapes;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    for (std::size_t feature = 0; feature < names[i].size(); ++feature) {
      const auto [known, is_new] = layers.try_emplace(names[i][feature]);
      if (is_new) known->second = overlay.add_layer(names[i][feature], rule);
      add_rings(shapes, maps[i].features[feature], known->second);
    }
  }
  overlay.insert(shapes);
  return overlay;
}

overlay::Overlay overlay_of_features(const io::Map& map, std::span<const std::string> names) {
  overlay::Overlay overlay;
  std::vector<overlay::Shape> shapes;
  for (std::size_t i = 0; i < map.features.size(); ++i)
    add_rings(shapes, map.features[i], overlay.add_layer(names[i]));
  overlay.insert(shapes);
  return overlay;
}

std::string common_crs(std::span<const io::Map> maps, std::span<const path> inputs) {
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (maps[i].crs.empty()) continue;
    if (!first) first = i;
    if (maps[i].crs != maps[*first].crs)
      throw InputError(shown_name(inputs[i]) + ": its coordinate system is not that of " +
                       shown_name(inputs[*first]) + "; bring them to one, for example by ogr2ogr");
  }
  return first ? maps[*first].crs : std::string();
}

Json names_as_json(const overlay::Overlay& overlay, std::span<const overlay::LayerId> layers) {
  Json list = Json::array();
  for (const overlay::LayerId layer : layers) list.push_back(overlay.name(layer));
  return list;
}

std::string json_list(const overlay::Overlay& overlay, std::span<const overlay::LayerId> layers) {
  std::string text = "[";
  for (const overlay::LayerId layer : layers) {
    if (text.size() > 1) text += ',';
    io::append_json_string(text, overlay.name(layer));
  }
  return text + ']';
}

std::string joined_names(const overlay::Overlay& overlay,
                         std::span<const overlay::LayerId> layers) {
  std::string text;
  for (const overlay::LayerId layer : layers) {
    if (!text.empty()) text += ';';
    text += overlay.name(layer);
  }
  return text;
}

std::optional<std::string> note_on_lines(std::span<const io::Map> maps) {
  std::size_t lines = 0;
  std::size_t points = 0;
  for (const io::Map& map : maps) {
    for (const io::Feature& feature : map.features) {
      lines += feature.lines.size();
      points += feature.points.size();
    }
  }
  if (lines + points == 0) return {};
  return "left out " + counted(lines, "line") + " and " + counted(points, "point") +
         ": only polygons have an inside";
}

void say_notes(Terminal& terminal, const overlay::Overlay& overlay, std::span<const path> outputs) {
  if (const std::size_t empty = overlay.rings_without_inside().size(); empty > 0)
    terminal.say(counted(empty, "ring") + " without an inside: fewer than three places");
  if (const std::size_t snaps = overlay.triangulation().snaps().size(); snaps > 0)
    terminal.say("rounding decides in " + counted(snaps, "place") +
                 ": an outline goes through a vertex hardly beside it, or past one hardly on it");
  for (const path& output : outputs) terminal.say("wrote " + output.string());
}

}  // namespace loft::app
