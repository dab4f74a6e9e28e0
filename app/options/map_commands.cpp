// SPDX-License-Identifier: MIT
#include "app/options/map_commands.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "app/options/complaints.h"
#include "app/options/shared_options.h"
#include "io/fields.h"
#include "io/maps.h"
#include "io/points.h"
#include "io/scenes.h"
#include "io/tables.h"

namespace loft::app {

namespace {

/// `even-odd` and `evenodd` are the same.
std::string without_hyphens(std::string text) {
  std::erase(text, '-');
  return text;
}

void add_layer_option(CLI::App& sub, std::optional<std::string>& property,
                      const std::string& text) {
  sub.add_option("--layer-by", property, text)->type_name("NAME");
}

void add_width_option(CLI::App& sub, io::SvgOptions& drawing) {
  begin_group(sub, "Drawing (SVG)");
  sub.add_option("--width", drawing.width, "Width in pixels, default 1200")
      ->type_name("PIXELS")
      ->check(CLI::Range(10.0, 100'000.0));
}

void add_fill_option(CLI::App& sub, overlay::FillRule& fill) {
  using overlay::FillRule;
  static const std::map<std::string, FillRule> rules{{"evenodd", FillRule::even_odd},
                                                     {"nonzero", FillRule::nonzero},
                                                     {"positive", FillRule::positive},
                                                     {"negative", FillRule::negative}};
  sub.add_option_function<std::string>(
         "--fill", [&fill](const std::string& rule) { fill = rules.at(without_hyphens(rule)); },
         "What the rings of a layer enclose, by how often they wind around it: an odd number of "
         "times (evenodd, default; directions do not matter), any but 0 (nonzero), more often "
         "counter-clockwise (positive) or clockwise (negative)")
      ->type_name("RULE")
      ->check(CLI::IsMember({"evenodd", "nonzero", "positive", "negative"}, without_hyphens));
}

void add_conflict_option(CLI::App& sub, fields::OnConflict& on_conflict) {
  using fields::OnConflict;
  static const std::map<std::string, OnConflict> ways{
      {"mean", OnConflict::mean}, {"first", OnConflict::first}, {"refuse", OnConflict::refuse}};
  sub.add_option_function<std::string>(
         "--on-conflict", [&on_conflict](const std::string& way) { on_conflict = ways.at(way); },
         "What becomes of different values at one place: their mean (default), the one that comes "
         "first, or an error that lists all such places (refuse)")
      ->type_name("WAY")
      ->check(CLI::IsMember({"mean", "first", "refuse"}));
}

}  // namespace

CLI::App* add_overlay(CLI::App& app, OverlayCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "overlay", "Unite, intersect and subtract the polygons of maps; all their pieces and areas");
  sub->add_option("IN", command.inputs,
                  "Map files, " + io::map_extensions() + ", or - for standard input")
      ->required();
  begin_group(*sub, "Layers");
  add_layer_option(*sub, command.layer_by,
                   "A layer for each value of that property, not for each file; files have no "
                   "value in common");
  add_fill_option(*sub, command.fill);
  begin_group(*sub, results_heading);
  sub->add_option("--keep", command.keep,
                  "What is wanted: layers by their names and a | b, a & b, a - b, a ^ b, ~a, "
                  "at_least(2, a, b, c), exactly(1, a, b), parentheses; names in double quotes "
                  "unless they are letters, digits, _ and .")
      ->type_name("EXPRESSION");
  sub->add_flag("--all-pieces", command.all_pieces,
                "Write each set of layers that cover something, with the property layers, instead "
                "of one result; with --keep those inside it");
  sub->add_flag("--areas", command.areas, "Print the areas of layers and result");
  sub->add_option("-o,--output", command.outputs,
                  "Output file, " + io::map_output_extensions() + "; may be repeated")
      ->type_name("OUT")
      ->allow_extra_args(false);
  add_report_option(*sub, command.json);
  add_quiet_option(*sub, command.quiet);
  add_width_option(*sub, command.drawing);
  sub->footer(
      "A file's layer is called as the file is, without folder and extension.\n"
      "Polygons that come out are valid: simple rings, outer ones counter-clockwise.\n\n"
      "Examples:\n"
      "  loft overlay parks.geojson lakes.geojson --keep 'parks - lakes' -o land.geojson\n"
      "  loft overlay world.geojson --layer-by name --all-pieces -o pieces.geojson -o pieces.svg\n"
      "  loft overlay plan-a.geojson plan-b.geojson --keep '\"plan-a\" & \"plan-b\"' --areas");
  return sub;
}

CLI::App* add_coverage(CLI::App& app, CoverageCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "coverage", "Find and mend overlaps and gaps of a map whose areas should belong to one each");
  sub->add_option("MAP", command.map,
                  "Map file, " + io::map_extensions() + ", or - for standard input")
      ->required();
  begin_group(*sub, "Faults");
  sub->add_flag("--check", command.check, "Exit with 1 if there is an overlap or a gap");
  sub->add_option_function<std::string>(
         "--clean",
         [&command](const std::string& heir) {
           command.clean = heir == "first" ? overlay::Heir::first : overlay::Heir::longest_border;
         },
         "Mend the map: an overlap goes to that one of its areas, a narrow gap to that one around "
         "it, with the longest border to it, or to the first in the map")
      ->type_name("HEIR")
      ->check(CLI::IsMember({"longest-border", "first"}));
  sub->add_option("--gap-width", command.gap_width,
                  "Gaps in which a disc of that diameter has room are seas, no faults; without it "
                  "all gaps are listed, and none is mended")
      ->type_name("LENGTH")
      ->check(CLI::Validator(complain_of_length, ""));
  add_layer_option(*sub, command.layer_by,
                   "Features with the same value of that property are one area (default: each is "
                   "one, called by its name, or number)");
  begin_group(*sub, results_heading);
  sub->add_flag("--borders", command.borders, "Print who shares a border, and how long it is, too");
  sub->add_option("-o,--output", command.outputs,
                  "Output file: .csv, the table of faults; " + io::map_output_extensions() +
                      ", the mended map, without --clean the faults; may be repeated")
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_flag("--json", command.json, "Print a report as one JSON object instead of the table");
  add_quiet_option(*sub, command.quiet);
  add_width_option(*sub, command.drawing);
  sub->footer(
      "What one area alone claims stays its own, with its properties.\n\n"
      "Examples:\n"
      "  loft coverage parcels.geojson --check --gap-width 0.5\n"
      "  loft coverage world.geojson --clean longest-border --gap-width 0.01 -o clean.geojson");
  return sub;
}

CLI::App* add_query(CLI::App& app, QueryCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "query", "Tell which areas of a map points are in, and how far lines run through each");
  sub->add_option("MAP", command.map,
                  "Map file, " + io::map_extensions() + ", or - for standard input")
      ->required();
  CLI::Option* const points =
      sub->add_option("--points", command.points,
                      "Table of points, " + io::points_extensions() +
                          ": columns x and y, or lon and lat, or the first two")
          ->type_name("FILE");
  sub->add_option("--lines", command.lines, "Lines, " + io::map_extensions())
      ->type_name("FILE")
      ->excludes(points);
  add_layer_option(*sub, command.layer_by,
                   "Areas are called by that property, and one if it is the same (default: name, "
                   "or the feature's number)");
  begin_group(*sub, results_heading);
  sub->add_option("-o,--output", command.outputs,
                  "Output file, .csv; of lines " + io::map_output_extensions() +
                      ", too (.svg: over the map); may be repeated; standard output without it")
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout instead");
  add_quiet_option(*sub, command.quiet);
  add_width_option(*sub, command.drawing);
  sub->footer(
      "Of points: x, y, the areas that they are inside of, those on whose border they are.\n"
      "Of lines: a row for each of those with the length there; .geojson has the pieces.\n"
      "Several names are parted by semicolons.\n\n"
      "Examples:\n"
      "  loft query world.geojson --points towns.csv -o countries.csv\n"
      "  loft query world.geojson --lines rivers.geojson -o lengths.csv -o pieces.geojson");
  return sub;
}

CLI::App* add_path(CLI::App& app, PathCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "path", "Find shortest paths among obstacles, for points and discs, while obstacles move");
  sub->add_option("SCENE", command.scene,
                  "Scene file, " + io::scene_extensions() + ", or - for standard input")
      ->required();
  begin_group(*sub, "Queries");
  const auto add_place = [&](const char* name, std::optional<cdt::Point>& end,
                             const std::string& text) {
    return sub
        ->add_option_function<std::string>(
            name, [&end](const std::string& given) { end = place(given); }, text)
        ->type_name("X,Y")
        ->check(CLI::Validator(complain_of_place, ""));
  };
  CLI::Option* const from = add_place("--from", command.from, "Where the path starts");
  CLI::Option* const to = add_place("--to", command.to, "Where it ends");
  sub->add_option("--queries", command.queries,
                  "Table of queries, a path each, " + io::path_query_extensions() +
                      ": columns x0, y0, x1, y1 and, if there is one, radius")
      ->type_name("FILE")
      ->excludes(from)
      ->excludes(to);
  sub->add_option("--radius", command.radius,
                  "The centre of a disc of that radius moves, default 0: a point")
      ->type_name("LENGTH")
      ->check(CLI::Validator(complain_of_distance, ""));
  sub->add_option("--most-expansions", command.most_expansions,
                  "Give up a search that takes more steps than that")
      ->type_name("NUMBER")
      ->check(CLI::PositiveNumber);
  begin_group(*sub, "Scene");
  add_layer_option(*sub, command.layer_by,
                   "The property that says which layer a polygon is in (default: layer); those "
                   "without it are in the layer obstacles");
  sub->add_option("--free", command.free,
                  "What is free, an expression over layers as overlay --keep has it; frame is the "
                  "box around everything, a tenth larger (default: the layer free, or else frame, "
                  "less all other layers)")
      ->type_name("EXPRESSION");
  sub->add_option("--moves", command.moves,
                  "Edits of the scene, " + io::scene_edit_extensions() +
                      ", one a line; after each the paths are found anew")
      ->type_name("FILE");
  begin_group(*sub, results_heading);
  sub->add_option("-o,--output", command.outputs,
                  "Output file: .csv, a table; .geojson .json, lines with their status and length; "
                  ".svg, a picture of the scene with the paths; may be repeated; the table on "
                  "standard output without it")
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout instead");
  add_quiet_option(*sub, command.quiet);
  add_width_option(*sub, command.drawing);
  sub->footer(
      "Polygons are obstacles unless a layer says otherwise, and lines are walls. Paths may touch\n"
      "them, but a passage without width is closed. A path is found, unreachable, start blocked,\n"
      "goal blocked or, with --most-expansions, gave up. Exit code 1 if --from and --to find none\n"
      "(after the last edit).\n\n"
      "Edits name features by their id, or property name:\n"
      "  {\"move\": \"box7\", \"by\": [1, 0.5]}\n"
      "  {\"ring\": \"box7\", \"points\": [[0, 0], [2, 0], [1, 1]]}\n"
      "  {\"remove\": \"box7\"}\n"
      "  {\"insert\": {\"id\": \"box8\", \"layer\": \"obstacles\", \"points\": [[0, 0], ...]}}\n"
      "  {\"insert\": {\"id\": \"door\", \"line\": [[0, 0], [0, 2]]}}\n\n"
      "Of a disc's path around a corner, files other than .svg have chords of the arc, nowhere\n"
      "farther from it than a thousandth of the radius.\n\n"
      "Examples:\n"
      "  loft path town.geojson --from 1,2 --to 30,40 --radius 0.5 -o way.geojson -o way.svg\n"
      "  loft path arena.map --queries arena.scen -o paths.csv\n"
      "  loft path room.geojson --queries agents.csv --moves boxes.ndjson -o paths.geojson");
  return sub;
}

CLI::App* add_classify(CLI::App& app, ClassifyCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "classify", "Tell on which side of each of several lines points are; how many are where");
  sub->add_option(
         "POINTS", command.points,
         "Table of points, " + io::point_table_extensions() +
             ", or - for standard input: columns x and y, or lon and lat, or the first two")
      ->required();
  sub->add_option("--separators", command.separators,
                  "Lines, " + io::map_extensions() +
                      "; each divides the plane: its ends go on straight to infinity")
      ->type_name("FILE")
      ->required();
  sub->add_option(
         "--value", command.value,
         "The column that is summed by class, and makes points darker in pictures (default: "
         "value, z or weight, if there is one; else the sum of x and y makes them darker)")
      ->type_name("NAME");
  begin_group(*sub, results_heading);
  sub->add_option(
         "-o,--output", command.outputs,
         "Output file: .csv, the table with a column class; .geojson .json, its points with "
         "a property class; .svg, a picture of points, lines and classes; may be repeated")
      ->type_name("OUT")
      ->allow_extra_args(false);
  sub->add_flag("--json", command.json, "Print a report as one JSON object instead of the table");
  add_quiet_option(*sub, command.quiet);
  add_width_option(*sub, command.drawing);
  sub->footer(
      "A class is left, right or on for each line, in their order, parted by semicolons. Of a "
      "line\n"
      "that crosses itself, left is what it winds around counter-clockwise if it is closed far "
      "out\n"
      "from its last end counter-clockwise to its first: loops change nothing.\n\n"
      "Examples:\n"
      "  loft classify people.csv --separators criteria.geojson -o classes.csv -o classes.svg\n"
      "  loft classify samples.csv --separators faults.geojson --value height --json");
  return sub;
}

CLI::App* add_field(CLI::App& app, FieldCommand& command) {
  CLI::App* sub = app.add_subcommand(
      "field",
      "Lay a surface through values at points and along lines: ask it, draw it, measure it");
  sub->add_option(
         "SAMPLES", command.samples,
         "Table of points, " + io::point_table_extensions() +
             ", or - for standard input: columns x and y, or lon and lat, or the first two")
      ->required();
  sub->add_option("--value", command.value,
                  "The column with the values (default: value, z, height or elevation; without a "
                  "header the third)")
      ->type_name("NAME");
  sub->add_option("--lines", command.lines,
                  "Lines, " + io::field_line_extensions() +
                      ": a property kind is feature, soft, wall or barrier, see below")
      ->type_name("FILE");
  add_conflict_option(*sub, command.on_conflict);
  sub->add_flag_callback(
      "--smooth", [&command] { command.smoothness = fields::Smoothness::cubic; },
      "Bend the surface smoothly (cubic) but at features, walls and barriers; isolines, bands, "
      "volumes and .ply are of the flat triangles");
  sub->add_flag_callback(
      "--nearest", [&command] { command.outside = fields::Outside::nearest; },
      "Beyond all samples, --at has the value of the nearest place of the surface, not none");
  begin_group(*sub, "Questions");
  CLI::Option* const at =
      sub->add_option("--at", command.at,
                      "Places to ask at, a table, " + io::point_table_extensions())
          ->type_name("FILE");
  CLI::Option* const profile =
      sub->add_option("--profile", command.profile,
                      "Lines to go along, " + io::map_extensions() +
                          ": the values wherever they cross an edge of a triangle")
          ->type_name("FILE")
          ->excludes(at);
  CLI::Option* const isolines =
      sub->add_option("--isolines", command.isolines,
                      "Isolines at about so many round levels (pictures have 20 without it)")
          ->type_name("NUMBER")
          ->check(CLI::Range(1, 10'000))
          ->excludes(at)
          ->excludes(profile);
  sub->add_option("--levels", command.levels,
                  "Isolines at these levels instead, with commas between")
      ->type_name("LEVEL,...")
      ->delimiter(',')
      ->check(CLI::Validator(complain_of_value, ""))
      ->excludes(isolines)
      ->excludes(at)
      ->excludes(profile);
  sub->add_flag("--bands", command.bands, "The polygons between the levels instead of the lines");
  sub->add_option("--level", command.level, "Tell the volume over that level and under it")
      ->type_name("LEVEL")
      ->check(CLI::Validator(complain_of_value, ""));
  begin_group(*sub, results_heading);
  sub->add_option(
         "-o,--output", command.outputs,
         "Output file: .csv, the table of --at or --profile; .geojson .json, its points, or "
         "isolines or bands; " +
             io::field_output_extensions() +
             ", a grid of values, the surface, pictures; may be repeated; the table on "
             "standard output without it")
      ->type_name("OUT")
      ->allow_extra_args(false);
  CLI::Option* const grid =
      sub->add_option_function<std::string>(
             "--grid", [&command](const std::string& text) { command.grid = grid_size(text); },
             "Of .asc and .png: at most so many columns and rows, default of .png 1000x1000")
          ->type_name("COLUMNSxROWS")
          ->check(CLI::Validator(complain_of_grid_size, ""));
  sub->add_option("--cell", command.cell, "Or cells of that width")
      ->type_name("LENGTH")
      ->check(CLI::Validator(complain_of_distance, ""))
      ->excludes(grid);
  sub->add_flag("--json", command.json, "Print a report as one JSON object on stdout instead");
  add_quiet_option(*sub, command.quiet);
  add_width_option(*sub, command.drawing);
  sub->add_flag("--triangles", command.triangles, "Draw the triangles, too");
  sub->footer(
      "Lines: a feature has a value at each point (third coordinates, or the property values, a\n"
      "number or a list) and makes a crease; a soft line lies on the surface that is there "
      "without\n"
      "it; a wall has the properties left and right, and the surface jumps; nothing crosses a\n"
      "barrier: each side is as if the other one's values were not there. Without kind, lines "
      "with\n"
      "left and right are walls, those with values features, others soft.\n\n"
      "Examples:\n"
      "  loft field heights.csv --lines faults.geojson -o ground.svg -o ground.ply\n"
      "  loft field heights.csv --at wells.csv --smooth -o wells-with-heights.csv\n"
      "  loft field heights.csv --profile road.geojson -o profile.csv\n"
      "  loft field rain.csv --cell 250 --smooth -o rain.asc -o rain.png\n"
      "  loft field heights.csv --levels 100,200,300 --bands -o bands.geojson --level 150");
  return sub;
}

}  // namespace loft::app
