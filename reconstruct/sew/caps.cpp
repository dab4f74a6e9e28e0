// SPDX-License-Identifier: MIT
#include "reconstruct/sew/caps.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "cdt/regions.h"

namespace loft {

std::vector<std::array<std::uint32_t, 3>> flat_cap(const Region& region) {
  cdt::Triangulation mesh;
  mesh.reserve(region.points.size());
  insert_loops(region, mesh);
  std::vector<std::uint32_t> index(mesh.vertex_bound(), Origin::none);
  for (std::uint32_t s = 0; s < mesh.segment_bound(); ++s)
    index[mesh.segment(cdt::SegmentId(s)).from.index()] = region.loop_vertices[s];

  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto is_inside = cdt::odd_parity(mesh);
  for (std::uint32_t t = 0; t < mesh.triangle_bound(); ++t) {
    if (!is_inside[t]) continue;
    const cdt::EdgeId e = cdt::Triangulation::edge(cdt::TriangleId(t));
    const std::array corners{index[mesh.from(e).index()], index[mesh.to(e).index()],
                             index[mesh.apex(e).index()]};
    assert(std::ranges::find(corners, Origin::none) == corners.end());  // loops do not cross
    triangles.push_back(corners);
  }
  return triangles;
}

namespace {

/// What is beyond a cap.
const Region& nothing() {
  static const Region region;
  return region;
}

}  // namespace

Layer bottom_cap(const Region& region) {
  Layer layer{&nothing(), &region, {}, 0, region.slice};
  for (const auto& [a, b, c] : flat_cap(region))
    layer.tiles.tiles.push_back({{b, a, c}, FaceKind::bottom_cap});
  return layer;
}

Layer top_cap(const Region& region, std::uint32_t slab, std::uint32_t slice) {
  Layer layer{&region, &nothing(), {}, slab, slice};
  for (const auto& corners : flat_cap(region))
    layer.tiles.tiles.push_back({corners, FaceKind::top_cap});
  return layer;
}

}  // namespace loft
