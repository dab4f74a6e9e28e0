// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "app/commands/commands.h"
#include "app/commands/out_of_core.h"
#include "app/descriptors.h"
#include "app/interrupt.h"
#include "app/terminal.h"
#include "app/unit.h"
#include "cdt/triangulation.h"
#include "io/bytes/file.h"
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
         "  loft stream capture.ndjson --follow --session capture.session --view\n"
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

/// Within what glTF's seconds, which are floats, tell apart.
std::string complain_of_rate(const std::string& text) {
  double rate = 0;
  if (CLI::detail::lexical_cast(text, rate) && rate >= 0.001 && rate <= 1000) return {};
  return "'" + text + "' is no rate; give a number from 0.001 to 1000, edits a second";
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

/// What is inside, and how the ends are closed.
void add_slice_options(CLI::App& sub, loft::Options& options) {
  sub.add_option_function<std::string>(
         "--fill",
         [&options](const std::string& fill) {
           options.fill = fill == "nonzero"   ? loft::Fill::nonzero
                          : fill == "evenodd" ? loft::Fill::even_odd
                                              : loft::Fill::keyhole_aware;
         },
         "What is inside: nested contours are holes (evenodd, default), overlapping ones make "
         "their union (nonzero), or as evenodd with holes that a channel joins to their outline "
         "taken out (keyhole-aware)")
      ->type_name("RULE")
      ->check(CLI::IsMember({"evenodd", "nonzero", "keyhole-aware"}));
  sub.add_option("--keyhole-width", options.keyhole_width,
                 "How wide such a channel may be, in the unit of the input (default 1/1000 of "
                 "the contour's diagonal)")
      ->type_name("LENGTH")
      ->check(CLI::Validator(complain_of_distance, ""));
  sub.add_option_function<std::string>(
         "--cap",
         [&options](const std::string& cap) {
           options.cap = cap == "flat"   ? loft::Cap::flat
                         : cap == "dome" ? loft::Cap::dome
                                         : loft::Cap::open;
         },
         "What closes the first and last slice (default flat)")
      ->type_name("CAP")
      ->check(CLI::IsMember({"flat", "dome", "open"}));
}

/// How the surface goes from slice to slice.
void add_slab_options(CLI::App& sub, loft::Options& options) {
  sub.add_option_function<std::string>(
         "--link",
         [&options](const std::string& link) {
           options.link = link == "auto"      ? loft::LinkRule::automatic
                          : link == "overlap" ? loft::LinkRule::overlap
                                              : loft::LinkRule::none;
         },
         "Which parts of neighbouring slices are joined: those that overlap, and those that belong "
         "together by where they lie (auto, default); those that overlap; none, but for --links")
      ->type_name("RULE")
      ->check(CLI::IsMember({"auto", "overlap", "none"}));
  sub.add_option("--max-shift", options.max_shift,
                 "The farthest that --link auto moves a part sideways between two slices, in the "
                 "unit of the input; by the parts' size where not given")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(complain_of_distance, ""));
  sub.add_flag("--smooth", options.smooth,
               "Bend the surface between the slices as their neighbours suggest; it still passes "
               "through every contour");
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
  add_slice_options(*sub, command.options);
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
  add_slab_options(*sub, command.options);
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
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout");
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
  return sub;
}

/// Options of commands that serve.
template <class Command>
void add_address_options(CLI::App& sub, Command& command) {
  sub.add_option("--host", command.host,
                 "Address to listen on (default 127.0.0.1: this machine only; 0.0.0.0: anyone who "
                 "can reach it)")
      ->type_name("ADDRESS");
  sub.add_option("--unit", command.unit,
                 "Unit of the input, for glTF's metres (default mm): " + std::string(unit_names))
      ->type_name("UNIT")
      ->check(CLI::Validator(complain_of_unit, ""));
  sub.add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
}

/// Adds `loft stream`; the command is ready when the line has been parsed.
CLI::App* add_stream(CLI::App& app, StreamCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "stream", "Keep a surface up to date while its slices come, change and go");
  sub->add_option("IN", command.input, "File of edits, a line each; - or nothing: standard input");
  sub->add_flag("--follow", command.follows, "Wait for more at the end of IN: it grows");
  sub->add_flag_callback(
      "--no-input", [&command] { command.has_input = false; },
      "Read no edits but those that are posted");
  sub->add_option("-o,--output", command.outputs,
                  "Output file, " + loft::io::surface_extensions() +
                      "; written at the end and on SIGUSR1; may be repeated")
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_option("--every", command.every, "Write the outputs after every N edits, too")
      ->type_name("N")
      ->check(CLI::Range(0, 1'000'000'000));
  sub->add_option("--replay", command.replay,
                  "GLB file, written at the end: an animation in which the slabs appear as they "
                  "came; of a session, too")
      ->type_name("OUT.glb");
  sub->add_option("--replay-rate", command.replay_rate, "Edits a second in it (default 20)")
      ->type_name("N")
      ->check(CLI::Validator(complain_of_rate, ""));
  sub->add_option("--session", command.session,
                  "Keep every edit in this file before it is acknowledged; if it is there, go on "
                  "from it, and in IN where it was")
      ->type_name("FILE");
  sub->add_flag_callback(
      "--view", [&command] { command.serves = true; },
      "Serve a page that shows the surface as it grows, and take edits by HTTP");
  sub->add_option_function<int>(
         "--port",
         [&command](int port) {
           command.port = port;
           command.serves = true;
         },
         "Take edits by HTTP on this port (default 8337 with --view; 0: any that is free)")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535));
  sub->add_option("--max-body", command.most_megabytes,
                  "Largest body of a request, in MiB (default 16)")
      ->type_name("MIB")
      ->check(CLI::Range(1U, 1024U));
  sub->add_option("--max-effort", command.most_effort,
                  "Most that one edit may take, in millions of steps (default 2000, a minute or "
                  "so); beyond, it is rejected")
      ->type_name("N")
      ->check(CLI::Range(0.001, 1e9));
  sub->add_option("--token", command.token,
                  "What those who send edits from beyond this machine must know (--host; drawn "
                  "and printed where not given): Authorization: Bearer TOKEN")
      ->type_name("TOKEN");
  add_slice_options(*sub, command.options);
  add_slab_options(*sub, command.options);
  add_address_options(*sub, command);
  sub->add_flag("--strict", command.strict, "Exit with 3 if an edit was bad");
  sub->add_flag("--json", command.json, "Print a report as one JSON object at the end");
  sub->footer(
      "An edit is a slice as in a stack file, {\"z\": 1.5, \"contours\": [[[x, y], ...], ...]}, "
      "with\n\"op\": \"replace\" for one that is there already, or {\"op\": \"remove\", "
      "\"z\": 1.5}.\nBad ones are reported and left out.\n\n"
      "Examples:\n"
      "  scanner | loft stream -o part.glb\n"
      "  loft stream capture.ndjson --follow --session capture.session --view\n"
      "  loft stream --no-input --port 8337 --session capture.session -o part.ply\n"
      "  curl --data-binary @slices.ndjson http://127.0.0.1:8337/slices");
  return sub;
}

/// Notes which of a session's settings the command line names, and what makes no sense in it.
void look_at_options(const CLI::App& sub, StreamCommand& command) {
  for (const char* setting :
       {"fill", "keyhole_width", "cap", "link", "max_shift", "smooth", "unit"}) {
    std::string option = std::string("--") + setting;
    std::ranges::replace(option, '_', '-');
    if (sub.count(option) > 0) command.given.insert(setting);
  }
  const bool has_file = command.input && *command.input != "-";
  if (!command.has_input && command.input)
    throw UsageError("--no-input and a file of edits exclude each other");
  if (!command.has_input && !command.serves && !command.session)
    throw UsageError("nothing to do: --no-input needs --port, --view or --session");
  if (command.follows && !has_file) throw UsageError("--follow needs a file of edits");
  if (sub.count("--host") > 0 && !command.serves)
    throw UsageError("--host needs --port or --view: nothing would listen there");
}

/// Adds `loft view`; the command is ready when the line has been parsed.
CLI::App* add_view(CLI::App& app, ViewCommand& command) {
  CLI::App* sub = app.add_subcommand("view", "Show a mesh or the session of a stream in a browser");
  sub->add_option("FILE", command.file,
                  "Mesh file, " + loft::io::mesh_extensions() + ", or session file")
      ->required();
  sub->add_option("--port", command.port, "Port to serve on (default 8337; 0: any that is free)")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535));
  add_address_options(*sub, command);
  sub->footer(
      "Open the address that it prints; Ctrl-C ends it.\n\n"
      "Examples:\n"
      "  loft view skull.ply\n"
      "  loft view capture.session --port 0");
  return sub;
}

/// Adds `loft session`; the command is ready when the line has been parsed.
CLI::App* add_session(CLI::App& app, SessionCommand& command) {
  CLI::App* sub = app.add_subcommand("session", "Look into the session of a stream");
  sub->require_subcommand(1);
  const auto add = [&](const char* name, const char* what, SessionCommand::What kind) {
    CLI::App* one = sub->add_subcommand(name, what);
    one->add_option("FILE", command.file, "Session file")->required();
    one->callback([&command, kind] { command.what = kind; });
    one->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
    return one;
  };
  add("list", "Show its edits, a line each, and how it was begun", SessionCommand::What::list)
      ->add_flag("--json", command.json, "Print one JSON object");
  CLI::App* exporting = add("export", "Write the slices that its edits have left as a stack file",
                            SessionCommand::What::export_slices);
  exporting->add_option("-o,--output", command.output, "Output file; - (default): standard output")
      ->type_name("OUT");
  exporting->add_flag("--edits", command.edits, "Write the edits as they came instead");
  add("verify", "Check the file and every edit in it; exit code 1 if it is damaged",
      SessionCommand::What::verify)
      ->add_flag("--json", command.json, "Print one JSON object");
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
  StreamCommand stream;
  ViewCommand view;
  SessionCommand session;
  TriangulateCommand triangulate;
  CheckCommand check;
  InfoCommand info;
  const CLI::App* reconstruct_app = add_reconstruct(app, reconstruct);
  const CLI::App* stream_app = add_stream(app, stream);
  const CLI::App* view_app = add_view(app, view);
  const CLI::App* session_app = add_session(app, session);
  const CLI::App* triangulate_app = add_triangulate(app, triangulate);
  const CLI::App* check_app = add_check(app, check);
  add_info(app, info);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::ok : ExitCode::usage;
  }
  if (reconstruct_app->parsed()) return run(reconstruct);
  if (stream_app->parsed()) {
    look_at_options(*stream_app, stream);
    return run(stream);
  }
  if (view_app->parsed()) return run(view);
  if (triangulate_app->parsed()) return run(triangulate);
  // What follows does not look for interrupts: it is ended.
  catch_interrupts(std::chrono::milliseconds(0));
  if (session_app->parsed()) return run(session);
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

/// Results that did not arrive are a failure, whatever else went well.
ExitCode flush_results(ExitCode code) {
  errno = 0;
  std::cout.flush();
  if (std::cout) return code;
  const std::string cause = errno != 0 ? loft::io::last_cause() : "a write failed";
  return fail(("cannot write to standard output: " + cause).c_str(), ExitCode::cannot_write);
}

}  // namespace

int main(int argc, char** argv) {
  open_closed_descriptors();
  std::ios::sync_with_stdio(false);
  return static_cast<int>(flush_results(run_safely(argc, argv)));
}
