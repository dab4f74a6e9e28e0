// SPDX-License-Identifier: MIT
#include "overlay/coverage.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iostream>
#include <map>
#include <span>
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
#include "io/bytes/csv_field.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/text.h"
#include "io/maps.h"
#include "reconstruct/number_text.h"

namespace loft::app {

namespace {

using overlay::CoverageFault;
using overlay::CoverageFaults;
using overlay::Overlay;

/// A fault as tables and files show it.
struct ShownFault {
  const char* kind;
  const CoverageFault* fault;
};

std::vector<ShownFault> shown(const CoverageFaults& faults) {
  std::vector<ShownFault> result;
  for (const CoverageFault& fault : faults.overlaps) result.push_back({"overlap", &fault});
  for (const CoverageFault& fault : faults.gaps) result.push_back({"gap", &fault});
  return result;
}

/// Takes out the gaps that are seas; returns how many.
std::size_t leave_out_seas(CoverageFaults& faults, const std::optional<double>& gap_width) {
  if (!gap_width) return 0;
  return std::erase_if(faults.gaps,
                       [&](const CoverageFault& gap) { return gap.width >= *gap_width; });
}

/// What two areas share.
struct CommonBorder {
  std::array<overlay::LayerId, 2> layers;
  double length = 0;
};

struct CoverageReport {
  CoverageFaults faults;
  std::size_t seas = 0;  ///< gaps that are no faults
  std::vector<CommonBorder> borders;
  std::map<std::string, double> seconds;
};

std::vector<CommonBorder> borders_of(const Overlay& overlay) {
  std::vector<CommonBorder> borders;
  for (std::size_t i = 0; i < overlay.layer_count(); ++i) {
    const overlay::LayerId one(static_cast<std::uint32_t>(i));
    for (const overlay::Neighbour& other : neighbours(overlay, one))
      if (one < other.layer) borders.push_back({{one, other.layer}, other.length});
  }
  return borders;
}

void print_borders(const Overlay& overlay, std::span<const CommonBorder> borders) {
  std::vector<std::vector<std::string>> rows{{"border", "length"}};
  for (const CommonBorder& border : borders)
    rows.push_back({io::one_line(joined_names(overlay, border.layers)), exact(border.length)});
  for (const std::string& line : aligned(rows)) std::cout << line << '\n';
}

void print_faults(const Overlay& overlay, const CoverageFaults& faults) {
  std::vector<std::vector<std::string>> rows{{"fault", "area", "width", "at x", "y"}};
  for (const auto& [kind, fault] : shown(faults)) {
    const cdt::Point at = fault->polygon.outer.front();
    rows.push_back({kind + (": " + io::one_line(joined_names(overlay, fault->layers))),
                    rounded(fault->area.to_double()), rounded(fault->width), exact(at.x),
                    exact(at.y)});
  }
  if (rows.size() == 1) return;
  for (const std::string& line : aligned(rows)) std::cout << line << '\n';
}

std::string table_of(const Overlay& overlay, const CoverageFaults& faults) {
  std::string table = "kind,layers,area,width,x,y\r\n";
  for (const auto& [kind, fault] : shown(faults)) {
    const cdt::Point at = fault->polygon.outer.front();
    table += kind + (',' + io::csv_field(joined_names(overlay, fault->layers)));
    for (const double number : {fault->area.to_double(), fault->width, at.x, at.y}) {
      table += ',';
      append_number(table, number);
    }
    table += "\r\n";
  }
  return table;
}

io::Map map_of(const Overlay& overlay, const CoverageFaults& faults) {
  io::Map map;
  for (const auto& [kind, fault] : shown(faults))
    map.features.push_back({.polygons = {fault->polygon},
                            .properties = std::string("{\"kind\":\"") + kind +
                                          "\",\"layers\":" + json_list(overlay, fault->layers) +
                                          ",\"area\":" + exact(fault->area.to_double()) +
                                          ",\"width\":" + exact(fault->width) + '}'});
  return map;
}

/// A map, and which features its layers are.
struct Coverage {
  io::Map map;
  std::vector<std::string> names;  ///< by feature
  Overlay overlay;
  bool has_layer_a_feature = true;
};

Coverage coverage_of(const CoverageCommand& command) {
  std::array maps{io::read_map(command.map)};
  std::vector<std::string> names =
      std::move(by_feature(maps, {&command.map, 1}, command.layer_by).front());
  Overlay overlay =
      command.layer_by ? overlay_of(maps, {names}) : overlay_of_features(maps.front(), names);
  return {std::move(maps.front()), std::move(names), std::move(overlay), !command.layer_by};
}

/// What is left of a feature but for its polygons, and what is known of all features of a layer.
io::Feature without_polygons(const Coverage& coverage, std::size_t feature) {
  io::Feature result = coverage.map.features[feature];
  result.polygons.clear();
  return result;
}

/// The features of a layer as one: with the properties of the first, and all lines and points.
std::vector<io::Feature> features_by_layer(const Coverage& coverage) {
  std::vector<io::Feature> features;
  std::map<std::string, std::size_t> layers;
  for (std::size_t i = 0; i < coverage.names.size(); ++i) {
    io::Feature one = without_polygons(coverage, i);
    const auto [known, is_new] = layers.try_emplace(coverage.names[i], features.size());
    if (is_new || coverage.has_layer_a_feature) {
      features.push_back(std::move(one));
      continue;
    }
    io::Feature& all = features[known->second];
    std::ranges::move(one.lines, std::back_inserter(all.lines));
    std::ranges::move(one.points, std::back_inserter(all.points));
  }
  return features;
}

io::Map mended(const CoverageCommand& command, const Coverage& coverage) {
  io::Map map{.features = features_by_layer(coverage)};
  std::vector<overlay::MultiPolygon> polygons = clean_coverage(
      coverage.overlay, {.heir = *command.clean, .gap_width = command.gap_width.value_or(0)});
  for (std::size_t i = 0; i < polygons.size(); ++i)
    map.features[i].polygons = std::move(polygons[i]);
  return map;
}

void write_coverage(const CoverageCommand& command, const Coverage& coverage,
                    const CoverageFaults& faults) {
  io::Map map = command.clean ? mended(command, coverage) : map_of(coverage.overlay, faults);
  map.crs = coverage.map.crs;
  for (const auto& output : command.outputs) {
    if (is_table(output))
      write_table(output, table_of(coverage.overlay, faults));
    else
      io::write(output, map, command.drawing);
  }
}

Json list_of(const Overlay& overlay, std::span<const CommonBorder> borders) {
  Json list = Json::array();
  for (const CommonBorder& border : borders)
    list.push_back({{"layers", names_as_json(overlay, border.layers)}, {"length", border.length}});
  return list;
}

Json list_of(const Overlay& overlay, std::span<const CoverageFault> faults) {
  Json list = Json::array();
  for (const CoverageFault& fault : faults) {
    const cdt::Point at = fault.polygon.outer.front();
    list.push_back({{"layers", names_as_json(overlay, fault.layers)},
                    {"area", fault.area.to_double()},
                    {"width", fault.width},
                    {"at", {at.x, at.y}}});
  }
  return list;
}

/// What `loft coverage --json` prints: schema "loft-coverage", schema_version 1, loft (version),
/// inputs, outputs, layers (a number); overlaps and gaps, {"layers", "area", "width", "at": [x, y]}
/// each; seas, how many gaps are no faults; with --borders borders, {"layers", "length"} each;
/// seconds of each stage (read, check, write, total). Later versions of the schema may add keys.
std::string to_json(const CoverageCommand& command, const Overlay& overlay,
                    const CoverageReport& report) {
  Json json = begin_report("loft-coverage", 1, {&command.map, 1}, command.outputs);
  json["layers"] = overlay.layer_count();
  json["overlaps"] = list_of(overlay, report.faults.overlaps);
  json["gaps"] = list_of(overlay, report.faults.gaps);
  json["seas"] = report.seas;
  if (command.borders) json["borders"] = list_of(overlay, report.borders);
  json["seconds"] = report.seconds;
  return print(json);
}

/// `2 overlaps of area 1.234`
std::string summed(std::span<const CoverageFault> faults, const std::string& what) {
  overlay::ExactArea sum;
  for (const CoverageFault& fault : faults) sum += fault.area;
  return counted(faults.size(), what) + " of area " + rounded(sum.to_double());
}

void print_report(const CoverageCommand& command, const Overlay& overlay,
                  const CoverageReport& report) {
  if (command.json) {
    std::cout << to_json(command, overlay, report) << '\n';
    return;
  }
  print_faults(overlay, report.faults);
  if (command.borders) print_borders(overlay, report.borders);
}

void say_report(Terminal& terminal, const Overlay& overlay, const CoverageReport& report) {
  const auto& [overlaps, gaps] = report.faults;
  terminal.say(counted(overlay.layer_count(), "layer") + ": " + summed(overlaps, "overlap") + ", " +
               summed(gaps, "gap"));
  if (report.seas > 0) terminal.say(counted(report.seas, "gap") + " that wide or wider: no fault");
}

}  // namespace

ExitCode run(const CoverageCommand& command) {
  Terminal terminal(command.quiet);
  CoverageReport report;
  Stopwatch total;
  Stopwatch stopwatch;
  forbid_overwriting({&command.map, 1}, command.outputs);
  for (const auto& output : command.outputs) check_table_or_map(output);

  const Coverage coverage = coverage_of(command);
  report.seconds["read"] = stopwatch.lap();

  report.faults = check_coverage(coverage.overlay);
  report.seas = leave_out_seas(report.faults, command.gap_width);
  if (command.borders) report.borders = borders_of(coverage.overlay);
  report.seconds["check"] = stopwatch.lap();

  if (!command.outputs.empty()) write_coverage(command, coverage, report.faults);
  report.seconds["write"] = stopwatch.lap();
  report.seconds["total"] = total.lap();

  print_report(command, coverage.overlay, report);
  say_report(terminal, coverage.overlay, report);
  say_notes(terminal, coverage.overlay, command.outputs);
  const bool is_sound = report.faults.overlaps.empty() && report.faults.gaps.empty();
  return command.check && !is_sound ? ExitCode::check_failed : ExitCode::ok;
}

}  // namespace loft::app
