// SPDX-License-Identifier: MIT
#include "app/options/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>
#include <utility>

#include "app/commands/out_of_core.h"
#include "app/commands/shard.h"
#include "app/interrupt.h"
#include "app/live/scenes.h"
#include "app/options/complaints.h"
#include "app/options/completion.h"
#include "app/options/help.h"
#include "app/options/manual.h"
#include "app/options/map_commands.h"
#include "app/options/shared_options.h"
#include "app/options/tree.h"
#include "io/maps.h"
#include "io/meshes.h"
#include "io/polylines.h"
#include "io/scenes.h"
#include "io/stack.h"
#include "io/stack_writer.h"
#include "io/surfaces.h"
#include "io/tables.h"
#include "io/triangulations.h"
#include "io/unit.h"
#include "io/version.h"
#include "reconstruct/out_of_core.h"

namespace loft::app {

namespace {

/// The heading of options that say what comes out, and how it is told.
constexpr const char* results = "Results";
constexpr const char* server = "Server";

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

void add_gltf_options(CLI::App& sub, ReconstructCommand& command) {
  begin_group(sub, "glTF");
  sub.add_option_function<std::string>(
         "--compress",
         [&command](const std::string& how) {
           command.compression =
               how == "quantize" ? io::Compression::quantize : io::Compression::meshopt;
         },
         "Smaller files, not for every program (Blender reads neither): positions of 16 bits, "
         "normals of 8 (quantize), and these packed by meshoptimizer (meshopt). What rounding "
         "breaks is mended, or counted in a warning")
      ->type_name("HOW")
      ->check(CLI::IsMember({"quantize", "meshopt"}));
  sub.add_flag("--with-contours", command.with_contours,
               "The contours, too, as lines beside each label");
  sub.add_option("--hide", command.hidden,
                 "Labels of that name, or like that pattern, start hidden, in viewers that know "
                 "KHR_node_visibility; may be repeated")
      ->type_name("LABEL")
      ->allow_extra_args(false);
}

/// Shares of the work for jobs that are started again until all is done.
void add_job_options(CLI::App& sub, ReconstructCommand& command) {
  sub.add_option_function<std::string>(
         "--shard",
         [&command](const std::string& text) { command.shard = shard(text).value_or(Shard()); },
         "Only share I of N of the labels, I from 0 to N - 1: they are dealt out by size, the same "
         "on every machine; a share may be empty, which is no failure")
      ->type_name("I/N")
      ->check(CLI::Validator(complain_of_shard, ""));
  sub.add_flag("--skip-existing", command.skip_existing,
               "Leave files that are there as they are, and make nothing of labels whose files all "
               "are: a job that was killed is just started again");
}

/// Adds `loft reconstruct`; the command is ready when the line has been parsed.
CLI::App* add_reconstruct(CLI::App& app, ReconstructCommand& command) {
  CLI::App* sub = app.add_subcommand("reconstruct", "Make closed surfaces from stacks of contours");
  sub->add_option("IN", command.inputs, "Stack files, or - for standard input")->required();
  begin_group(*sub, results);
  sub->add_option("-o,--output", command.outputs,
                  "Output file, " + loft::io::surface_extensions() +
                      "; may be repeated; '{label}' in its name: a file a label; "
                      "precomputed://FOLDER: meshes for Neuroglancer")
      ->required()
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_option("--unit", command.unit,
                  "Unit of the input, for glTF's metres (default: what the stack says, or mm): " +
                      std::string(io::unit_names))
      ->type_name("UNIT")
      ->check(CLI::Validator(complain_of_unit, ""));
  sub->add_option("--csv", command.volumes,
                  "Write a table of volumes: label, slices, contours, cm^3 and the unit's, area")
      ->type_name("FILE");
  sub->add_flag("--strict", command.strict,
                "Exit with 3 if no surface could be made of a label (the others are written)");
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout");
  sub->add_flag("--list-slabs", command.slabs, "List all slabs and their links in it");
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
  sub->add_option_function<std::string>(
         "--format", [&command](const std::string&) { command.is_neuroglancer = true; },
         "Outputs are folders of meshes for Neuroglancer (neuroglancer), as precomputed://OUT; "
         "otherwise their names say what they are")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"neuroglancer"}));
  add_label_options(*sub, command.only, command.except);
  add_job_options(*sub, command);
  add_read_options(*sub, command.read);
  sub->add_flag_callback(
      "--merge", [&command] { command.read.unlabelled = io::Unlabelled::keep; },
      "Several files are one stack; otherwise contours without a label take the name of "
      "their file");
  sub->add_option("--height-tolerance", command.options.height_tolerance,
                  "Heights that differ by no more than that share of the least proper gap are one "
                  "(default 1e-4; 0: only equal ones)")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 0.1));
  add_slice_options(*sub, command.options, &command.read.fill);
  add_slab_options(*sub, command.options);
  sub->add_option("--links", command.links,
                  "Contours to join or to keep apart: a line {\"from\": [slice, contour], "
                  "\"to\": [slice, contour], \"link\": true or false} each")
      ->type_name("FILE");
  add_triangle_options(*sub, command.options);
  add_gltf_options(*sub, command);
  begin_group(*sub, "Time and memory");
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
         "--slabs", [&command](const std::string& text) { command.range = slab_choice(text); },
         "Only the slabs from slice A up to slice B, counted by height from 0, out of core: a part "
         "for 'loft join', so that several jobs or machines share one stack. Looks at " +
             std::to_string(slices_beside_range) + " slices more on either side")
      ->type_name("A..B")
      ->check(CLI::Validator(complain_of_slabs, ""));
  sub->footer(
      "Examples:\n"
      "  A plan: the organs at risk, a file each, their volumes as the planning system has them\n"
      "    loft reconstruct plan.dcm -o '{label}.stl' --except 'PTV*' --cap extend --csv v.csv\n"
      "  A segmentation: all labels in their colours, rounded between the slices\n"
      "    loft reconstruct labels.nii.gz -o labels.glb --smooth\n"
      "  The same for a page on the web, its background not shown at first\n"
      "    loft reconstruct labels.nii.gz -o labels.glb --smooth --compress meshopt --hide body\n"
      "  Traced sections, in micrometres\n"
      "    loft reconstruct dendrite.jser -o dendrite.glb --only 'd0*' --unit um\n"
      "  The layers of a part, for printing or simulation\n"
      "    loft reconstruct part.cli -o part.stl --simplify 0.01\n"
      "  Scanned cross-sections in space, with even triangles\n"
      "    loft reconstruct points.csv -o hull.ply --target-edge 2\n"
      "  One huge stack by two jobs, anywhere and in any order; then as one file\n"
      "    loft reconstruct block.ndjson --slabs ..500 -o low.ply\n"
      "    loft reconstruct block.ndjson --slabs 500.. -o high.ply\n"
      "    loft join low.ply high.ply -o block.ply\n"
      "  One of a hundred jobs that make a mesh of each label for Neuroglancer\n"
      "    loft reconstruct cells.nrrd -o precomputed://meshes --shard 7/100 --skip-existing\n"
      "\n"
      "For schedulers: 0 is success, of a shard without labels, too; after 2 and 3 (usage, bad "
      "input)\nthe same job fails again; after 4 (cannot write: a full disk) and 130 (SIGINT, "
      "SIGTERM,\nSIGHUP) start it again with --skip-existing. Whatever ends a job, its files are "
      "whole or not\nthere; files of one label ({label}, Neuroglancer) are written as it is made.");
  return sub;
}

/// Adds `loft convert`; the command is ready when the line has been parsed.
CLI::App* add_convert(CLI::App& app, ConvertCommand& command) {
  CLI::App* sub = app.add_subcommand("convert", "Write a stack of any format as another one");
  sub->add_option("IN", command.inputs, "Stack files, or - for standard input")->required();
  begin_group(*sub, results);
  sub->add_option("-o,--output", command.output,
                  "Output file, " + loft::io::stack_writer_extensions())
      ->required()
      ->type_name("OUT");
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
  add_label_options(*sub, command.only, command.except);
  add_read_options(*sub, command.read);
  begin_group(*sub, "Slices");
  add_fair_option(*sub, command.fair);
  sub->footer(
      "Examples:\n"
      "  The lungs of a plan, with all that the file says of them\n"
      "    loft convert plan.dcm -o lungs.ndjson --only 'Lung*'\n"
      "  Outlines of a mask, for a table\n"
      "    loft convert labels.nii.gz -o outlines.csv\n"
      "  Traced sections for programs of papers, or layers for a printer\n"
      "    loft convert cell.mod -o cell.contour\n"
      "    loft convert part.ndjson -o part.cli");
  return sub;
}

/// Adds `loft join`; the command is ready when the line has been parsed.
CLI::App* add_join(CLI::App& app, JoinCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "join", "Join the parts that reconstruct --slabs made of one stack, in any order");
  sub->add_option("PART", command.parts, "Parts, PLY files that have all slabs of the stack once")
      ->required();
  begin_group(*sub, results);
  sub->add_option("-o,--output", command.output,
                  "PLY file: the same bytes as of the whole stack at once")
      ->required()
      ->type_name("OUT");
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout");
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
  sub->footer(
      "Parts say what stack and options they are of; those that do not fit, are missing, twice "
      "there\n"
      "or damaged are named, and nothing is written. Memory does not grow with the parts.\n"
      "Examples:\n"
      "  loft reconstruct block.ndjson --slabs ..500 -o low.ply\n"
      "  loft reconstruct block.ndjson --slabs 500.. -o high.ply\n"
      "  loft join low.ply high.ply -o block.ply");
  return sub;
}

/// Adds `loft slice`; the command is ready when the line has been parsed.
CLI::App* add_slice(CLI::App& app, SliceCommand& command) {
  CLI::App* sub = app.add_subcommand("slice", "Cut a mesh into a stack of outlines");
  sub->add_option("MESH", command.mesh, "Mesh file, " + loft::io::mesh_extensions())->required();
  sub->add_option("-o,--output", command.output,
                  "Output file, " + loft::io::stack_writer_extensions())
      ->required()
      ->type_name("OUT");
  CLI::Option* const gap =
      sub->add_option("--gap", command.gap, "Distance between slices, the first half of it inside")
          ->type_name("LENGTH")
          ->check(CLI::Validator(complain_of_length, ""));
  CLI::Option* const heights =
      sub->add_option("--heights", command.heights, "Heights of the slices, in any order")
          ->type_name("Z,...")
          ->delimiter(',')
          ->allow_extra_args(false);
  gap->excludes(heights);
  sub->add_option_function<std::string>(
         "--normal", [&command](const std::string& text) { command.normal = *direction(text); },
         "Direction that slices are across and heights along (default 0,0,1)")
      ->type_name("X,Y,Z")
      ->check(CLI::Validator(complain_of_direction, ""));
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
  sub->footer(
      "Examples:\n"
      "  loft slice bunny.ply -o bunny.ndjson --gap 0.5\n"
      "  loft slice part.stl -o part.ndjson --heights 1,2.5,4 --normal 1,0,1");
  return sub;
}

/// Options of commands that serve.
template <class Command>
void add_address_options(CLI::App& sub, Command& command) {
  begin_group(sub, server);
  sub.add_option("--host", command.host,
                 "Address to listen on (default 127.0.0.1: this machine only; 0.0.0.0: anyone who "
                 "can reach it)")
      ->type_name("ADDRESS");
  begin_group(sub, results);
  sub.add_option(
         "--unit", command.unit,
         "Unit of the input, for glTF's metres (default mm): " + std::string(io::unit_names))
      ->type_name("UNIT")
      ->check(CLI::Validator(complain_of_unit, ""));
  sub.add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
}

/// Adds `loft stream`; the command is ready when the line has been parsed.
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
  begin_group(*sub, results);
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
  begin_group(*sub, server);
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

/// Adds `loft view`; the command is ready when the line has been parsed.
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
  begin_group(*sub, server);
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

/// Adds `loft live`; the command is ready when the line has been parsed.
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
  begin_group(*sub, server);
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
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
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

/// Adds `loft triangulate`; the command is ready when the line has been parsed.
CLI::App* add_triangulate(CLI::App& app, TriangulateCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "triangulate", "Make the constrained Delaunay triangulation of polylines and polygons");
  sub->add_option("IN", command.inputs, "Polyline files, or - for standard input")->required();
  begin_group(*sub, results);
  sub->add_option("-o,--output", command.outputs,
                  "Output file, " + loft::io::triangulation_extensions() + "; may be repeated")
      ->required()
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_option("--epsilon", command.epsilon,
                  "Points and polylines closer than that become one, default 0")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(complain_of_epsilon, ""));
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout");
  sub->add_flag("-q,--quiet", command.quiet, "Say nothing but errors");
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

/// Adds `loft check`; the command is ready when the line has been parsed.
CLI::App* add_check(CLI::App& app, CheckCommand& command) {
  CLI::App* sub =
      app.add_subcommand("check",
                         "Tell whether meshes bound valid solids: closed, manifold, oriented, no "
                         "degenerate face, no self-intersection; exit code 1 if one does not");
  sub->add_option("MESH", command.meshes, "Mesh files, " + loft::io::mesh_extensions())->required();
  sub->add_option("--stack", command.stack,
                  "Also: is every contour vertex and edge of this stack in each mesh, exactly?")
      ->type_name("FILE");
  sub->add_option("--within", command.within,
                  "Contour vertices may have been moved in their slices by at most that, as "
                  "reconstruct --fair does; default 0: exactly")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(complain_of_distance, ""));
  sub->add_flag("--json", command.json, "Print the result as one JSON object; a list of several");
  add_read_options(*sub, command.read);
  sub->footer(
      "Examples:\n"
      "  loft check part.stl\n"
      "  loft check skull.ply --stack skull.ndjson\n"
      "  loft check faired.ply --stack traced.ndjson --within 0.2");
  return sub;
}

/// Adds `loft info`; the command is ready when the line has been parsed.
CLI::App* add_info(CLI::App& app, InfoCommand& command) {
  CLI::App* sub =
      app.add_subcommand("info", "Show counts, bounds, gaps, labels and volumes of files");
  sub->add_option("FILE", command.files, "Stacks or meshes")->required();
  begin_group(*sub, results);
  sub->add_flag_callback(
      "--no-volumes", [&command] { command.volumes = false; },
      "Leave out the volumes of labels, which take as long as their surfaces");
  sub->add_flag("--json", command.json, "Print the result as one JSON object; a list of several");
  add_read_options(*sub, command.read);
  sub->footer(
      "A volume is what the surface encloses; as slabs, each slice is as thick as its gap, as\n"
      "planning systems and counts of voxels have it (--cap extend makes such a surface).\n\n"
      "Examples:\n"
      "  loft info plan.dcm\n"
      "  loft info stack.tif --spacing 0.1,0.1,0.5\n"
      "  loft info part.cli part.stl");
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

/// Notes which of a session's settings the command line names, and what makes no sense in it.
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
