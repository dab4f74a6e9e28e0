// SPDX-License-Identifier: MIT
#include "app/options/stack_commands.h"

#include <CLI/CLI.hpp>
#include <string>

#include "app/commands/out_of_core.h"
#include "app/commands/shard.h"
#include "app/options/complaints.h"
#include "app/options/shared_options.h"
#include "io/meshes.h"
#include "io/stack.h"
#include "io/stack_writer.h"
#include "io/surfaces.h"
#include "io/unit.h"
#include "reconstruct/out_of_core.h"

namespace loft::app {

namespace {

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

}  // namespace

CLI::App* add_reconstruct(CLI::App& app, ReconstructCommand& command) {
  CLI::App* sub = app.add_subcommand("reconstruct", "Make closed surfaces from stacks of contours");
  sub->add_option("IN", command.inputs, "Stack files, or - for standard input")->required();
  begin_group(*sub, results_heading);
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
  add_report_option(*sub, command.json);
  sub->add_flag("--list-slabs", command.slabs, "List all slabs and their links in it");
  add_quiet_option(*sub, command.quiet);
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

CLI::App* add_convert(CLI::App& app, ConvertCommand& command) {
  CLI::App* sub = app.add_subcommand("convert", "Write a stack of any format as another one");
  sub->add_option("IN", command.inputs, "Stack files, or - for standard input")->required();
  begin_group(*sub, results_heading);
  sub->add_option("-o,--output", command.output,
                  "Output file, " + loft::io::stack_writer_extensions())
      ->required()
      ->type_name("OUT");
  add_quiet_option(*sub, command.quiet);
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

CLI::App* add_join(CLI::App& app, JoinCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "join", "Join the parts that reconstruct --slabs made of one stack, in any order");
  sub->add_option("PART", command.parts, "Parts, PLY files that have all slabs of the stack once")
      ->required();
  begin_group(*sub, results_heading);
  sub->add_option("-o,--output", command.output,
                  "PLY file: the same bytes as of the whole stack at once")
      ->required()
      ->type_name("OUT");
  add_report_option(*sub, command.json);
  add_quiet_option(*sub, command.quiet);
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
  add_quiet_option(*sub, command.quiet);
  sub->footer(
      "Examples:\n"
      "  loft slice bunny.ply -o bunny.ndjson --gap 0.5\n"
      "  loft slice part.stl -o part.ndjson --heights 1,2.5,4 --normal 1,0,1");
  return sub;
}

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

CLI::App* add_info(CLI::App& app, InfoCommand& command) {
  CLI::App* sub =
      app.add_subcommand("info", "Show counts, bounds, gaps, labels and volumes of files");
  sub->add_option("FILE", command.files, "Stacks or meshes")->required();
  begin_group(*sub, results_heading);
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

}  // namespace loft::app
