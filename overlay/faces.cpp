// SPDX-License-Identifier: MIT
#include "overlay/faces.h"

#include <algorithm>
#include <numeric>

#include "overlay/components.h"
#include "overlay/trace.h"

namespace loft::overlay {

std::vector<Face> faces(const Overlay& overlay, Vertices vertices) {
  // Every cover is a region of its own, `nothing` outside of all.
  std::vector<std::uint32_t> region_of(overlay.cover_bound());
  std::iota(region_of.begin(), region_of.end(), 0U);
  const cdt::Triangulation& mesh = overlay.triangulation();
  const Regions regions{.mesh = &mesh, .covers = overlay.covers(), .region_of = region_of};
  std::vector<Face> result;
  for (const TracedPolygon& traced : trace(regions, borders(regions))) {
    const auto layers = overlay.layers(CoverId(traced.region));
    result.push_back(
        {{layers.begin(), layers.end()}, points_of(mesh, traced, vertices == Vertices::needed)});
  }
  return result;
}

MultiPolygon parts_between(const Overlay& overlay, ResultId result, std::span<const RingId> lines,
                           Vertices vertices) {
  const cdt::Triangulation& mesh = overlay.triangulation();
  std::vector<bool> is_line(mesh.constraint_bound());
  for (const RingId line : lines) is_line[line.index()] = true;
  const auto is_cut = [&](EdgeId e) {
    return std::ranges::any_of(mesh.passages(e), [&](cdt::Passage passage) {
      return is_line[mesh.segment(passage.segment()).constraint.index()];
    });
  };
  const Components parts(
      mesh, [&](cdt::TriangleId t) { return overlay.is_in(result, t); }, is_cut);
  const Regions regions = parts.regions();
  MultiPolygon polygons;
  for (const TracedPolygon& traced : trace(regions, borders(regions)))
    polygons.push_back(points_of(mesh, traced, vertices == Vertices::needed));
  return polygons;
}

}  // namespace loft::overlay
