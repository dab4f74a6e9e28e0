// SPDX-License-Identifier: MIT
#include "reconstruct/shape/half_edges.h"

#include "reconstruct/shape/edge_index.h"

namespace loft {

HalfEdges::HalfEdges(std::vector<Tile>& tiles) : tiles_(tiles), twins_(3 * tiles.size(), none) {
  struct Sides {
    std::uint32_t first;
    std::uint32_t count;
  };
  EdgeIndex index;
  std::vector<Sides> edges;
  for (std::uint32_t half = 0; half < count(); ++half) {
    const auto [edge, is_known] = index.at(from(half), to(half));
    if (!is_known) {
      edge = static_cast<std::uint32_t>(edges.size());
      edges.push_back({half, 1});
      continue;
    }
    auto& [first, sides] = edges[edge];
    ++sides;
    if (sides == 2 && from(first) == to(half)) {
      join(first, half);
    } else if (twins_[first] != none) {
      twins_[twins_[first]] = none;
      twins_[first] = none;
    }
  }
}

void HalfEdges::join(std::uint32_t half, std::uint32_t other) {
  twins_[half] = other;
  if (other != none) twins_[other] = half;
}

std::array<std::uint32_t, 8> HalfEdges::split(std::uint32_t half, std::uint32_t node) {
  const auto [a, b, c, d] = diamond(half);
  const auto [bc, ca, ad, db] = beyond(half);
  const std::uint32_t at_a = half / 3;
  const std::uint32_t at_b = twins_[half] / 3;
  const auto beyond_b = static_cast<std::uint32_t>(tiles_.size());
  const std::uint32_t beyond_a = beyond_b + 1;
  tiles_[at_a].nodes = {a, node, c};
  tiles_[at_b].nodes = {b, node, d};
  tiles_.push_back({{node, b, c}, tiles_[at_a].kind});
  tiles_.push_back({{node, a, d}, tiles_[at_b].kind});
  twins_.resize(3 * tiles_.size(), none);
  join(3 * at_a, 3 * beyond_a);
  join(3 * at_a + 1, 3 * beyond_b + 2);
  join(3 * at_a + 2, ca);
  join(3 * at_b, 3 * beyond_b);
  join(3 * at_b + 1, 3 * beyond_a + 2);
  join(3 * at_b + 2, db);
  join(3 * beyond_b + 1, bc);
  join(3 * beyond_a + 1, ad);
  return {3 * at_a + 2, 3 * beyond_b + 1, 3 * at_b + 2, 3 * beyond_a + 1,
          3 * at_a,     3 * beyond_b,     3 * at_a + 1, 3 * at_b + 1};
}

std::array<std::uint32_t, 5> HalfEdges::flip(std::uint32_t half) {
  const auto [a, b, c, d] = diamond(half);
  const auto [bc, ca, ad, db] = beyond(half);
  const std::uint32_t at_b = half / 3;
  const std::uint32_t at_a = twins_[half] / 3;
  tiles_[at_b].nodes = {c, d, b};
  tiles_[at_a].nodes = {d, c, a};
  join(3 * at_b, 3 * at_a);
  join(3 * at_b + 1, db);
  join(3 * at_b + 2, bc);
  join(3 * at_a + 1, ca);
  join(3 * at_a + 2, ad);
  return {3 * at_b + 1, 3 * at_b + 2, 3 * at_a + 1, 3 * at_a + 2, 3 * at_b};
}

}  // namespace loft
