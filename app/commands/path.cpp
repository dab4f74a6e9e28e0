// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/map_layers.h"
#include "app/commands/map_outputs.h"
#include "app/commands/path_outputs.h"
#include "app/commands/path_scene.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "io/bytes/file.h"
#include "io/bytes/problems.h"
#include "io/bytes/utf8.h"
#include "io/maps.h"
#include "io/scenes.h"
#include "paths/shortest.h"

namespace loft::app {

using std::filesystem::path;

namespace {

/// The scene, the queries, the edits, as far as they are files.
std::vector<path> inputs_of(const PathCommand& command) {
  std::vector<path> inputs{command.scene};
  if (command.queries) inputs.push_back(*command.queries);
  if (command.moves) inputs.push_back(*command.moves);
  return inputs;
}

void check_path(const PathCommand& command) {
  const bool has_ends = command.from && command.to;
  if (!has_ends && !command.queries)
    throw UsageError("loft path needs --from and --to, or --queries");
  const std::vector<path> inputs = inputs_of(command);
  if (std::ranges::count(inputs, path("-")) > 1)
    throw UsageError("loft path can read one file from standard input, not several");
  forbid_overwriting(inputs, command.outputs);
  for (const path& output : command.outputs) check_table_or_map(output);
}

/// What is asked for, in order.
std::vector<paths::Query> queries_of(const PathCommand& command) {
  std::vector<io::PathQuery> asked;
  if (command.queries)
    asked = io::read_path_queries(*command.queries);
  else
    asked.push_back({*command.from, *command.to});
  std::vector<paths::Query> queries;
  for (const io::PathQuery& one : asked)
    queries.push_back({.from = one.from,
                       .to = one.to,
                       .radius = one.radius.value_or(command.radius),
                       .most_expansions = command.most_expansions});
  return queries;
}

/// What the files hold.
struct PathInputs {
  io::Scene scene;
  std::vector<paths::Query> queries;
  std::vector<io::SceneEdit> edits;
};

/// Throws InputError with the problems of all of them.
PathInputs read_all(const PathCommand& command) {
  PathInputs inputs;
  const std::array<std::function<void()>, 3> reads{
      [&] { inputs.scene = io::read_scene(command.scene); },
      [&] { inputs.queries = queries_of(command); },
      [&] {
        if (command.moves) inputs.edits = io::read_scene_edits(*command.moves);
      }};
  io::gather_problems(reads, [](const auto& read) { read(); });
  return inputs;
}

SceneRules rules_of(const PathCommand& command, const std::vector<paths::Query>& queries) {
  SceneRules rules{.file = shown_name(command.scene), .layer_by = command.layer_by};
  if (command.free) rules.free = io::json_text(*command.free);
  for (const paths::Query& query : queries) {
    rules.ends.push_back(query.from);
    rules.ends.push_back(query.to);
    rules.largest_radius = std::max(rules.largest_radius, query.radius);
  }
  return rules;
}

/// The paths as the scene is, and after each edit.
std::vector<FoundPath> find_paths(PathScene& scene, const std::vector<io::SceneEdit>& edits,
                                  const std::vector<paths::Query>& queries) {
  std::vector<FoundPath> found;
  paths::Workspace workspace;
  for (std::size_t edit = 0; edit <= edits.size(); ++edit) {
    if (edit > 0) scene.apply(edits[edit - 1]);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      FoundPath& one = found.emplace_back(FoundPath{.query = i, .edit = edit, .asked = queries[i]});
      workspace.find(scene.space(), queries[i], one.path);
      one.expansions = workspace.expansions();
    }
  }
  return found;
}

void write_paths(const PathCommand& command, const io::Scene& scene, PathScene& planned,
                 const std::vector<FoundPath>& found) {
  for (const path& output : command.outputs) {
    if (is_table(output)) {
      write_table(output, table_of(found));
    } else if (io::extension(output) == ".svg") {
      io::PathPicture picture = planned.picture();
      picture.upwards = scene.upwards;
      draw(picture, found);
      io::write(output, picture, command.drawing.width);
    } else {
      io::Map map = map_of(found);
      map.crs = scene.map.crs;
      io::write(output, map);
    }
  }
  if (command.outputs.empty() && !command.json) std::cout << table_of(found);
}

/// What `loft path --json` prints: schema "loft-path", schema_version 1, loft (version), inputs,
/// outputs; layers, queries, edits (numbers); statuses, how many paths have each; expansions, the
/// steps of all searches; paths, {"query", "edit", "status", "radius", "length", "expansions"}
/// each, length null where there is none; snaps; seconds of each stage (read, overlay, find, write,
/// total). Later versions of the schema may add keys.
std::string to_json(const PathCommand& command, const PathScene& scene, std::size_t queries,
                    const std::vector<FoundPath>& found,
                    const std::map<std::string, double>& seconds) {
  std::size_t expansions = 0;
  for (const FoundPath& one : found) expansions += one.expansions;
  Json json = begin_report("loft-path", 1, inputs_of(command), command.outputs);
  json["layers"] = scene.overlay().layer_count();
  json["queries"] = queries;
  json["edits"] = found.back().edit;
  json["statuses"] = count_by_status(found);
  json["expansions"] = expansions;
  json["paths"] = report_of(found);
  json["snaps"] = scene.overlay().triangulation().snaps().size();
  json["seconds"] = seconds;
  return print(json);
}

/// `3 paths: 2 found, 1 unreachable`
std::string summary(const std::vector<FoundPath>& found) {
  std::string words = counted(found.size(), "path") + ':';
  const Json counts = count_by_status(found);
  const char* between = " ";
  for (const auto& [status, count] : counts.items()) {
    words += between + grouped(count.get<std::size_t>()) + ' ' + status;
    between = ", ";
  }
  return words;
}

/// Points are neither in the way nor free.
std::optional<std::string> note_on_points(const io::Map& map) {
  std::size_t points = 0;
  for (const io::Feature& feature : map.features) points += feature.points.size();
  if (points == 0) return {};
  return "left out " + counted(points, "point") + " of the scene";
}

}  // namespace

ExitCode run(const PathCommand& command) {
  Terminal terminal(command.quiet);
  std::map<std::string, double> seconds;
  Stopwatch total;
  Stopwatch stopwatch;
  check_path(command);

  const auto [scene, queries, edits] = read_all(command);
  seconds["read"] = stopwatch.lap();

  PathScene planned(scene.map, rules_of(command, queries));
  if (command.moves) planned.check(edits, shown_name(*command.moves));
  seconds["overlay"] = stopwatch.lap();

  const std::vector<FoundPath> found = find_paths(planned, edits, queries);
  seconds["find"] = stopwatch.lap();

  write_paths(command, scene, planned, found);
  seconds["write"] = stopwatch.lap();
  seconds["total"] = total.lap();

  terminal.say(summary(found));
  if (const auto note = note_on_points(scene.map)) terminal.say(*note);
  say_notes(terminal, planned.overlay(), command.outputs);
  if (command.json) std::cout << to_json(command, planned, queries.size(), found, seconds) << '\n';
  const bool is_failure = !command.queries && found.back().path.status != paths::Status::found;
  return is_failure ? ExitCode::check_failed : ExitCode::ok;
}

}  // namespace loft::app
