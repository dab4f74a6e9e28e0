// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "reconstruct/defect.h"
#include "reconstruct/link_report.h"
#include "reconstruct/measure.h"
#include "reconstruct/progress.h"
#include "reconstruct/slice.h"
#include "reconstruct/surface.h"

namespace loft::app {

/// How much of a stack there is: all of it, or the contours of one label.
struct StackSize {
  std::size_t slices = 0;  ///< with at least one of the contours
  std::size_t contours = 0;
  std::size_t vertices = 0;
};

/// The contours with this label; all contours where it is not set.
[[nodiscard]] StackSize size_of(const std::vector<Slice>& stack,
                                const std::optional<std::string>& label = std::nullopt);

/// One reconstructed label.
struct PartReport {
  std::string label;
  StackSize input;
  Measures measures;
  std::array<std::size_t, 4> vertices_of_kind{};  ///< by VertexKind
  std::vector<Defect> repairs;
  std::vector<SlabReport> slabs;
  std::map<std::string, double> seconds;  ///< of each stage: `clean`, `tile`, `sew`
};

[[nodiscard]] std::array<std::size_t, 4> count_kinds(const Surface& surface);

/// What `loft reconstruct --json` prints, as one object with schema version 1:
///
///     schema "loft-reconstruct", schema_version 1, loft (version)
///     inputs, outputs      file names
///     options              fill, cap, link, max_shift (null: by size), links (file or null),
///                          metres_per_unit
///     slices, contours, vertices_in, vertices, faces, components, genus, area, volume   in all
///     seconds              of each stage: read, clean, tile, sew, write, total
///     parts                one a label: label, slices, contours, vertices_in, vertices, faces,
///                          components, genus, area, volume, seconds, vertices_of_kind (contour,
///                          cleaning, crossing, steiner), repairs (a list), slabs (a list)
///
/// A repair: kind, slice (index in the input), z, contour, point, place [x, y] (null where not
/// known), area (changed), message.
///
/// A slab, from low to high: slices [lower, upper], z [lower, upper], sheet_area, wall_area,
/// overlap, shift, confidence, links (a list). A link: kind (link, split, merge, tangle, birth,
/// death), of (part or cavity), rule (overlap, slide, predicted, nearest, order; null for what
/// begins or ends as nothing overlaps it), lower and upper: contours (a list of [slice, contour])
/// and place [x, y] (null if there are none); shift, overlap, confidence. reconstruct/link_report.h
/// says what the numbers mean, reconstruct/pieces.h the rules.
///
/// Lengths in the unit of the input. Later versions of the schema
/// may add keys.
struct Report {
  StackSize input;
  std::vector<PartReport> parts;
  std::map<std::string, double> seconds;
};

[[nodiscard]] std::string to_json(const Report& report, const ReconstructCommand& command);

/// `1,234,567`
[[nodiscard]] std::string grouped(std::size_t number);
/// Four significant digits, for people.
[[nodiscard]] std::string rounded(double number);
/// `1,234 triangles, 619 vertices, 1 component, genus 0, area 12.3, volume 4.56`
[[nodiscard]] std::string describe(const Measures& measures);

[[nodiscard]] const char* name(Fill fill);
[[nodiscard]] const char* name(Cap cap);
[[nodiscard]] const char* name(LinkRule rule);
[[nodiscard]] const char* name(Stage stage);

}  // namespace loft::app
