// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/commands.h"
#include "app/report.h"
#include "mesh/measure.h"
#include "reconstruct/defect.h"
#include "reconstruct/link/link_report.h"
#include "reconstruct/surface.h"

namespace loft::app {

/// What cleaning did, in all and slice by slice.
struct CleaningSummary {
  struct Slice {
    std::uint32_t slice = 0;  ///< index in the input
    double z = 0;
    std::size_t repairs = 0;
    double area = 0;
  };
  double area = 0;                            ///< sum of the repairs' areas
  std::map<std::string, std::size_t> counts;  ///< by kind of repair
  std::vector<Slice> slices;                  ///< those with repairs, by height
};

[[nodiscard]] CleaningSummary summarize(const std::vector<Defect>& repairs);
/// `cleaning: 2 overlap, 1 spike in 3 slices; area in question 4.5 mm^2, most in slice 7 (z = 3.5):
/// 4 mm^2`
[[nodiscard]] std::string describe(const CleaningSummary& summary, std::string_view unit);

/// One reconstructed label.
struct PartReport {
  std::string label;
  StackSize input;
  Measures measures;
  double slab_volume = 0;                         ///< see Reconstructed
  std::array<std::size_t, 4> vertices_of_kind{};  ///< by VertexKind
  std::vector<Defect> repairs;
  std::vector<SlabReport> slabs;
  std::map<std::string, double> seconds;  ///< of each stage, by name(Stage); total
  std::size_t peak_memory = 0;            ///< of the program while it was made, in bytes
};

/// A label of which there is no surface, and why.
struct SkippedLabel {
  std::string label;
  std::string message;
};

[[nodiscard]] std::array<std::size_t, 4> count_kinds(const Surface& surface);

/// What `loft reconstruct --json` prints, as one object with schema version 2 (1 listed the
/// slabs without being asked):
///
///     schema "loft-reconstruct", schema_version 2, loft (version)
///     inputs, outputs      file names
///     options              fill, keyhole_width (null: by default), tolerance,
///                          height_tolerance, cap, link, max_shift (null: by
///                          size), links (file or null), smooth, metres_per_unit; fair,
///                          max_edge, target_edge, simplify if given
///     out_of_core          whether the stack stayed in its files
///     shard                [I, N]: this job's share of the labels; null: all of them
///     slices, contours, vertices_in, vertices, faces, components, genus, area, volume   in all
///     seconds              of each stage that there is: read, fair, clean, tile, smooth,
///                          refine, sew, simplify, write, total
///     peak_memory_mb       the most memory in RAM, in units of 2^20 bytes
///     skipped              labels without a surface: label, message
///     existing             labels that --skip-existing left as they are
///     parts                one a label: label, slices, contours, vertices_in, vertices, faces,
///                          components, genus, area, volume, slab_volume, angles, seconds
///                          (of each stage, total), peak_memory_mb (while it was made),
///                          vertices_of_kind (contour, cleaning, crossing, steiner), cleaning
///                          (area; counts by kind; slices: a list of slice, z, repairs, area),
///                          repairs (a list); with
///                          --slabs slabs (a list; out of core an empty one)
///
/// volume: what the surface encloses; slab_volume: the sum of each slice's area times its
/// thickness, as planning systems and counts of voxels have it. angles: of the smallest one of each
/// triangle, in degrees, the least, percentile_5 and median; worst_aspect, the longest side over
/// the height on it, 1 where all sides are equal. A repair: kind, slice (index in the input), z,
/// contour, point, place [x, y] (null where not known), area (that it decided: see Defect),
/// message.
///
/// A slab, from low to high: slices [lower, upper], z [lower, upper], sheet_area, wall_area,
/// overlap, shift, confidence, links (a list). A link: kind (link, split, merge, tangle, birth,
/// death), of (part or cavity), rule (overlap, slide, predicted, nearest, order, registered; null
/// for what begins or ends as nothing overlaps it), lower and upper: contours (a list of [slice,
/// contour]) and place [x, y] (null if there are none); shift, turn (degrees), overlap, confidence.
/// reconstruct/link/link_report.h says what the numbers mean, reconstruct/link/pieces.h the rules.
///
/// Lengths in the unit of the input. Later versions of the schema may add keys.
struct Report {
  StackSize input;
  std::vector<PartReport> parts;
  std::vector<SkippedLabel> skipped;
  std::vector<std::string> existing;  ///< labels that are not worked on, as their files are there
  std::map<std::string, double> seconds;
  std::size_t peak_memory = 0;  ///< in bytes
  bool is_out_of_core = false;
};

[[nodiscard]] std::string to_json(const Report& report, const ReconstructCommand& command);

}  // namespace loft::app
