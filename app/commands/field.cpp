// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/field_tables.h"
#include "app/commands/map_layers.h"
#include "app/commands/map_outputs.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "cdt/each_once.h"
#include "cdt/queries.h"
#include "fields/volume.h"
#include "io/bytes/file.h"
#include "io/bytes/problems.h"
#include "io/fields.h"
#include "io/maps.h"
#include "io/tables.h"
#include "reconstruct/number_text.h"

namespace loft::app {

using std::filesystem::path;

namespace {

using fields::Field;

/// More than that are a mistake, and no picture that anyone looks at.
constexpr double most_cells = 1e8;
constexpr std::size_t usual_pixels = 1000;  // across a picture
constexpr std::size_t usual_levels = 20;
constexpr std::size_t most_levels = 100'000;

/// What the lines and places are read from, and the samples.
std::vector<path> inputs_of(const FieldCommand& command) {
  std::vector<path> inputs{command.samples};
  for (const auto& file : {command.lines, command.at, command.profile})
    if (file) inputs.push_back(*file);
  return inputs;
}

bool is_map(const path& output) {
  const std::string extension = io::extension(output);
  return extension == ".geojson" || extension == ".json";
}

bool has_levels(const FieldCommand& command) {
  return command.isolines || !command.levels.empty() || command.bands;
}

/// What a table or map is of must be one thing.
void check_contents(const FieldCommand& command, const path& output) {
  const int tables = (command.at ? 1 : 0) + (command.profile ? 1 : 0);
  const int maps = tables + (has_levels(command) ? 1 : 0);
  if (is_table(output) && tables != 1)
    throw UsageError(output.string() + ": a table is of --at or of --profile");
  if (is_map(output) && maps != 1)
    throw UsageError(output.string() + ": a map is of --at, of --profile, or of --isolines");
  if (io::extension(output) == ".asc" && !command.grid && !command.cell)
    throw UsageError(output.string() + ": a grid needs --grid or --cell");
}

void check_field(const FieldCommand& command) {
  const std::vector<path> inputs = inputs_of(command);
  if (std::ranges::count(inputs, path("-")) > 1)
    throw UsageError("loft field can read one file from standard input, not several");
  forbid_overwriting(inputs, command.outputs);
  for (const path& output : command.outputs) {
    check_contents(command, output);
    if (is_table(output) || is_map(output))
      check_table_or_map(output);
    else
      io::check_writable_field(output);
  }
}

/// What the files hold.
struct FieldInputs {
  std::vector<fields::Sample> samples;
  std::vector<io::FieldLine> lines;
  io::PointTable places;
  io::Map profile;
};

/// Throws InputError with the problems of all.
FieldInputs read_all(const FieldCommand& command) {
  FieldInputs inputs;
  const io::WantedColumn usual{{"value", "z", "height", "elevation"}, true};
  const std::array wanted{command.value ? io::WantedColumn{{*command.value}} : usual};
  const auto read_samples = [&] {
    const io::PointTable table = io::read_point_table(command.samples, wanted);
    for (std::size_t row = 0; row < table.points().size(); ++row)
      inputs.samples.push_back({table.points()[row], table.values().front()->values[row]});
  };
  const std::array<std::function<void()>, 4> reads{
      read_samples,
      [&] {
        if (command.lines) inputs.lines = io::read_field_lines(*command.lines);
      },
      [&] {
        if (command.at) inputs.places = io::read_point_table(*command.at);
      },
      [&] {
        if (command.profile) inputs.profile = io::read_map(*command.profile);
      }};
  io::gather_problems(reads, [](const auto& read) { read(); });
  return inputs;
}

/// Throws InputError that lists lines that are none.
Field field_of(const FieldCommand& command, const FieldInputs& inputs) {
  // Conflicts are all listed, and refused then.
  Field field(command.on_conflict == fields::OnConflict::refuse ? fields::OnConflict::mean
                                                                : command.on_conflict);
  io::Problems problems;
  for (const fields::Sample& sample : inputs.samples)
    if (!Field::is_usable(sample.value))
      problems.add(shown_name(command.samples) + ": at " + exact(sample.place.x) + ", " +
                   exact(sample.place.y) + ": a value beyond 1e150");
  if (problems.is_empty()) (void)field.insert(inputs.samples);
  for (const io::FieldLine& line : inputs.lines) {
    try {
      (void)field.insert(line.view());
    } catch (const std::invalid_argument& error) {
      problems.add(line.place + error.what());
    }
  }
  problems.raise(shown_name(command.samples));
  return field;
}

std::string words_of(const fields::Conflict& conflict) {
  return "at " + exact(conflict.place.x) + ", " + exact(conflict.place.y) + ": values " +
         exact(conflict.claims.front().value) + " to " + exact(conflict.claims.back().value);
}

void refuse_conflicts(std::span<const fields::Conflict> conflicts) {
  io::Problems problems;
  for (const fields::Conflict& conflict : conflicts)
    problems.add(words_of(conflict) + " at one place; --on-conflict mean or first takes one");
  problems.raise("conflicts");
}

/// The least and the largest value that was given.
struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

Range range_of(const FieldInputs& inputs) {
  Range range;
  for (const fields::Sample& sample : inputs.samples) range.add(sample.value);
  for (const io::FieldLine& line : inputs.lines)
    for (const std::vector<double>* values : {&line.values, &line.left, &line.right})
      for (const double value : *values) range.add(value);
  return range;
}

/// About so many levels at round numbers: 1, 2 or 5 times a power of ten apart.
std::vector<double> round_levels(const Range& range, std::size_t count) {
  std::vector<double> levels;
  const double gap = (range.most / 2 - range.least / 2) / static_cast<double>(count) * 2;
  if (!(gap > 0) || !std::isfinite(gap)) return levels;
  const double power = std::pow(10, std::floor(std::log10(gap)));
  double step = power;
  for (const double times : {2.0, 5.0, 10.0})
    if (std::abs(std::log(times * power / gap)) < std::abs(std::log(step / gap)))
      step = times * power;
  // As multiples, so that they are as round as they can be; so large that they run together, fewer.
  const double first = std::floor(range.least / step) + 1;
  for (std::size_t i = 0; i < 4 * count; ++i) {
    const double level = (first + static_cast<double>(i)) * step;
    if (!(level < range.most)) break;
    if (levels.empty() || level > levels.back()) levels.push_back(level);
  }
  return levels;
}

std::vector<double> levels_of(const FieldCommand& command, const Range& range) {
  if (command.levels.empty()) return round_levels(range, command.isolines.value_or(usual_levels));
  std::vector<double> levels = command.levels;
  cdt::keep_each_once(levels);
  return levels;
}

/// Square cells over all there is, the first at the top left.
fields::Grid grid_over(const FieldCommand& command, const Field& field) {
  const cdt::Box box = cdt::bounding_box(field.mesh());
  const double width = box.high.x - box.low.x;
  const double height = box.high.y - box.low.y;
  const GridSize size = command.grid.value_or(GridSize{usual_pixels, usual_pixels});
  const double cell = command.cell ? *command.cell
                                   : std::max({width / static_cast<double>(size.columns),
                                               height / static_cast<double>(size.rows),
                                               cdt::Triangulation::smallest_coordinate});
  const double columns = std::max(1.0, std::ceil(width / cell * (1 - 1e-12)));
  const double rows = std::max(1.0, std::ceil(height / cell * (1 - 1e-12)));
  if (!(columns * rows <= most_cells))
    throw UsageError("a grid of " + exact(columns) + " times " + exact(rows) +
                     " cells; at most 100 million: take a larger --cell");
  return {.first = {box.low.x + cell / 2, box.high.y - cell / 2},
          .step_x = cell,
          .step_y = -cell,
          .columns = static_cast<std::size_t>(columns),
          .rows = static_cast<std::size_t>(rows)};
}

/// What is asked of the field, as tables and maps.
FieldAnswer answer_of(const FieldCommand& command, const Field& field, const FieldInputs& inputs,
                      std::span<const double> levels) {
  const FieldView view{field, command.smoothness, command.outside};
  if (command.at) return values_at(view, inputs.places);
  if (command.profile) return profiles_along(view, inputs.profile, *command.profile);
  if (has_levels(command))
    return command.bands ? bands_between(view, levels) : isolines_at(view, levels);
  return {};
}

void write_all(const FieldCommand& command, const Field& field, const FieldAnswer& answer,
               std::vector<double> levels) {
  io::FieldOutput output{
      .picture = {.field = &field, .levels = std::move(levels), .has_triangles = command.triangles},
      .smoothness = command.smoothness,
      .width = command.drawing.width};
  if (std::ranges::any_of(command.outputs, io::needs_grid)) output.grid = grid_over(command, field);
  for (const path& file : command.outputs) {
    if (is_table(file))
      write_table(file, answer.table);
    else if (is_map(file))
      io::write(file, answer.map);
    else
      io::write(file, output);
  }
  if (command.outputs.empty() && !command.json) std::cout << answer.table;
}

Json json_of(const fields::Conflict& conflict) {
  Json values = Json::array();
  for (const fields::Claim& claim : conflict.claims) values.push_back(claim.value);
  return {{"x", conflict.place.x},
          {"y", conflict.place.y},
          {"values", values},
          {"taken", conflict.taken}};
}

/// What `loft field --json` prints: schema "loft-field", schema_version 1, loft (version), inputs,
/// outputs; samples, lines (numbers), least, most (of the values given; null if there are none),
/// conflicts, {"x", "y", "values", "taken"} each; area, in the plane; with --level volume,
/// {"level", "above", "below", "area_above", "area_below"}; what --at, --profile and --isolines
/// add: points, without_value; profiles, climb, descent; levels, isolines or bands; seconds of each
/// stage (read, build, ask, write, total). Later versions of the schema may add keys.
Json report_of(const FieldCommand& command, const FieldInputs& inputs, const Field& field,
               const Range& range) {
  Json json;
  json["samples"] = inputs.samples.size();
  json["lines"] = inputs.lines.size();
  const bool has_values = range.least <= range.most;
  json["least"] = has_values ? Json(range.least) : Json();
  json["most"] = has_values ? Json(range.most) : Json();
  json["conflicts"] = Json::array();
  for (const fields::Conflict& conflict : field.conflicts())
    json["conflicts"].push_back(json_of(conflict));
  const fields::Volume volume = fields::volume(field, command.level.value_or(0));
  json["area"] = volume.area();
  if (command.level)
    json["volume"] = {{"level", *command.level},
                      {"above", volume.above},
                      {"below", volume.below},
                      {"area_above", volume.area_above},
                      {"area_below", volume.area_below}};
  return json;
}

void say_conflicts(Terminal& terminal, std::span<const fields::Conflict> conflicts) {
  if (conflicts.empty()) return;
  terminal.say(counted(conflicts.size(), "conflict") + " of values at one place, the first " +
               words_of(conflicts.front()) + ", " + exact(conflicts.front().taken) + " taken");
}

}  // namespace

ExitCode run(const FieldCommand& command) {
  Terminal terminal(command.quiet);
  std::map<std::string, double> seconds;
  Stopwatch total;
  Stopwatch stopwatch;
  check_field(command);

  const FieldInputs inputs = read_all(command);
  const Range range = range_of(inputs);
  std::vector<double> levels = levels_of(command, range);
  if (levels.size() > most_levels)
    throw UsageError(grouped(levels.size()) + " levels; at most " + grouped(most_levels));
  seconds["read"] = stopwatch.lap();

  const Field field = field_of(command, inputs);
  const std::vector<fields::Conflict> conflicts = field.conflicts();
  if (command.on_conflict == fields::OnConflict::refuse) refuse_conflicts(conflicts);
  seconds["build"] = stopwatch.lap();

  FieldAnswer answer = answer_of(command, field, inputs, levels);
  answer.map.crs = inputs.profile.crs;
  Json report = report_of(command, inputs, field, range);
  report.update(answer.report);
  seconds["ask"] = stopwatch.lap();

  write_all(command, field, answer, std::move(levels));
  seconds["write"] = stopwatch.lap();
  seconds["total"] = total.lap();

  terminal.say(counted(inputs.samples.size(), "sample") + ", " +
               counted(inputs.lines.size(), "line") + "; values from " + exact(range.least) +
               " to " + exact(range.most) + answer.words);
  if (command.level)
    terminal.say("over " + exact(*command.level) + ": " + exact(report["volume"]["above"]) +
                 ", under it: " + exact(report["volume"]["below"]));
  say_conflicts(terminal, conflicts);
  for (const path& output : command.outputs) terminal.say("wrote " + output.string());
  if (command.json) {
    Json json = begin_report("loft-field", 1, inputs_of(command), command.outputs);
    json.update(report);
    json["seconds"] = seconds;
    std::cout << print(json) << '\n';
  }
  return ExitCode::ok;
}

}  // namespace loft::app
