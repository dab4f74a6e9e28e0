// SPDX-License-Identifier: MIT
#include "reconstruct/link/link_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/vec3.h"
#include "reconstruct/link/moves.h"

namespace loft {

namespace {

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(minus(b, a), minus(c, a));
  return std::hypot(normal[0], normal[1], normal[2]) / 2;
}

LinkKind kind(const Piece& piece) {
  if (piece.lower.is_empty()) return LinkKind::birth;
  if (piece.upper.is_empty()) return LinkKind::death;
  if (piece.lower.parts == 1 && piece.upper.parts == 1) return LinkKind::link;
  if (piece.lower.parts == 1) return LinkKind::split;
  return piece.upper.parts == 1 ? LinkKind::merge : LinkKind::tangle;
}

std::vector<ContourId> contours(const Region& region, const Footprint& footprint) {
  std::vector<ContourId> found;
  for (const std::uint32_t i : footprint.loops) {
    for (const std::uint32_t v : region.loop(i)) {
      const Origin& origin = region.origins[v];
      const ContourId id{origin.slice, origin.contour};
      if (origin.kind == VertexKind::contour && (found.empty() || found.back() != id))
        found.push_back(id);
    }
  }
  for (const std::uint32_t i : footprint.lines) {
    const Origin& origin = region.line_origins[i];
    found.push_back({origin.slice, origin.contour});
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

LinkReport report(const Region& lower, const Region& upper, const Piece& piece, double difference) {
  LinkReport link;
  link.kind = kind(piece);
  link.is_solid = piece.is_solid;
  link.reason = piece.reason;
  link.lower = contours(lower, piece.lower);
  link.upper = contours(upper, piece.upper);
  link.lower_place = piece.lower.centroid;
  link.upper_place = piece.upper.centroid;
  if (piece.is_end()) return link;
  link.shift = std::hypot(piece.shift.x, piece.shift.y);
  link.turn = piece.turn * 180 / std::numbers::pi;
  link.overlap = overlap(piece, difference);
  const double size = std::min(piece.lower.radius, piece.upper.radius);
  if (size > 0)
    link.confidence = link.overlap * size / (size + link.shift + size * std::abs(piece.turn));
  return link;
}

}  // namespace

SlabReport report_slab(const Region& lower, const Region& upper, const TileSet& tiles,
                       const Pieces& pieces) {
  SlabReport slab;
  slab.lower_slice = lower.slice;
  slab.upper_slice = upper.slice;
  slab.lower_z = lower.z;
  slab.upper_z = upper.z;
  std::vector<double> areas(pieces.pieces.size());
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    const auto& [nodes, kind] = tiles.tiles[t];
    const double size = area(place_of(lower, upper, tiles.inner, nodes[0]),
                             place_of(lower, upper, tiles.inner, nodes[1]),
                             place_of(lower, upper, tiles.inner, nodes[2]));
    areas[pieces.of_tile[t]] += size;
    (kind == FaceKind::sheet ? slab.sheet_area : slab.wall_area) += size;
  }
  const std::vector<double> apart = differences(lower, upper, tiles, pieces);
  double inside = 0;  // of both slices, what is in both counted twice
  double difference = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    slab.links.push_back(report(lower, upper, piece, apart[i]));
    inside += (piece.is_solid ? 1 : -1) * (piece.lower.area + piece.upper.area);
    difference += apart[i];
    slab.shift = std::max(slab.shift, slab.links.back().shift);
    slab.confidence += areas[i] * slab.links.back().confidence;
  }
  const double all = slab.sheet_area + slab.wall_area;
  slab.confidence = all > 0 ? slab.confidence / all : 0;
  slab.overlap = inside > 0 ? std::max(0.0, (inside - difference) / (inside + difference)) : 0;
  return slab;
}

std::vector<SlabReport> report_slabs(std::span<const Region> regions,
                                     std::span<const TileSet> tiles,
                                     std::span<const Pieces> pieces) {
  std::vector<SlabReport> slabs;
  for (std::size_t i = 0; i < tiles.size(); ++i)
    slabs.push_back(report_slab(regions[i], regions[i + 1], tiles[i], pieces[i]));
  return slabs;
}

const char* name(LinkKind kind) {
  switch (kind) {
    case LinkKind::link:
      return "link";
    case LinkKind::split:
      return "split";
    case LinkKind::merge:
      return "merge";
    case LinkKind::tangle:
      return "tangle";
    case LinkKind::birth:
      return "birth";
    case LinkKind::death:
      break;
  }
  return "death";
}

const char* name(LinkReason reason) {
  switch (reason) {
    case LinkReason::overlap:
      return "overlap";
    case LinkReason::slide:
      return "slide";
    case LinkReason::predicted:
      return "predicted";
    case LinkReason::nearest:
      return "nearest";
    case LinkReason::registered:
      return "registered";
    case LinkReason::order:
      break;
  }
  return "order";
}

}  // namespace loft
