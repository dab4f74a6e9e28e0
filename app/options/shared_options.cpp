// SPDX-License-Identifier: MIT
#include "app/options/shared_options.h"

#include <CLI/CLI.hpp>

#include "app/options/complaints.h"

namespace loft::app {

void begin_group(CLI::App& sub, const std::string& heading) {
  sub.option_defaults()->group(heading);
}

void add_quiet_option(CLI::App& sub, bool& quiet) {
  sub.add_flag("-q,--quiet", quiet, "Say nothing but errors");
}

void add_report_option(CLI::App& sub, bool& json) {
  sub.add_flag("--json", json, "Print a report as one JSON object on stdout");
}

void add_label_options(CLI::App& sub, std::vector<std::string>& only,
                       std::vector<std::string>& except) {
  begin_group(sub, "Labels");
  sub.add_option("--only", only,
                 "Only labels of that name, or like a pattern with * and ?; may be repeated; "
                 "@FILE: a name a line")
      ->type_name("LABEL")
      ->allow_extra_args(false);
  sub.add_option("--except", except, "No labels of that name, or like that pattern")
      ->type_name("LABEL")
      ->allow_extra_args(false);
}

void add_read_options(CLI::App& sub, io::ReadOptions& options) {
  begin_group(sub, "Reading");
  sub.add_option_function<std::string>(
         "--spacing", [&options](const std::string& text) { options.spacing = spacing(text); },
         "Distances between pixel centres and between slices, for images that do not say them")
      ->type_name("X,Y,Z")
      ->check(CLI::Validator(complain_of_spacing, ""));
  sub.add_option_function<std::string>(
         "--outline",
         [&options](const std::string& outline) {
           options.outline = outline == "iso"     ? io::Outline::iso_lines
                             : outline == "edges" ? io::Outline::edges
                                                  : io::Outline::fair;
         },
         "How masks are outlined: half way between pixel centres (iso, default), along the pixels' "
         "edges (edges), or as smooth as can be with the same pixel centres and the same area "
         "inside (fair)")
      ->type_name("RULE")
      ->check(CLI::IsMember({"iso", "edges", "fair"}));
  sub.add_option("--level", options.level,
                 "Value that pixels of grey have inside at least (otherwise each value is a label, "
                 "or from 0.5 on where they are shares of 1)")
      ->type_name("VALUE");
  sub.add_option("--z-property", options.z_property,
                 "Property of GeoJSON that heights are in (default: ELEV, elevation, z, ...)")
      ->type_name("NAME");
  sub.add_option_function<std::string>(
         "--close",
         [&options](const std::string&) { options.open_lines = io::OpenLines::close_along_border; },
         "Close isolines that end at the border of the data along it (border); otherwise they are "
         "refused")
      ->type_name("RULE")
      ->check(CLI::IsMember({"border"}));
  sub.add_option("--alignment", options.alignment,
                 "Which alignment of the sections of a .jser file (default: the current one)")
      ->type_name("NAME");
}

void add_slice_options(CLI::App& sub, Options& options, std::optional<Fill>* given_fill) {
  begin_group(sub, "Slices");
  sub.add_option_function<std::string>(
         "--fill",
         [&options, given_fill](const std::string& fill) {
           options.fill = fill == "nonzero"   ? Fill::nonzero
                          : fill == "evenodd" ? Fill::even_odd
                                              : Fill::keyhole_aware;
           if (given_fill != nullptr) *given_fill = options.fill;
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
  sub.add_option(
         "--tolerance", options.tolerance,
         "Contours of a slice that run along each other all the way round within that share "
         "of its width are one (default 1e-7; 0: only equal ones)")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 0.01));
  add_fair_option(sub, options.fair);
  sub.add_option_function<std::string>(
         "--cap",
         [&options](const std::string& cap) {
           options.cap = cap == "flat"     ? Cap::flat
                         : cap == "dome"   ? Cap::dome
                         : cap == "extend" ? Cap::extend
                                           : Cap::open;
         },
         given_fill == nullptr
             ? "What closes the first and last slice (default flat)"
             : "What closes the first and last slice (default flat); extend: they go on for half "
               "a gap, as slices of planning systems and voxels do")
      ->type_name("CAP")
      ->check(given_fill == nullptr ? CLI::IsMember({"flat", "dome", "open"})
                                    : CLI::IsMember({"flat", "dome", "open", "extend"}));
}

void add_fair_option(CLI::App& sub, std::optional<double>& distance) {
  sub.add_option(
         "--fair", distance,
         "Smooth jitter and stairs of contours in their slices: move their points by at most "
         "that, in the unit of the input; areas stay, and nothing meets that did not")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(complain_of_distance, ""));
}

void add_slab_options(CLI::App& sub, Options& options) {
  begin_group(sub, "From slice to slice");
  sub.add_option_function<std::string>(
         "--link",
         [&options](const std::string& link) {
           options.link = link == "auto"      ? LinkRule::automatic
                          : link == "overlap" ? LinkRule::overlap
                                              : LinkRule::none;
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
  sub.add_option_function<double>(
         "--smooth-tolerance",
         [&options](double distance) {
           options.smooth = true;
           options.smooth_tolerance = distance;
         },
         "How near triangles come to the smooth surface, in the unit of the input; the larger, the "
         "fewer there are (default 0: by what the slices tell, 1.4% of their gap). Means --smooth")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(complain_of_distance, ""));
}

void add_triangle_options(CLI::App& sub, Options& options) {
  begin_group(sub, "Triangles");
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

}  // namespace loft::app
