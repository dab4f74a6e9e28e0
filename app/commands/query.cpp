// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/map_layers.h"
#include "app/commands/map_outputs.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "io/bytes/csv_field.h"
#include "io/bytes/file.h"
#include "io/bytes/json_reader.h"
#include "io/maps.h"
#include "io/points.h"
#include "overlay/cut.h"
#include "reconstruct/number_text.h"

namespace loft::app {

using std::filesystem::path;

namespace {

using overlay::Cover;
using overlay::LinePiece;
using overlay::Overlay;

/// What the points or lines are in.
const path& asked_file(const QueryCommand& command) {
  return command.points ? *command.points : *command.lines;
}

void check_query(const QueryCommand& command) {
  if (!command.points && !command.lines) throw UsageError("loft query needs --points or --lines");
  const std::array inputs{command.map, asked_file(command)};
  if (inputs[0] == "-" && inputs[1] == "-")
    throw UsageError("loft query can read one file from standard input, not two");
  forbid_overwriting(inputs, command.outputs);
  for (const path& output : command.outputs) {
    if (command.points && !is_table(output)) throw io::UnknownFormat(output, ".csv");
    check_table_or_map(output);
  }
}

/// The cells of a row that say where something is.
std::string cover_cells(const Overlay& overlay, const Cover& cover) {
  return io::csv_field(joined_names(overlay, cover.inside)) + ',' +
         io::csv_field(joined_names(overlay, cover.on_border_of));
}

/// What is answered.
struct MapAnswer {
  std::string table = {};  ///< as CSV
  io::Map pieces = {};     ///< of lines
  std::string words = {};  ///< a summary
  Json report = {};        ///< what is added to the report
};

MapAnswer ask_points(const Overlay& overlay, std::span<const cdt::Point> points) {
  MapAnswer answer{.table = "x,y,inside,on_border\r\n"};
  std::size_t inside = 0;
  std::size_t on_border = 0;
  for (const cdt::Point& point : points) {
    const Cover cover = overlay.cover(point);
    inside += cover.inside.empty() ? 0U : 1U;
    on_border += cover.on_border_of.empty() ? 0U : 1U;
    append_number(answer.table, point.x);
    answer.table += ',';
    append_number(answer.table, point.y);
    answer.table += ',' + cover_cells(overlay, cover) + "\r\n";
  }
  answer.words = counted(points.size(), "point") + ": " + grouped(inside) + " inside, " +
                 grouped(on_border) + " on a border";
  answer.report = {{"points", points.size()}, {"inside", inside}, {"on_border", on_border}};
  return answer;
}

/// A feature's lines, in an overlay.
struct AskedLine {
  std::string name;
  std::vector<overlay::RingId> ids = {};
};

std::vector<AskedLine> insert_lines(Overlay& overlay, const io::Map& map, const path& file) {
  const overlay::LayerId layer = overlay.add_layer("lines");
  std::vector<AskedLine> lines;
  std::vector<overlay::Shape> shapes;
  const LayerNames names = by_feature({&map, 1}, {&file, 1}, {});
  for (std::size_t i = 0; i < map.features.size(); ++i) {
    for (const auto& line : map.features[i].lines)
      shapes.push_back({.layer = layer, .points = line, .ends = overlay::open});
    lines.push_back({.name = names.front()[i]});
  }
  const std::vector<overlay::RingId> ids = overlay.insert(shapes);
  auto next = ids.begin();
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t count = map.features[i].lines.size(); count > 0; --count)
      lines[i].ids.push_back(*next++);
  return lines;
}

void append_rows(std::string& table, const Overlay& overlay, const std::string& line,
                 std::span<const LinePiece> pieces) {
  for (const auto& [cover, length] : lengths(pieces)) {
    table += io::csv_field(line) + ',' + cover_cells(overlay, cover) + ',';
    append_number(table, length);
    table += "\r\n";
  }
}

io::Feature feature_of(const Overlay& overlay, const std::string& line, const LinePiece& piece) {
  std::string properties = "{\"line\":";
  io::append_json_string(properties, line);
  properties += ",\"inside\":" + json_list(overlay, piece.cover.inside) +
                ",\"on_border\":" + json_list(overlay, piece.cover.on_border_of) +
                ",\"length\":" + exact(piece.length) + '}';
  return {.lines = {piece.points}, .properties = std::move(properties)};
}

/// Lengths by cover: {"inside": [...], "on_border": [...], "length": ...} each.
Json length_report(const Overlay& overlay, std::span<const LinePiece> pieces) {
  Json report = Json::array();
  for (const auto& [cover, length] : lengths(pieces))
    report.push_back({{"inside", names_as_json(overlay, cover.inside)},
                      {"on_border", names_as_json(overlay, cover.on_border_of)},
                      {"length", length}});
  return report;
}

MapAnswer ask_lines(const Overlay& overlay, std::span<const AskedLine> lines) {
  MapAnswer answer{.table = "line,inside,on_border,length\r\n"};
  std::vector<LinePiece> all;
  std::size_t count = 0;
  for (const AskedLine& line : lines) {
    count += line.ids.size();
    const std::size_t before = all.size();
    for (const overlay::RingId id : line.ids)
      std::ranges::move(pieces(overlay, id), std::back_inserter(all));
    const std::span<const LinePiece> own = std::span(all).subspan(before);
    append_rows(answer.table, overlay, line.name, own);
    for (const LinePiece& piece : own)
      answer.pieces.features.push_back(feature_of(overlay, line.name, piece));
  }
  answer.words = counted(count, "line") + " in " + counted(all.size(), "piece");
  answer.report = {
      {"lines", count}, {"pieces", all.size()}, {"lengths", length_report(overlay, all)}};
  return answer;
}

/// The pieces over the map that they are in.
io::Map picture_of(io::Map map, const io::Map& pieces) {
  map.features.insert(map.features.end(), pieces.features.begin(), pieces.features.end());
  return map;
}

void write_answer(const QueryCommand& command, const io::Map& map, const MapAnswer& answer) {
  for (const path& output : command.outputs) {
    if (is_table(output))
      write_table(output, answer.table);
    else if (io::extension(output) == ".svg")
      io::write(output, picture_of(map, answer.pieces), command.drawing);
    else
      io::write(output, answer.pieces, command.drawing);
  }
  if (command.outputs.empty() && !command.json) std::cout << answer.table;
}

/// What `loft query --json` prints: schema "loft-query", schema_version 1, loft (version), inputs,
/// outputs, layers (a number); points, inside, on_border: how many there are; or lines, pieces, and
/// lengths, {"inside", "on_border", "length"} each; seconds of each stage (read, overlay, ask,
/// write, total). Later versions of the schema may add keys.
std::string to_json(const QueryCommand& command, std::size_t layers, const Json& answer,
                    const std::map<std::string, double>& seconds) {
  const std::array inputs{command.map, asked_file(command)};
  Json json = begin_report("loft-query", 1, inputs, command.outputs);
  json["layers"] = layers;
  json.update(answer);
  json["seconds"] = seconds;
  return print(json);
}

/// Polygons and points are no lines.
std::optional<std::string> note_on_areas(const io::Map& map) {
  std::size_t polygons = 0;
  std::size_t points = 0;
  for (const io::Feature& feature : map.features) {
    polygons += feature.polygons.size();
    points += feature.points.size();
  }
  if (polygons + points == 0) return {};
  return "left out " + counted(polygons, "polygon") + " and " + counted(points, "point") +
         " among the lines";
}

}  // namespace

ExitCode run(const QueryCommand& command) {
  Terminal terminal(command.quiet);
  std::map<std::string, double> seconds;
  Stopwatch total;
  Stopwatch stopwatch;
  check_query(command);

  const std::array maps{io::read_map(command.map)};
  std::vector<cdt::Point> points;
  io::Map lines;
  if (command.points)
    points = io::read_points(*command.points);
  else
    lines = io::read_map(*command.lines);
  const LayerNames names = by_feature(maps, {&command.map, 1}, command.layer_by);
  seconds["read"] = stopwatch.lap();

  Overlay overlay = overlay_of(maps, names);
  const std::size_t layers = overlay.layer_count();
  std::vector<AskedLine> asked;
  if (command.lines) asked = insert_lines(overlay, lines, *command.lines);
  seconds["overlay"] = stopwatch.lap();

  MapAnswer answer = command.points ? ask_points(overlay, points) : ask_lines(overlay, asked);
  answer.pieces.crs = maps.front().crs;
  seconds["ask"] = stopwatch.lap();

  write_answer(command, maps.front(), answer);
  seconds["write"] = stopwatch.lap();
  seconds["total"] = total.lap();

  terminal.say(counted(layers, "layer") + "; " + answer.words);
  if (const auto note = note_on_lines(maps)) terminal.say(*note);
  if (const auto note = note_on_areas(lines)) terminal.say(*note);
  say_notes(terminal, overlay, command.outputs);
  if (command.json) std::cout << to_json(command, layers, answer.report, seconds) << '\n';
  return ExitCode::ok;
}

}  // namespace loft::app
