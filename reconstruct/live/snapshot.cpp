// SPDX-License-Identifier: MIT
#include "reconstruct/live/snapshot.h"

#include <algorithm>

#include "reconstruct/sew/caps.h"
#include "reconstruct/sew/sew.h"

namespace loft {

namespace {

double twice_area(cdt::Point a, cdt::Point b, cdt::Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

double volume(const Region& lower, const Region& upper, const TileSet& tiles) {
  double sum = 0;
  for (const Tile& tile : tiles.tiles) {
    const Vec3 a = place_of(lower, upper, tiles.inner, tile.nodes[0]);
    const Vec3 b = place_of(lower, upper, tiles.inner, tile.nodes[1]);
    const Vec3 c = place_of(lower, upper, tiles.inner, tile.nodes[2]);
    const double height = (a[2] - lower.z) + (b[2] - lower.z) + (c[2] - lower.z);
    sum += height * twice_area({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
  }
  return sum / 6 + (upper.z - lower.z) * area(upper);
}

double Snapshot::volume() const {
  double sum = 0;
  for (const auto& slab : slabs_) sum += slab->volume;
  return sum;
}

std::size_t Snapshot::find(std::uint32_t id) const {
  const auto found =
      std::ranges::find_if(slabs_, [id](const auto& slab) { return slab->info.id == id; });
  return static_cast<std::size_t>(found - slabs_.begin());
}

/// Where a slice is, counted from below; Origin::none for what is beyond the ends.
std::uint32_t Snapshot::rank(std::uint32_t number) const {
  const auto found = ranks_.find(number);
  return found == ranks_.end() ? Origin::none : found->second;
}

SlabReport Snapshot::report(std::size_t i) const {
  const FrozenSlab& slab = *slabs_[i];
  SlabReport report = report_slab(*slab.lower, *slab.upper, *slab.linked, *slab.pieces);
  report.lower_slice = rank(report.lower_slice);
  report.upper_slice = rank(report.upper_slice);
  for (LinkReport& link : report.links)
    for (auto* contours : {&link.lower, &link.upper})
      for (ContourId& contour : *contours) contour.slice = rank(contour.slice);
  return report;
}

Surface Snapshot::surface(unsigned threads) const {
  if (slabs_.empty()) return {};
  std::vector<const Region*> regions{slabs_.front()->lower.get()};
  std::vector<TileSet> tiles;
  for (const auto& slab : slabs_) {
    regions.push_back(slab->upper.get());
    tiles.push_back(*slab->tiles);
  }
  Surface surface = sew(regions, std::move(tiles), cap_, threads);
  for (const Surface::VertexHandle v : surface.vertices()) {
    std::uint32_t& slice = surface.data(v).origin.slice;
    slice = rank(slice);
  }
  return surface;
}

Patch Snapshot::patch(std::size_t first, std::size_t last) const {
  Patch patch;
  const auto add_vertex = [&](const Vec3& place, Origin origin) {
    origin.slice = rank(origin.slice);
    patch.mesh.points.push_back(place);
    patch.origins.push_back(origin);
  };
  const auto add_points = [&](const Region& region) {
    for (std::size_t p = 0; p < region.points.size(); ++p)
      add_vertex({region.points[p].x, region.points[p].y, region.z}, region.origins[p]);
  };
  const auto add_face = [&](std::array<std::uint32_t, 3> corners, FaceKind kind, std::size_t slab) {
    patch.mesh.faces.push_back(corners);
    patch.kinds.push_back(kind);
    patch.slabs.push_back(static_cast<std::uint32_t>(slab));
  };
  std::uint32_t begin = 0;  // of the slice below
  if (first < last) add_points(*slabs_[first]->lower);
  for (std::size_t i = first; i < last; ++i) {
    const FrozenSlab& slab = *slabs_[i];
    const auto lower_count = static_cast<std::uint32_t>(slab.lower->points.size());
    const auto upper_begin = static_cast<std::uint32_t>(patch.mesh.points.size());
    add_points(*slab.upper);
    for (const InnerVertex& inner : slab.tiles->inner)
      add_vertex(inner.place, {inner.kind, slab.lower->slice, Origin::none, Origin::none});
    for (const Tile& tile : slab.tiles->tiles) {
      std::array<std::uint32_t, 3> corners{};
      for (unsigned k = 0; k < 3; ++k)
        corners[k] = tile.nodes[k] < lower_count ? begin + tile.nodes[k]
                                                 : upper_begin + tile.nodes[k] - lower_count;
      add_face(corners, tile.kind, i);
    }
    if (slab.has_bottom_cap)
      for (const auto& [a, b, c] : flat_cap(*slab.lower))
        add_face({begin + b, begin + a, begin + c}, FaceKind::bottom_cap, i);
    if (slab.has_top_cap)
      for (const auto& [a, b, c] : flat_cap(*slab.upper))
        add_face({upper_begin + a, upper_begin + b, upper_begin + c}, FaceKind::top_cap, i);
    begin = upper_begin;
  }
  return patch;
}

}  // namespace loft
