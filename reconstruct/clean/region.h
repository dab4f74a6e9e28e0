// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"
#include "reconstruct/origin.h"
#include "reconstruct/plane/segment_tree.h"

namespace loft {

/// What the contours of a slice enclose, by its boundary: loops that neither cross nor overlap
/// themselves or one another, the region on their left. They may meet in single points.
///
/// Beside it there may be lines: contours without an area, one point or several in one line. A part
/// of a neighbouring slice that would end before this one may end in them, in an apex or a ridge.
struct Region {
  double z = 0;
  std::uint32_t slice = 0;         ///< index of the slice in the input
  std::vector<cdt::Point> points;  ///< the vertices of the loops, then those of lines, each once
  std::vector<Origin> origins;     ///< where each point comes from
  std::vector<std::uint32_t> loop_vertices;  ///< indices of points, loop after loop
  std::vector<std::uint32_t> loop_starts;    ///< where each loop starts in them, and their number
  std::vector<std::uint32_t> line_vertices;  ///< indices of points from end to end, line after line
  std::vector<std::uint32_t> line_starts;    ///< as loop_starts; empty if there are no lines
  std::vector<Origin> line_origins;          ///< of each line its contour

  [[nodiscard]] bool is_empty() const { return points.empty(); }
  [[nodiscard]] bool has_loops() const { return !loop_vertices.empty(); }
  [[nodiscard]] std::size_t loop_count() const {
    return loop_starts.empty() ? 0 : loop_starts.size() - 1;
  }
  [[nodiscard]] std::span<const std::uint32_t> loop(std::size_t i) const {
    return std::span(loop_vertices).subspan(loop_starts[i], loop_starts[i + 1] - loop_starts[i]);
  }
  [[nodiscard]] std::size_t line_count() const {
    return line_starts.empty() ? 0 : line_starts.size() - 1;
  }
  /// Points in one line, one after the other along it; one alone is a line, too.
  [[nodiscard]] std::span<const std::uint32_t> line(std::size_t i) const {
    return std::span(line_vertices).subspan(line_starts[i], line_starts[i + 1] - line_starts[i]);
  }
  /// The vertices of the loops.
  [[nodiscard]] std::span<const cdt::Point> loop_points() const {
    const auto first = std::ranges::min_element(line_vertices);
    return std::span(points).first(first == line_vertices.end() ? points.size() : *first);
  }
};

/// Whether every point of a region is on one loop, once. There are no lines, then.
[[nodiscard]] inline bool is_simple(const Region& region) {
  return region.line_vertices.empty() && region.loop_vertices.size() == region.points.size();
}

/// The edges of all loops, in their order, the region on their left.
[[nodiscard]] std::vector<Segment> boundary(const Region& region);

/// What is inside the loops; negative if that is outside of them.
[[nodiscard]] double area(const Region& region);

/// Whether two regions are the same in their slices, whichever these are.
[[nodiscard]] bool is_same_in_slice(const Region& a, const Region& b);

/// Inserts the loops of a region as constraints, in order: segment i starts at
/// `loop_vertices[i]`, counted from the first segment that is new. All points moved by `shift`.
void insert_loops(const Region& region, cdt::Triangulation& mesh, cdt::Point shift = {});

}  // namespace loft
