// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/map_layers.h"
#include "app/commands/map_outputs.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/stopwatch.h"
#include "app/table.h"
#include "app/terminal.h"
#include "fields/classes.h"
#include "io/bytes/atomic_file.h"
#include "io/bytes/csv_field.h"
#include "io/bytes/file.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/maps.h"
#include "io/planar/classes_svg.h"
#include "io/tables.h"
#include "reconstruct/number_text.h"

namespace loft::app {

using std::filesystem::path;

namespace {

using fields::Classes;
using fields::Sign;

void check_classify(const ClassifyCommand& command) {
  const std::array inputs{command.points, command.separators};
  if (inputs[0] == "-" && inputs[1] == "-")
    throw UsageError("loft classify can read one file from standard input, not two");
  forbid_overwriting(inputs, command.outputs);
  for (const path& output : command.outputs) check_table_or_map(output);
}

struct NamedSeparator {
  std::string name;
  fields::Separator line;
};

/// What the files hold.
struct ClassifyInputs {
  io::PointTable table;
  std::vector<NamedSeparator> separators;
  std::string crs;
  std::size_t left_out = 0;  ///< polygons and points among the separators
};

/// A name that none has yet: `East`, `East (2)`.
std::string own_name(std::set<std::string>& taken, const std::string& name) {
  std::string own = name;
  for (int i = 2; !taken.insert(own).second; ++i) own = name + " (" + std::to_string(i) + ')';
  return own;
}

/// Throws InputError that lists the lines that divide nothing.
void take_separators(const path& file, const io::Map& map, ClassifyInputs& inputs) {
  const LayerNames names = by_feature({&map, 1}, {&file, 1}, {});
  io::Problems problems;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < map.features.size(); ++i) {
    const io::Feature& feature = map.features[i];
    inputs.left_out += feature.polygons.size() + feature.points.size();
    for (const auto& line : feature.lines) {
      const std::string name = own_name(taken, names.front()[i]);
      try {
        inputs.separators.push_back({name, fields::Separator(line)});
      } catch (const std::invalid_argument& error) {
        problems.add(shown_name(file) + ": " + io::in_quotes(name) + ": " + error.what());
      }
    }
  }
  problems.raise(shown_name(file));
  if (inputs.separators.empty())
    throw InputError(shown_name(file) + ": no line in it; a separator is a LineString");
  inputs.crs = map.crs;
}

/// Throws InputError with the problems of both.
ClassifyInputs read_all(const ClassifyCommand& command) {
  ClassifyInputs inputs;
  const io::WantedColumn usual{{"value", "z", "weight"}, false};
  const std::array wanted{command.value ? io::WantedColumn{{*command.value}} : usual};
  const std::array<std::function<void()>, 2> reads{
      [&] { inputs.table = io::read_point_table(command.points, wanted); },
      [&] { take_separators(command.separators, io::read_map(command.separators), inputs); }};
  io::gather_problems(reads, [](const auto& read) { read(); });
  return inputs;
}

/// The points in classes, in the order of the table.
struct Classified {
  Classes classes;
  std::vector<fields::PointId> ids;
};

Classified classify(const ClassifyInputs& inputs) {
  Classified result;
  for (const NamedSeparator& one : inputs.separators)
    result.classes.insert_separator(one.line.points());
  result.ids = result.classes.insert(inputs.table.points());
  return result;
}

constexpr const char* word_of(Sign sign) {
  if (sign == Sign::on) return "on";
  return sign == Sign::left ? "left" : "right";
}

/// `left;right;on`
std::string name_of_class(std::span<const Sign> signs) {
  std::string name;
  for (const Sign sign : signs) name += (name.empty() ? "" : ";") + std::string(word_of(sign));
  return name;
}

std::string joined(const std::vector<NamedSeparator>& separators) {
  std::string names;
  for (const NamedSeparator& one : separators) names += (names.empty() ? "" : ";") + one.name;
  return names;
}

/// The rows as they were, with the class behind.
std::string table_with_classes(const ClassifyInputs& inputs, const Classified& classified) {
  const io::PointTable& table = inputs.table;
  std::string text;
  for (const std::string& name : table.names()) text += io::csv_field(name) + ',';
  text += "class\r\n";
  for (std::size_t row = 0; row < classified.ids.size(); ++row) {
    for (std::size_t i = 0; i < table.names().size(); ++i)
      text += io::csv_field(table.cell(row, i)) + ',';
    text += name_of_class(classified.classes.signs(classified.ids[row])) + "\r\n";
  }
  return text;
}

/// What belongs to a point but for its place: cells, as text unless they are values, and the class.
std::string properties_of(const ClassifyInputs& inputs, std::size_t row, const std::string& name) {
  const io::PointTable& table = inputs.table;
  const auto& values = table.values().front();
  std::string text = "{";
  std::set<std::string> taken{"class"};
  for (std::size_t i = 0; i < table.names().size(); ++i) {
    const std::string key = io::json_text(table.names()[i]);
    if (i == table.x_column() || i == table.y_column() || !taken.insert(key).second) continue;
    io::append_json_string(text, key);
    text += ':';
    if (values && i == values->column)
      append_number(text, values->values[row]);
    else
      io::append_json_string(text, io::json_text(std::string(table.cell(row, i))));
    text += ',';
  }
  return text + "\"class\":\"" + name + "\"}";
}

io::Map map_of(const ClassifyInputs& inputs, const Classified& classified) {
  io::Map map{.crs = inputs.crs};
  for (std::size_t row = 0; row < classified.ids.size(); ++row) {
    const std::string name = name_of_class(classified.classes.signs(classified.ids[row]));
    map.features.push_back(
        {.points = {inputs.table.points()[row]}, .properties = properties_of(inputs, row, name)});
  }
  return map;
}

/// What makes a point lighter or darker: its value, or the sum of its coordinates; 0 to 1.
std::vector<double> shares(const io::PointTable& table) {
  std::vector<double> result;
  if (table.values().front())
    result = table.values().front()->values;
  else
    for (const cdt::Point& p : table.points()) result.push_back(p.x + p.y);
  const auto [least, largest] = std::ranges::minmax(result);
  const double half_range = largest / 2 - least / 2;  // the whole may be beyond all numbers
  for (double& one : result) one = half_range > 0 ? (one / 2 - least / 2) / half_range : 1;
  return result;
}

/// Around all points and separators, with a margin.
cdt::Box shown_box(const ClassifyInputs& inputs) {
  cdt::Box box;
  for (const cdt::Point& p : inputs.table.points()) box.add(p);
  for (const NamedSeparator& one : inputs.separators)
    for (const cdt::Point& p : one.line.points()) box.add(p);
  const double margin = 0.05 * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return {{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}};
}

/// Whether Classes::faces() takes a box.
bool is_drawable(const cdt::Box& box) {
  const double largest = std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  const double width = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  constexpr double most = 1e70;
  constexpr double least = 1e-30;
  return largest <= most && width >= least;
}

io::ClassPicture picture_of(const ClassifyInputs& inputs, const Classified& classified) {
  io::ClassPicture picture{.box = shown_box(inputs)};
  if (is_drawable(picture.box)) picture.faces = classified.classes.faces(picture.box);
  for (const NamedSeparator& one : inputs.separators)
    picture.separators.emplace_back(one.line.points().begin(), one.line.points().end());
  const std::vector<double> dark = shares(inputs.table);
  for (std::size_t row = 0; row < classified.ids.size(); ++row) {
    const auto signs = classified.classes.signs(classified.ids[row]);
    picture.dots.push_back({inputs.table.points()[row], {signs.begin(), signs.end()}, dark[row]});
  }
  return picture;
}

void write_classified(const ClassifyCommand& command, const ClassifyInputs& inputs,
                      const Classified& classified) {
  for (const path& output : command.outputs) {
    if (is_table(output)) {
      write_table(output, table_with_classes(inputs, classified));
    } else if (io::extension(output) == ".svg") {
      io::AtomicFile file(output);
      write_classes_svg(file.stream(), picture_of(inputs, classified), command.drawing.width);
      file.commit();
    } else {
      io::write(output, map_of(inputs, classified));
    }
  }
}

/// A class, and what is in it.
struct ClassSum {
  std::vector<Sign> signs;
  std::size_t points = 0;
  double sum = 0;  ///< of the values, in the order of the table
};

std::vector<ClassSum> sums_of(const ClassifyInputs& inputs, const Classified& classified) {
  std::map<std::vector<Sign>, ClassSum> sums;
  const auto& values = inputs.table.values().front();
  for (std::size_t row = 0; row < classified.ids.size(); ++row) {
    const auto signs = classified.classes.signs(classified.ids[row]);
    ClassSum& sum = sums[{signs.begin(), signs.end()}];
    ++sum.points;
    if (values) sum.sum += values->values[row];
  }
  std::vector<ClassSum> result;
  for (auto& [signs, sum] : sums) result.push_back({signs, sum.points, sum.sum});
  return result;
}

/// The name of the column that the values are in.
std::optional<std::string> value_name(const ClassifyInputs& inputs) {
  const auto& values = inputs.table.values().front();
  if (!values) return {};
  return inputs.table.names()[values->column];
}

void print_sums(const ClassifyInputs& inputs, std::span<const ClassSum> sums) {
  std::vector<std::vector<std::string>> rows{
      {io::one_line(io::json_text(joined(inputs.separators))), "points"}};
  const auto value = value_name(inputs);
  if (value) rows.front().push_back("sum of " + io::one_line(io::json_text(*value)));
  for (const ClassSum& sum : sums) {
    rows.push_back({name_of_class(sum.signs), std::to_string(sum.points)});
    if (value) rows.back().push_back(exact(sum.sum));
  }
  for (const std::string& line : aligned(rows)) std::cout << line << '\n';
}

/// What `loft classify --json` prints: schema "loft-classify", schema_version 1, loft (version),
/// inputs, outputs; points (a number), separators (their names), value (the name of its column, or
/// null), classes, {"signs": ["left" | "right" | "on", ...], "points", "sum"} each, sum null where
/// there are no values; seconds of each stage (read, classify, write, total). Later versions of the
/// schema may add keys.
std::string to_json(const ClassifyCommand& command, const ClassifyInputs& inputs,
                    std::span<const ClassSum> sums, const std::map<std::string, double>& seconds) {
  const std::array files{command.points, command.separators};
  Json json = begin_report("loft-classify", 1, files, command.outputs);
  json["points"] = inputs.table.points().size();
  json["separators"] = Json::array();
  for (const NamedSeparator& one : inputs.separators) json["separators"].push_back(one.name);
  const auto value = value_name(inputs);
  json["value"] = value ? Json(*value) : Json();
  json["classes"] = Json::array();
  for (const ClassSum& sum : sums) {
    Json signs = Json::array();
    for (const Sign sign : sum.signs) signs.push_back(word_of(sign));
    json["classes"].push_back(
        {{"signs", signs}, {"points", sum.points}, {"sum", value ? Json(sum.sum) : Json()}});
  }
  json["seconds"] = seconds;
  return print(json);
}

}  // namespace

ExitCode run(const ClassifyCommand& command) {
  Terminal terminal(command.quiet);
  std::map<std::string, double> seconds;
  Stopwatch total;
  Stopwatch stopwatch;
  check_classify(command);

  const ClassifyInputs inputs = read_all(command);
  seconds["read"] = stopwatch.lap();

  const Classified classified = classify(inputs);
  const std::vector<ClassSum> sums = sums_of(inputs, classified);
  seconds["classify"] = stopwatch.lap();

  write_classified(command, inputs, classified);
  seconds["write"] = stopwatch.lap();
  seconds["total"] = total.lap();

  terminal.say(counted(inputs.table.points().size(), "point") + ", " +
               counted(inputs.separators.size(), "separator") + ": " +
               (sums.size() == 1 ? "1 class" : grouped(sums.size()) + " classes"));
  if (inputs.left_out > 0)
    terminal.say("left out " + grouped(inputs.left_out) +
                 (inputs.left_out == 1 ? " polygon or point" : " polygons and points") +
                 " among the separators");
  for (const path& output : command.outputs) terminal.say("wrote " + output.string());
  if (command.json)
    std::cout << to_json(command, inputs, sums, seconds) << '\n';
  else
    print_sums(inputs, sums);
  return ExitCode::ok;
}

}  // namespace loft::app
