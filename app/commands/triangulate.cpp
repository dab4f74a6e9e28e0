// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/commands.h"
#include "app/interrupt.h"
#include "app/json.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "cdt/triangulation.h"
#include "io/planar/planar_mesh.h"
#include "io/polylines.h"
#include "io/triangulations.h"
#include "reconstruct/reconstruct.h"

namespace loft::app {

namespace {

/// What there is to say about a triangulation.
struct Summary {
  std::size_t constraints = 0;
  std::size_t points = 0;  ///< of the input, repeated ones included
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t constrained_edges = 0;
  std::size_t crossings = 0;  ///< vertices that are no point of the input
  std::size_t regions = 0;    ///< triangles without a constrained edge between them
  std::size_t snaps = 0;      ///< places where rounding decides
  std::map<std::string, double> seconds;
};

/// Finds out early what would make the work useless.
void check_outputs(const TriangulateCommand& command) {
  forbid_overwriting(command.inputs, command.outputs);
  for (const auto& output : command.outputs) io::check_writable_triangulation(output);
}

std::size_t count_points(std::span<const io::Polyline> polylines) {
  std::size_t count = 0;
  for (const io::Polyline& polyline : polylines) count += polyline.points.size();
  return count;
}

/// Shows how far the work is; throws Cancelled after an interrupt.
void go_on(Terminal& terminal, std::string_view activity, double fraction) {
  if (is_interrupted()) throw Cancelled();
  terminal.show_progress(activity, fraction);
}

/// Inserts the polylines, in their order, and names the constraints they become.
std::vector<io::NamedConstraint> insert(cdt::Triangulation& mesh,
                                        std::span<const io::Polyline> polylines,
                                        Terminal& terminal) {
  const std::size_t points = count_points(polylines);
  mesh.reserve(points);
  std::vector<io::NamedConstraint> constraints;
  std::size_t done = 0;
  for (const io::Polyline& polyline : polylines) {
    go_on(terminal, "triangulate", 0.8 * static_cast<double>(done) / static_cast<double>(points));
    constraints.push_back({mesh.insert(polyline.points, polyline.ends), polyline.name});
    done += polyline.points.size();
  }
  return constraints;
}

/// The vertices that are a point of the input, by number of the planar mesh: both are sorted.
std::size_t count_given(const io::PlanarMesh& mesh, std::span<const io::Polyline> polylines) {
  std::vector<cdt::Point> given;
  for (const io::Polyline& polyline : polylines)
    given.insert(given.end(), polyline.points.begin(), polyline.points.end());
  std::ranges::sort(given);
  std::size_t count = 0;
  for (const cdt::Point& point : mesh.points)
    if (std::ranges::binary_search(given, point)) ++count;
  return count;
}

Summary summarise(const io::PlanarMesh& mesh, std::span<const io::Polyline> polylines) {
  Summary summary;
  summary.constraints = polylines.size();
  summary.points = count_points(polylines);
  summary.vertices = mesh.points.size();
  summary.triangles = mesh.triangles.size();
  summary.constrained_edges = io::count_constrained_edges(mesh);
  summary.crossings = mesh.points.size() - count_given(mesh, polylines);
  summary.regions = mesh.regions.size();
  return summary;
}

void write_all(const TriangulateCommand& command, const io::PlanarMesh& mesh, Terminal& terminal) {
  for (const auto& output : command.outputs) {
    go_on(terminal, "write", 0.9);
    io::write(output, mesh, command.drawing);
  }
}

/// `1 polyline`, `1,234 polylines`
std::string counted(std::size_t count, const std::string& thing, const char* plural = "s") {
  return grouped(count) + ' ' + thing + (count == 1 ? "" : plural);
}

void say_summary(const TriangulateCommand& command, const Summary& summary, Terminal& terminal) {
  terminal.say(counted(summary.constraints, "polyline") + " of " +
               counted(summary.points, "point") + ": " + grouped(summary.vertices) +
               (summary.vertices == 1 ? " vertex, " : " vertices, ") +
               counted(summary.triangles, "triangle") + ", " +
               counted(summary.constrained_edges, "constrained edge") + ", " +
               counted(summary.crossings, "crossing") + ", " + counted(summary.regions, "region"));
  if (summary.snaps > 0)
    terminal.say("rounding decides in " + counted(summary.snaps, "place") +
                 ": a polyline goes through a vertex hardly beside it, or past one hardly on it");
  for (const auto& output : command.outputs) terminal.say("wrote " + output.string());
}

/// What `loft triangulate --json` prints: schema "loft-triangulate", schema_version 1, loft
/// (version), inputs, outputs, the counts of the summary, seconds of each stage (read, triangulate,
/// number, write, total). Later versions of the schema may add keys.
std::string to_json(const Summary& summary, const TriangulateCommand& command) {
  Json json = begin_report("loft-triangulate", 1, command.inputs, command.outputs);
  json["constraints"] = summary.constraints;
  json["points"] = summary.points;
  json["vertices"] = summary.vertices;
  json["triangles"] = summary.triangles;
  json["constrained_edges"] = summary.constrained_edges;
  json["crossings"] = summary.crossings;
  json["regions"] = summary.regions;
  json["snaps"] = summary.snaps;
  json["epsilon"] = command.epsilon;
  json["seconds"] = summary.seconds;
  return print(json);
}

}  // namespace

ExitCode run(const TriangulateCommand& command) {
  Terminal terminal(command.quiet);
  std::map<std::string, double> seconds;
  Stopwatch total;
  Stopwatch stopwatch;
  check_outputs(command);
  catch_interrupts();

  const std::vector<io::Polyline> polylines = io::read_polylines(command.inputs);
  seconds["read"] = stopwatch.lap();

  cdt::Triangulation triangulation(command.epsilon);
  const auto constraints = insert(triangulation, polylines, terminal);
  seconds["triangulate"] = stopwatch.lap();

  go_on(terminal, "number", 0.8);
  const io::PlanarMesh mesh = io::to_planar_mesh(triangulation, constraints);
  Summary summary = summarise(mesh, polylines);
  summary.snaps = triangulation.snaps().size();
  seconds["number"] = stopwatch.lap();

  write_all(command, mesh, terminal);
  seconds["write"] = stopwatch.lap();
  seconds["total"] = total.lap();
  terminal.clear_progress();

  summary.seconds = seconds;
  say_summary(command, summary, terminal);
  if (command.json) std::cout << to_json(summary, command) << '\n';
  return ExitCode::ok;
}

}  // namespace loft::app
