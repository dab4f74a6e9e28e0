// SPDX-License-Identifier: MIT
#include "reconstruct/sew/survey.h"

#include <map>

namespace loft {

namespace {

/// The closed chains that sides make, by their ends.
std::size_t count_chains(const std::vector<std::array<std::uint32_t, 2>>& sides) {
  std::map<std::uint32_t, std::uint32_t> first_at;  // the side that begins at a vertex
  for (std::uint32_t i = 0; i < sides.size(); ++i) first_at[sides[i][0]] = i;
  DisjointSets chains(sides.size());
  for (std::uint32_t i = 0; i < sides.size(); ++i) chains.unite(i, first_at.at(sides[i][1]));
  return chains.count();
}

}  // namespace

void Survey::add_vertices(std::span<const SurfaceVertex> vertices) {
  measures_.vertices += vertices.size();
  for (const SurfaceVertex& vertex : vertices)
    ++kinds_[static_cast<std::size_t>(vertex.origin.kind)];
}

void Survey::add_face(const std::array<Vec3, 3>& corners) {
  ++measures_.faces;
  sum_.add(corners);
}

void Survey::connect(const Sewing& sewing, std::uint32_t layer, std::uint32_t first,
                     std::uint32_t bound) {
  const auto mate_of = [&](std::uint32_t h) {
    const HalfEdge mate = sewing.mate({layer, h});
    return mate.layer < first || mate.layer >= bound ? HalfEdge() : mate;
  };
  const auto face_count = sewing.layer(layer).tiles.tiles.size();
  DisjointSets faces(face_count);
  std::vector<std::array<std::uint32_t, 2>> rim;
  for (std::uint32_t h = 0; h < 3 * face_count; ++h) {
    const HalfEdge mate = mate_of(h);
    if (mate.is_none())
      rim.push_back({sewing.vertex({layer, h}), sewing.vertex(Sewing::next(HalfEdge{layer, h}))});
    if (mate.layer == layer) faces.unite(h / 3, mate.face());
  }
  side_count_ += 3 * face_count;
  rim_side_count_ += rim.size();
  rim_count_ += count_chains(rim);  // a slice's, so that each is in one layer

  std::vector<std::uint32_t> part(face_count);
  for (std::uint32_t f = 0; f < face_count; ++f)
    part[f] = faces.find(f) == f ? parts_.add() : part[faces.find(f)];
  for (std::uint32_t h = 0; h < 3 * face_count; ++h) {
    const HalfEdge mate = mate_of(h);
    if (!mate.is_none() && mate.layer < layer) parts_.unite(part[h / 3], part_[mate.face()]);
  }
  part_ = std::move(part);
}

Measures Survey::measures() {
  measures_.edges = (side_count_ + rim_side_count_) / 2;
  measures_.components = parts_.count();
  measures_.genus = genus(measures_, rim_count_);
  sum_.put_into(measures_);
  return measures_;
}

}  // namespace loft
