// SPDX-License-Identifier: MIT
#include "overlay/layer_traces.h"

#include <algorithm>

namespace loft::overlay {

using cdt::Triangulation;

std::vector<TracedPolygon> layer_traces(const Overlay& overlay, LayerId layer) {
  std::vector<std::uint32_t> region_of(overlay.cover_bound());
  std::vector<BorderEdge> border;
  for (std::uint32_t c = 0; c < region_of.size(); ++c)
    region_of[c] = std::ranges::binary_search(overlay.layers(CoverId(c)), layer) ? 1 : 0;
  const Triangulation& mesh = overlay.triangulation();
  const Regions regions{.mesh = &mesh, .covers = overlay.covers(), .region_of = region_of};
  for (std::uint32_t c = 0; c < region_of.size(); ++c) {
    if (region_of[c] == 0) continue;
    for (const cdt::TriangleId t : overlay.triangles(CoverId(c)))
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = Triangulation::edge(t, corner);
        if (regions.has_border(e)) border.push_back(border_edge(mesh, e));
      }
  }
  return trace(regions, border);
}

}  // namespace loft::overlay
