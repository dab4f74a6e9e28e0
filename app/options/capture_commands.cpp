// SPDX-License-Identifier: MIT
#include "app/options/capture_commands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

#include "app/live/scenes.h"
#include "app/options/complaints.h"
#include "app/options/shared_options.h"
#include "io/meshes.h"
#include "io/scenes.h"
#include "io/stack.h"
#include "io/surfaces.h"
#include "io/tables.h"
#include "io/unit.h"

namespace loft::app {

namespace {

/// Options of commands that serve.
template <class Command>
void add_address_options(CLI::App& sub, Command& command) {
  begin_group(sub, server_heading);
  sub.add_option("--host", command.host,
                 "Address to listen on (default 127.0.0.1: this machine only; 0.0.0.0: anyone who "
                 "can reach it)")
      ->type_name("ADDRESS");
  begin_group(sub, results_heading);
  sub.add_option(
         "--unit", command.unit,
         "Unit of the input, for glTF's metres (default mm): " + std::string(io::unit_names))
      ->type_name("UNIT")
      ->check(CLI::Validator(complain_of_unit, ""));
  add_quiet_option(sub, command.quiet);
}

}  // namespace

CLI::App* add_stream(CLI::App& app, StreamCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "stream", "Keep a surface up to date while its slices come, change and go");
  sub->add_option("IN", command.input, "File of edits, a line each; - or nothing: standard input");
  begin_group(*sub, "Edits");
  sub->add_flag("--follow", command.follows, "Wait for more at the end of IN: it grows");
  sub->add_flag_callback(
      "--no-input", [&command] { command.has_input = false; },
      "Read no edits but those that are posted");
  sub->add_option("--session", command.session,
                  "Keep every edit in this file before it is acknowledged; if it is there, go on "
                  "from it, and in IN where it was")
      ->type_name("FILE");
  sub->add_option("--max-effort", command.most_effort,
                  "Most that one edit may take, in millions of steps (default 2000, a minute or "
                  "so); beyond, it is rejected")
      ->type_name("N")
      ->check(CLI::Range(0.001, 1e9));
  begin_group(*sub, results_heading);
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
  begin_group(*sub, server_heading);
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

void look_at_options(const CLI::App& sub, StreamCommand& command) {
  for (const char* setting : {"fill", "keyhole_width", "cap", "link", "max_shift", "smooth",
                              "smooth_tolerance", "tolerance", "unit", "fair"}) {
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

CLI::App* add_view(CLI::App& app, ViewCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "view", "Show a mesh, the contours of a stack or the session of a stream in a browser");
  sub->add_option("FILE", command.file,
                  "Mesh file, " + loft::io::mesh_extensions() + ", stack, " +
                      loft::io::stack_extensions() + ", or session file")
      ->required();
  sub->add_option("--at", command.at, "Of a session only the first N edits: as it was after them")
      ->type_name("N");
  sub->add_option("--export", command.folder,
                  "Write a folder that shows it on any web server, or opened from the disk, in "
                  "place of serving it")
      ->type_name("FOLDER");
  sub->add_flag("--force", command.overwrites, "Export into a folder that is not empty, too");
  begin_group(*sub, server_heading);
  sub->add_option("--port", command.port, "Port to serve on (default 8337; 0: any that is free)")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535));
  add_address_options(*sub, command);
  sub->footer(
      "Open the address that it prints; Ctrl-C ends it.\n\n"
      "Examples:\n"
      "  loft view skull.ply\n"
      "  loft view slices.dcm\n"
      "  loft view skull.ply --export skull\n"
      "  loft view capture.session --port 0");
  return sub;
}

CLI::App* add_live(CLI::App& app, LiveCommand& command) {
  CLI::App* sub = app.add_subcommand("live",
                                     "Play with shapes, maps, paths, fields and classes in a "
                                     "browser: all else follows what is dragged");
  sub->add_option("SCENE", command.scene,
                  "Scene to open, " + loft::io::scene_extensions() + ", or a table of points, " +
                      loft::io::point_table_extensions() +
                      "; without it each tab has one of its own");
  sub->add_option(
         "--tab", command.tab,
         "The tab that it is opened in, and that is shown at first (default: points with a "
         "property value are for field, points and lines alone for classes, among polygons "
         "for paths; polygons with names are a map, others shapes)")
      ->type_name("TAB")
      ->check(CLI::IsMember(tab_names()));
  begin_group(*sub, server_heading);
  sub->add_option("--port", command.port, "Port to serve on (default 8337; 0: any that is free)")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535));
  sub->add_option("--token", command.token,
                  "What those who edit from beyond this machine must know (--host; drawn and "
                  "printed where not given): it is asked for by the page")
      ->type_name("TOKEN");
  sub->add_option("--host", command.host,
                  "Address to listen on (default 127.0.0.1: this machine only)")
      ->type_name("ADDRESS");
  add_quiet_option(*sub, command.quiet);
  sub->footer(
      "Open the address that it prints; Ctrl-C ends it. In the page, ? lists the keys; T shows "
      "the\n"
      "triangles.\n\n"
      "Examples:\n"
      "  loft live\n"
      "  loft live town.geojson --tab paths\n"
      "  loft live world.geojson --port 0");
  return sub;
}

CLI::App* add_session(CLI::App& app, SessionCommand& command) {
  CLI::App* sub = app.add_subcommand("session", "Look into the session of a stream");
  sub->require_subcommand(1);
  const auto add = [&](const char* name, const char* what, SessionCommand::What kind) {
    CLI::App* one = sub->add_subcommand(name, what);
    one->add_option("FILE", command.file, "Session file")->required();
    one->callback([&command, kind] { command.what = kind; });
    add_quiet_option(*one, command.quiet);
    return one;
  };
  add("list", "Show its edits, a line each, and how it was begun", SessionCommand::What::list)
      ->add_flag("--json", command.json, "Print one JSON object");
  CLI::App* exporting = add("export", "Write the slices that its edits have left as a stack file",
                            SessionCommand::What::export_slices);
  exporting->add_option("-o,--output", command.output, "Output file; - (default): standard output")
      ->type_name("OUT");
  exporting->add_flag("--edits", command.edits, "Write the edits as they came instead");
  exporting
      ->add_option("--at", command.at, "Of the first N edits only: the stack as it was after them")
      ->type_name("N");
  add("verify", "Check the file and every edit in it; exit code 1 if it is damaged",
      SessionCommand::What::verify)
      ->add_flag("--json", command.json, "Print one JSON object");
  add("history", "Show the last 1,000 edits, numbered from 1, and which were undone",
      SessionCommand::What::history)
      ->add_flag("--json", command.json, "Print one JSON object");
  add("undo", "Take the last edit back that was not; that is another edit",
      SessionCommand::What::undo);
  add("redo", "Do the edit again that was undone last", SessionCommand::What::redo);
  return sub;
}

}  // namespace loft::app
