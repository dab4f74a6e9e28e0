// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"
#include "reconstruct/defect.h"
#include "reconstruct/options.h"
#include "reconstruct/origin.h"
#include "reconstruct/plane/segment_tree.h"

namespace loft {

/// What the contours of a slice enclose, by its boundary: loops that neither cross nor overlap
/// themselves or one another, the region on their left. They may meet in single points.
struct Region {
  double z = 0;
  std::uint32_t slice = 0;                   ///< index of the slice in the input
  std::vector<cdt::Point> points;            ///< the vertices of the loops, each place once
  std::vector<Origin> origins;               ///< where each point comes from
  std::vector<std::uint32_t> loop_vertices;  ///< indices of points, loop after loop
  std::vector<std::uint32_t> loop_starts;    ///< where each loop starts in them, and their number

  [[nodiscard]] bool is_empty() const { return points.empty(); }
  [[nodiscard]] std::size_t loop_count() const {
    return loop_starts.empty() ? 0 : loop_starts.size() - 1;
  }
  [[nodiscard]] std::span<const std::uint32_t> loop(std::size_t i) const {
    return std::span(loop_vertices).subspan(loop_starts[i], loop_starts[i + 1] - loop_starts[i]);
  }
};

/// Whether every point of a region is on one loop, once.
[[nodiscard]] inline bool is_simple(const Region& region) {
  return region.loop_vertices.size() == region.points.size();
}

/// The edges of all loops, in their order, the region on their left.
[[nodiscard]] std::vector<Segment> boundary(const Region& region);

/// Whether two regions are the same in their slices, whichever these are.
[[nodiscard]] bool is_same_in_slice(const Region& a, const Region& b);

/// A contour on its way into cleaning: its points, and where it stands in the input.
struct ContourSource {
  std::span<const cdt::Point> points;
  std::uint32_t slice = 0;
  std::uint32_t contour = 0;
};

/// Cleans a slice (design, section 3, step 0): contours with no area and copies of others are
/// dropped, keyholes cut; the rest go into a CDT, which is flooded by the fill rule; the edges
/// between inside and outside make the loops. What was found is appended to `repairs`.
/// Laws: a slice of which nothing is reported keeps its vertices and edges, one for one. The
/// region does not depend on the order of the contours and of their points; with even-odd filling
/// neither on their direction. Precondition: finite coordinates.
/// Cost: that of the CDT; where contours meet, with how many enclose the same place.
[[nodiscard]] Region clean(std::span<const ContourSource> contours, double z,
                           const Filling& filling, std::vector<Defect>& repairs);
/// The same with memory for the CDT that can be used again from slice to slice.
[[nodiscard]] Region clean(std::span<const ContourSource> contours, double z,
                           const Filling& filling, std::vector<Defect>& repairs,
                           cdt::Triangulation& memory);

/// Inserts the loops of a region as constraints, in order: segment i starts at
/// `loop_vertices[i]`, counted from the first segment that is new. All points moved by `shift`.
void insert_loops(const Region& region, cdt::Triangulation& mesh, cdt::Point shift = {});

}  // namespace loft
