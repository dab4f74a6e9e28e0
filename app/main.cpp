// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "app/commands.h"
#include "app/out_of_core.h"
#include "app/terminal.h"
#include "app/unit.h"
#include "cdt/triangulation.h"
#include "io/file.h"
#include "io/meshes.h"
#include "io/polylines.h"
#include "io/slices.h"
#include "io/surfaces.h"
#include "io/triangulations.h"
#include "io/version.h"
#include "reconstruct/reconstruct.h"

namespace {

using namespace loft::app;

std::string footer() {
  return "Examples:\n"
         "  loft reconstruct skull.ndjson -o skull.glb\n"
         "  loft reconstruct a.ndjson b.ndjson -o both.ply -o both.glb --unit um --json\n"
         "  loft check skull.ply --stack skull.ndjson\n"
         "  loft info skull.ndjson\n"
         "  loft triangulate world.geojson -o world.svg\n"
         "\n"
         "Stacks: NDJSON, a slice a line, {\"z\": 1.5, \"contours\": [[[x, y], ...], ...]}; a "
         "contour\n"
         "is closed without repeating its first point; optional \"labels\": a name a contour, "
         "each\n"
         "label is reconstructed on its own. '-' reads standard input.\n"
         "  stacks " +
         loft::io::slice_extensions() + "; surfaces out " + loft::io::surface_extensions() +
         "\n"
         "Polylines: GeoJSON, or text with a line 'n closed' (0 or 1) for each and n lines 'x y'.\n"
         "  polylines " +
         loft::io::polyline_extensions() + "; triangulations out " +
         loft::io::triangulation_extensions() +
         "\n"
         "\n"
         "Exit codes: 0 ok, 1 check failed, 2 usage, 3 bad input, 4 cannot write, 130 "
         "interrupted.\n"
         "Results go to stdout, words to stderr. NO_COLOR is respected.";
}

/// A check for CLI11: the text says what is wrong, empty if nothing is.
std::string complain_of_unit(const std::string& unit) {
  if (metres_per_unit(unit)) return {};
  return "'" + unit + "' is no unit; known are " + std::string(unit_names);
}

/// A check for CLI11, as above.
std::string complain_of_length(const std::string& text) {
  double length = 0;
  if (CLI::detail::lexical_cast(text, length) && std::isfinite(length) && length > 0) return {};
  return "'" + text + "' is no length; give a number above 0, in the unit of the input";
}

std::string complain_of_distance(const std::string& text) {
  double distance = 0;
  if (CLI::detail::lexical_cast(text, distance) && std::isfinite(distance) && distance >= 0)
    return {};
  return "'" + text + "' is no distance; give 0 or a number above, in the unit of the input";
}

/// Options for smaller or fewer triangles.
void add_triangle_options(CLI::App& sub, loft::Options& options) {
  CLI::Option* max_edge =
      sub.add_option("--max-edge", options.max_edge,
                     "Split edges between slices that are longer; contour edges stay")
          ->type_name("LENGTH")
          ->check(CLI::Validator(complain_of_length, ""));
  CLI::Option* target_edge =
      sub.add_option("--target-edge", options.target_edge,
                     "Bring edges between slices near this length, with well-shaped triangles; "
                     "contour edges stay")
          ->type_name("LENGTH")
          ->check(CLI::Validator(complain_of_length, ""));
  CLI::Option* simplify =
      sub.add_option("--simplify", options.simplify,
                     "Remove vertices as long as the surface, contours included, moves by no more "
                     "than this; 0 removes only what changes nothing")
          ->type_name("TOLERANCE")
          ->check(CLI::Validator(complain_of_distance, ""));
  max_edge->excludes(target_edge)->excludes(simplify);
  target_edge->excludes(simplify);
}

/// Adds `loft reconstruct`; the command is ready when the line has been parsed.
CLI::App* add_reconstruct(CLI::App& app, ReconstructCommand& command) {
  CLI::App* sub = app.add_subcommand("reconstruct", "Make closed surfaces from stacks of contours");
  sub->add_option("IN", command.inputs, "Stack files, or - for standard input")->required();
  sub->add_option("-o,--output", command.outputs,
                  "Output file, " + loft::io::surface_extensions() + "; may be repeated")
      ->required()
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_option_function<std::string>(
         "--fill",
         [&command](const std::string& fill) {
           command.options.fill = fill == "nonzero"   ? loft::Fill::nonzero
                                  : fill == "evenodd" ? loft::Fill::even_odd
                                                      : loft::Fill::keyhole_aware;
         },
         "What is inside: nested contours are holes (evenodd, default), overlapping ones make "
         "their union (nonzero), or as evenodd with holes that a channel joins to their outline "
         "taken out (keyhole-aware)")
      ->type_name("RULE")
      ->check(CLI::IsMember({"evenodd", "nonzero", "keyhole-aware"}));
  sub->add_option("--keyhole-width", command.options.keyhole_width,
                  "How wide such a channel may be, in the unit of the input (default 1/1000 of "
                  "the contour's diagonal)")
      ->type_name("LENGTH")
      ->check(CLI::Validator(complain_of_distance, ""));
  sub->add_option_function<std::string>(
         "--cap",
         [&command](const std::string& cap) {
           command.options.cap = cap == "flat"   ? loft::Cap::flat
                                 : cap == "dome" ? loft::Cap::dome
                                                 : loft::Cap::open;
         },
         "What closes the first and last slice (default flat)")
      ->type_name("CAP")
      ->check(CLI::IsMember({"flat", "dome", "open"}));
  sub->add_option("--threads", command.options.threads,
                  "Threads that work at the same time; 0 (default): as many as the machine has")
      ->type_name("N")
      ->check(CLI::Range(0U, 1024U));
  const auto memory = [&command](Memory choice) {
    return [&command, choice] { command.memory = choice; };
  };
  CLI::Option* const out =
      sub->add_flag_callback("--out-of-core", memory(Memory::out_of_core),
                             "Leave the stack in its file and work slab by slab, in little memory; "
                             "one output, a PLY file, "
                             "the same as otherwise. The default for inputs above " +
                                 std::to_string(most_in_memory >> 20U) + " MiB");
  sub->add_flag_callback("--in-memory", memory(Memory::in_memory),
                         "Read the stack as a whole, whatever its size")
      ->excludes(out);
  sub->add_option_function<std::string>(
         "--link",
         [&command](const std::string& link) {
           command.options.link = link == "auto"      ? loft::LinkRule::automatic
                                  : link == "overlap" ? loft::LinkRule::overlap
                                                      : loft::LinkRule::none;
         },
         "Which parts of neighbouring slices are joined: those that overlap, and those that belong "
         "together by where they lie (auto, default); those that overlap; none, but for --links")
      ->type_name("RULE")
      ->check(CLI::IsMember({"auto", "overlap", "none"}));
  sub->add_option("--max-shift", command.options.max_shift,
                  "The farthest that --link auto moves a part sideways between two slices, in the "
                  "unit of the input; by the parts' size where not given")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(complain_of_distance, ""));
  sub->add_option("--links", command.links,
                  "Contours to join or to keep apart: a line {\"from\": [slice, contour], "
                  "\"to\": [slice, contour], \"link\": true or false} each")
      ->type_name("FILE");
  add_triangle_options(*sub, command.options);
  sub->add_option_function<std::string>(
         "--unit",
         [&command](const std::string& unit) { command.metres_per_unit = *metres_per_unit(unit); },
         "Unit of the input, for glTF's metres (default mm): " + std::string(unit_names))
      ->type_name("UNIT")
      ->check(CLI::Validator(complain_of_unit, ""));
  sub->add_flag("--smooth", command.options.smooth,
                "Bend the surface between the slices as their neighbours suggest; it still passes "
                "through every contour");
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout");
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
  return sub;
}

/// Adds `loft triangulate`; the command is ready when the line has been parsed.
CLI::App* add_triangulate(CLI::App& app, TriangulateCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "triangulate", "Make the constrained Delaunay triangulation of polylines and polygons");
  sub->add_option("IN", command.inputs, "Polyline files, or - for standard input")->required();
  sub->add_option("-o,--output", command.outputs,
                  "Output file, " + loft::io::triangulation_extensions() + "; may be repeated")
      ->required()
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_option("--epsilon", command.epsilon,
                  "Points and polylines closer than that become one, default 0")
      ->type_name("DISTANCE")
      ->check(CLI::Range(0.0, loft::cdt::Triangulation::largest_coordinate));
  sub->add_flag_callback(
      "--no-fill", [&command] { command.drawing.has_fill = false; },
      "Leave regions uncoloured (SVG)");
  sub->add_flag_callback(
      "--no-edges", [&command] { command.drawing.has_edges = false; },
      "Draw only the edges that lie on a polyline (SVG)");
  sub->add_option("--width", command.drawing.width, "Width in pixels, default 1200 (SVG)")
      ->type_name("PIXELS")
      ->check(CLI::Range(10.0, 100'000.0));
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout");
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
  return sub;
}

CLI::App* add_check(CLI::App& app, CheckCommand& command) {
  CLI::App* sub =
      app.add_subcommand("check",
                         "Tell whether a mesh bounds a valid solid: closed, manifold, oriented, no "
                         "degenerate face, no self-intersection; exit code 1 if not");
  sub->add_option("MESH", command.mesh, "Mesh file, " + loft::io::mesh_extensions())->required();
  sub->add_option("--stack", command.stack,
                  "Also: is every contour vertex and edge of this stack in the mesh, exactly?");
  sub->add_flag("--json", command.json, "Print the result as one JSON object");
  return sub;
}

CLI::App* add_info(CLI::App& app, InfoCommand& command) {
  CLI::App* sub = app.add_subcommand("info", "Show counts, bounds, gaps and labels of a file");
  sub->add_option("FILE", command.file, "A stack or a mesh")->required();
  sub->add_flag("--json", command.json, "Print the result as one JSON object");
  return sub;
}

ExitCode run_program(int argc, char** argv) {
  CLI::App app("Closed surfaces from stacks of planar contours, and triangulations of the plane",
               "loft");
  app.set_version_flag("--version", std::string(loft::io::generator()));
  app.footer(footer());
  app.require_subcommand(1);
  ReconstructCommand reconstruct;
  TriangulateCommand triangulate;
  CheckCommand check;
  InfoCommand info;
  const CLI::App* reconstruct_app = add_reconstruct(app, reconstruct);
  const CLI::App* triangulate_app = add_triangulate(app, triangulate);
  const CLI::App* check_app = add_check(app, check);
  add_info(app, info);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::ok : ExitCode::usage;
  }
  if (reconstruct_app->parsed()) return run(reconstruct);
  if (triangulate_app->parsed()) return run(triangulate);
  return check_app->parsed() ? run(check) : run(info);
}

ExitCode fail(const char* what, ExitCode code) {
  Terminal().complain(what);
  return code;
}

/// Every failure has its exit code.
ExitCode run_safely(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const UsageError& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const loft::io::UnknownFormat& error) {
    return fail(error.what(), ExitCode::usage);
  } catch (const loft::InputError& error) {
    return fail(error.what(), ExitCode::bad_input);
  } catch (const loft::io::FileError& error) {
    const bool is_reading = error.access() == loft::io::Access::read;
    return fail(error.what(), is_reading ? ExitCode::bad_input : ExitCode::cannot_write);
  } catch (const loft::Cancelled&) {
    return fail("interrupted; nothing was written", ExitCode::interrupted);
  } catch (const loft::Error& error) {
    return fail(error.what(), ExitCode::cannot_write);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", ExitCode::bad_input);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  return static_cast<int>(run_safely(argc, argv));
}
