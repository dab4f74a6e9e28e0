// SPDX-License-Identifier: MIT
#include <cstddef>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/map_expression.h"
#include "app/commands/map_layers.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/stopwatch.h"
#include "app/table.h"
#include "app/terminal.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/maps.h"
#include "overlay/faces.h"
#include "reconstruct/number_text.h"

namespace loft::app {

namespace {

using overlay::ExactArea;
using overlay::Expression;
using overlay::LayerId;
using overlay::MultiPolygon;
using overlay::Overlay;
using overlay::ResultId;

/// A result of an expression that the user gave.
struct Kept {
  ResultId id;
  std::string expression;  ///< as it was written
};

/// Which layers cover a face: sorted.
using Owners = std::vector<LayerId>;
/// What each set of owners has.
using Pieces = std::map<Owners, MultiPolygon>;

struct OverlayReport {
  std::vector<ExactArea> layers;  ///< by layer
  std::optional<ExactArea> kept;
  std::size_t polygons = 0;  ///< that are written
  std::size_t holes = 0;
  std::map<std::string, double> seconds;
};

void check_overlay(const OverlayCommand& command) {
  if (!command.keep && !command.all_pieces && !command.areas)
    throw UsageError("loft overlay needs --keep, --all-pieces or --areas");
  if (command.outputs.empty() && !command.areas && !command.json)
    throw UsageError("loft overlay needs --output, --areas or --json: nothing would come out");
  if (!command.outputs.empty() && !command.keep && !command.all_pieces)
    throw UsageError("loft overlay needs --keep or --all-pieces for its output");
  forbid_overwriting(command.inputs, command.outputs);
  for (const auto& output : command.outputs) io::check_writable_map(output);
}

LayerNames names_of_layers(const OverlayCommand& command, std::span<const io::Map> maps) {
  if (command.layer_by) return by_property(maps, command.inputs, *command.layer_by);
  return by_input(maps, layer_names(command.inputs));
}

Kept keep(Overlay& overlay, const std::string& text) {
  try {
    return {overlay.watch(expression_over(overlay, text, "--keep")), text};
  } catch (const std::invalid_argument&) {
    throw UsageError(without_bounds("--keep"));
  }
}

/// The sets of owners whose faces are in a result.
std::set<Owners> owners_in(const Overlay& overlay, ResultId result) {
  std::set<Owners> kept;
  for (std::size_t i = 1; i < overlay.cover_bound(); ++i) {
    const overlay::CoverId cover(static_cast<std::uint32_t>(i));
    const auto triangles = overlay.triangles(cover);
    if (triangles.empty() || !overlay.is_in(result, triangles.front())) continue;
    const auto layers = overlay.layers(cover);
    kept.emplace(layers.begin(), layers.end());
  }
  return kept;
}

/// All faces by their owners. Neighbours have the same vertices along their border.
Pieces pieces_of(const Overlay& overlay) {
  Pieces pieces;
  for (overlay::Face& face : overlay::faces(overlay, overlay::Vertices::all))
    pieces[face.layers].push_back(std::move(face.polygon));
  return pieces;
}

std::vector<ExactArea> areas_of_layers(const Overlay& overlay, const Pieces& pieces) {
  std::vector<ExactArea> areas(overlay.layer_count());
  for (const auto& [owners, polygons] : pieces) {
    const ExactArea all = area(polygons);
    for (const LayerId owner : owners) areas[owner.index()] += all;
  }
  return areas;
}

/// A feature with a property, as JSON text, and the area.
io::Feature feature_of(MultiPolygon polygons, const std::string& key, const std::string& value) {
  const double size = area(polygons).to_double();
  return {.polygons = std::move(polygons),
          .properties = "{\"" + key + "\":" + value + ",\"area\":" + exact(size) + '}'};
}

std::vector<io::Feature> features_of(const Overlay& overlay, const std::optional<Kept>& kept,
                                     Pieces pieces) {
  std::set<Owners> wanted;
  if (kept) wanted = owners_in(overlay, kept->id);
  std::vector<io::Feature> features;
  for (auto& [owners, polygons] : pieces)
    if (!kept || wanted.contains(owners))
      features.push_back(feature_of(std::move(polygons), "layers", json_list(overlay, owners)));
  return features;
}

io::Feature feature_of(const Overlay& overlay, const Kept& kept) {
  std::string expression;
  io::append_json_string(expression, kept.expression);
  return feature_of(overlay.polygons(kept.id), "expression", expression);
}

void count_polygons(OverlayReport& report, std::span<const io::Feature> features) {
  for (const io::Feature& feature : features) {
    report.polygons += feature.polygons.size();
    for (const overlay::Polygon& polygon : feature.polygons) report.holes += polygon.holes.size();
  }
}

void print_areas(const Overlay& overlay, const OverlayReport& report,
                 const std::optional<Kept>& kept) {
  std::vector<std::vector<std::string>> rows{{"layer", "area"}};
  for (std::size_t i = 0; i < report.layers.size(); ++i)
    rows.push_back({io::one_line(overlay.name(LayerId(static_cast<std::uint32_t>(i)))),
                    exact(report.layers[i].to_double())});
  if (kept) rows.push_back({io::one_line(kept->expression), exact(report.kept->to_double())});
  for (const std::string& line : aligned(rows)) std::cout << line << '\n';
}

/// What `loft overlay --json` prints: schema "loft-overlay", schema_version 1, loft (version),
/// inputs, outputs; layers, {"name", "rings", "area"} each; expression and area where one was
/// given; polygons and holes that are written; area_error_bound, how far each area may be from that
/// of the outlines as they were given; snaps; seconds of each stage (read, overlay, trace, write,
/// total). Later versions of the schema may add keys.
std::string to_json(const OverlayCommand& command, const Overlay& overlay,
                    const OverlayReport& report, const std::optional<Kept>& kept) {
  Json json = begin_report("loft-overlay", 1, command.inputs, command.outputs);
  json["layers"] = Json::array();
  for (std::size_t i = 0; i < report.layers.size(); ++i) {
    const LayerId layer(static_cast<std::uint32_t>(i));
    json["layers"].push_back({{"name", overlay.name(layer)},
                              {"rings", overlay.rings(layer).size()},
                              {"area", report.layers[i].to_double()}});
  }
  if (kept) {
    json["expression"] = kept->expression;
    json["area"] = report.kept->to_double();
  }
  json["polygons"] = report.polygons;
  json["holes"] = report.holes;
  json["area_error_bound"] = overlay.area_error_bound();
  json["snaps"] = overlay.triangulation().snaps().size();
  json["seconds"] = report.seconds;
  return print(json);
}

}  // namespace

ExitCode run(const OverlayCommand& command) {
  Terminal terminal(command.quiet);
  OverlayReport report;
  Stopwatch total;
  Stopwatch stopwatch;
  check_overlay(command);
  if (!command.layer_by) static_cast<void>(layer_names(command.inputs));

  const std::vector<io::Map> maps = io::read_maps(command.inputs);
  io::Map result{.features = {}, .crs = common_crs(maps, command.inputs)};
  const LayerNames names = names_of_layers(command, maps);
  report.seconds["read"] = stopwatch.lap();

  Overlay overlay = overlay_of(maps, names, command.fill);
  std::optional<Kept> kept;
  if (command.keep) kept = keep(overlay, io::json_text(*command.keep));
  report.seconds["overlay"] = stopwatch.lap();

  Pieces pieces;
  if (command.all_pieces || command.areas || command.json) pieces = pieces_of(overlay);
  report.layers = areas_of_layers(overlay, pieces);
  if (kept) report.kept = overlay.area(kept->id);
  if (command.all_pieces)
    result.features = features_of(overlay, kept, std::move(pieces));
  else if (kept)
    result.features.push_back(feature_of(overlay, *kept));
  count_polygons(report, result.features);
  report.seconds["trace"] = stopwatch.lap();

  for (const auto& output : command.outputs) io::write(output, result, command.drawing);
  report.seconds["write"] = stopwatch.lap();
  report.seconds["total"] = total.lap();

  terminal.say(counted(overlay.layer_count(), "layer") + ": " +
               counted(report.polygons, "polygon") + " with " + counted(report.holes, "hole") +
               " in " + counted(result.features.size(), "feature"));
  if (const auto note = note_on_lines(maps)) terminal.say(*note);
  say_notes(terminal, overlay, command.outputs);
  if (command.json)
    std::cout << to_json(command, overlay, report, kept) << '\n';
  else if (command.areas)
    print_areas(overlay, report, kept);
  return ExitCode::ok;
}

}  // namespace loft::app
