// SPDX-License-Identifier: MIT
#include "app/options/command_line.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <string>
#include <utility>

#include "app/interrupt.h"
#include "app/options/capture_commands.h"
#include "app/options/complaints.h"
#include "app/options/completion.h"
#include "app/options/help.h"
#include "app/options/manual.h"
#include "app/options/map_commands.h"
#include "app/options/shared_options.h"
#include "app/options/stack_commands.h"
#include "app/options/tree.h"
#include "io/maps.h"
#include "io/polylines.h"
#include "io/scenes.h"
#include "io/stack.h"
#include "io/surfaces.h"
#include "io/triangulations.h"
#include "io/version.h"

namespace loft::app {

namespace {

std::string footer() {
  return "Examples:\n"
         "  loft reconstruct skull.ndjson -o skull.glb\n"
         "  loft info plan.dcm\n"
         "  loft reconstruct plan.dcm -o organs.glb -o '{label}.stl' --only 'Lung*'\n"
         "  loft reconstruct labels.nii.gz -o labels.glb --smooth\n"
         "  loft check skull.ply --stack skull.ndjson\n"
         "  loft stream capture.ndjson --follow --session capture.session --view\n"
         "  loft triangulate world.geojson -o world.svg\n"
         "  loft overlay parks.geojson lakes.geojson --keep 'parks - lakes' -o land.geojson\n"
         "  loft path town.geojson --from 1,2 --to 30,40 --radius 0.5 -o way.svg\n"
         "\n"
         "Stacks: NDJSON, a slice a line, {\"z\": 1.5, \"contours\": [[[x, y], ...], ...]}; a "
         "contour\n"
         "is closed without repeating its first point; optional \"labels\": a name a contour, "
         "each\n"
         "label is reconstructed on its own. '-' reads standard input.\n"
         "  stacks " +
         loft::io::stack_extensions() + "; surfaces out " + loft::io::surface_extensions() +
         "\n"
         "Polylines: GeoJSON, or text with a line 'n closed' (0 or 1) for each and n lines 'x y'.\n"
         "  polylines " +
         loft::io::polyline_extensions() + "; triangulations out " +
         loft::io::triangulation_extensions() +
         "\n"
         "Maps: GeoJSON polygons with their holes and properties.\n"
         "  maps " +
         loft::io::map_extensions() + "; maps out " + loft::io::map_output_extensions() +
         "\n"
         "  scenes for paths " +
         loft::io::scene_extensions() +
         "\n"
         "\n"
         "Exit codes: 0 ok, 1 check failed, 2 usage, 3 bad input, 4 cannot write, 130 "
         "interrupted\n(SIGINT, SIGTERM, SIGHUP).\n"
         "Results go to stdout, words to stderr. NO_COLOR is respected.";
}

/// Adds `loft triangulate`; the command is ready when the line has been parsed.
CLI::App* add_triangulate(CLI::App& app, TriangulateCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "triangulate", "Make the constrained Delaunay triangulation of polylines and polygons");
  sub->add_option("IN", command.inputs, "Polyline files, or - for standard input")->required();
  begin_group(*sub, results_heading);
  sub->add_option("-o,--output", command.outputs,
                  "Output file, " + loft::io::triangulation_extensions() + "; may be repeated")
      ->required()
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_option("--epsilon", command.epsilon,
                  "Points and polylines closer than that become one, default 0")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(complain_of_epsilon, ""));
  add_report_option(*sub, command.json);
  add_quiet_option(*sub, command.quiet);
  begin_group(*sub, "Drawing (SVG)");
  sub->add_flag_callback(
      "--no-fill", [&command] { command.drawing.has_fill = false; }, "Leave regions uncoloured");
  sub->add_flag_callback(
      "--no-edges", [&command] { command.drawing.has_edges = false; },
      "Draw only the edges that lie on a polyline");
  sub->add_option("--width", command.drawing.width, "Width in pixels, default 1200")
      ->type_name("PIXELS")
      ->check(CLI::Range(10.0, 100'000.0));
  return sub;
}

/// Adds `loft help`, and what the build makes the installed documents with.
CLI::App* add_help(CLI::App& app, std::vector<std::string>& words) {
  CLI::App* sub = app.add_subcommand("help", "Show what a command does, and its options");
  sub->add_option("COMMAND", words, "A command, as reconstruct or session list; nothing: all");
  return sub;
}

CLI::App* add_completion(CLI::App& app, std::string& shell) {
  CLI::App* sub = app.add_subcommand("completion", "Print what completes command lines in a shell");
  sub->add_option("SHELL", shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  return sub->group("");
}

CLI::App* add_man(CLI::App& app) {
  return app.add_subcommand("man", "Print the manual page")->group("");
}

/// For commands that do not look for interrupts: they are ended.
template <class Command>
ExitCode run_at_once(const Command& command) {
  catch_interrupts(std::chrono::milliseconds(0));
  return app::run(command);
}

}  // namespace

CommandLine::CommandLine()
    : app_("Closed surfaces from stacks of planar contours, and triangulations of the plane",
           "loft") {
  app_.set_version_flag("--version", std::string(loft::io::generator()),
                        "Print the version and exit");
  app_.footer(footer());
  app_.require_subcommand(1);
  const auto when = [this](CLI::App* sub, std::function<ExitCode()> run) {
    runs_.emplace_back(sub, std::move(run));
  };
  when(add_reconstruct(app_, reconstruct_), [this] { return app::run(reconstruct_); });
  CLI::App* const stream = add_stream(app_, stream_);
  when(stream, [this, stream] {
    look_at_options(*stream, stream_);
    return app::run(stream_);
  });
  when(add_view(app_, view_), [this] { return app::run(view_); });
  when(add_live(app_, live_), [this] { return app::run(live_); });
  when(add_session(app_, session_), [this] { return run_at_once(session_); });
  when(add_triangulate(app_, triangulate_), [this] { return app::run(triangulate_); });
  when(add_overlay(app_, overlay_), [this] { return run_at_once(overlay_); });
  when(add_coverage(app_, coverage_), [this] { return run_at_once(coverage_); });
  when(add_query(app_, query_), [this] { return run_at_once(query_); });
  when(add_path(app_, path_), [this] { return run_at_once(path_); });
  when(add_classify(app_, classify_), [this] { return run_at_once(classify_); });
  when(add_field(app_, field_), [this] { return run_at_once(field_); });
  when(add_check(app_, check_), [this] { return run_at_once(check_); });
  when(add_convert(app_, convert_), [this] { return run_at_once(convert_); });
  when(add_slice(app_, slice_), [this] {
    if (!slice_.gap && slice_.heights.empty())
      throw UsageError("loft slice needs --gap or --heights");
    return run_at_once(slice_);
  });
  when(add_join(app_, join_), [this] { return app::run(join_); });
  when(add_info(app_, info_), [this] { return run_at_once(info_); });
  when(add_help(app_, help_), [this] { return show_help(app_, help_); });
  when(add_completion(app_, shell_), [this] {
    std::cout << completion(tree_of(app_), shell_);
    return ExitCode::ok;
  });
  when(add_man(app_), [this] {
    std::cout << manual(tree_of(app_), loft::io::generator());
    return ExitCode::ok;
  });
}

ExitCode CommandLine::run() const {
  for (const auto& [sub, run] : runs_)
    if (sub->parsed()) return run();
  return ExitCode::usage;
}

}  // namespace loft::app
