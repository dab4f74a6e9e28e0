// SPDX-License-Identifier: MIT
#include "reconstruct/shape/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/cases.h"

namespace loft {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A strip from one row of nodes to the other, closed to a ring.
std::vector<Tile> ring_of_tiles(std::uint32_t count) {
  std::vector<Tile> tiles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    tiles.push_back({{i, next, count + i}, FaceKind::sheet});
    tiles.push_back({{next, count + next, count + i}, FaceKind::sheet});
  }
  return tiles;
}

/// The tiles' directed edges, each with its half-edge; empty if one is there twice.
std::map<Edge, std::uint32_t> directed_edges(const std::vector<Tile>& tiles) {
  std::map<Edge, std::uint32_t> edges;
  for (std::uint32_t half = 0; half < 3 * tiles.size(); ++half) {
    const auto& nodes = tiles[half / 3].nodes;
    if (!edges.emplace(Edge{nodes[half % 3], nodes[(half + 1) % 3]}, half).second) return {};
  }
  return edges;
}

/// What is wrong with the twins, by looking for each edge among all.
std::string wrong(const HalfEdges& edges, const std::vector<Tile>& tiles) {
  const auto known = directed_edges(tiles);
  if (known.size() != 3 * tiles.size() || edges.count() != known.size()) return "an edge twice";
  for (const auto& [ends, half] : known) {
    const auto twin = known.find({ends.second, ends.first});
    if (edges.twin(half) != (twin == known.end() ? HalfEdges::none : twin->second))
      return "the twin of half-edge " + std::to_string(half);
    if (edges.from(half) != ends.first || edges.to(half) != ends.second) return "an end";
  }
  return {};
}

TEST(HalfEdges, StayTwinsWhileEdgesAreSplitAndFlipped) {
  for (std::uint64_t seed = 0; seed < cases(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<Tile> tiles = ring_of_tiles(5);
    HalfEdges edges(tiles);
    std::uint32_t node_count = 10;
    ASSERT_EQ(wrong(edges, tiles), "");
    for (int i = 0; i < 100; ++i) {
      const auto half = static_cast<std::uint32_t>(random() % edges.count());
      if (edges.twin(half) == HalfEdges::none) continue;
      const std::uint32_t left = edges.apex(half);
      const std::uint32_t right = edges.apex(edges.twin(half));
      const auto known = directed_edges(tiles);
      if (random() % 2 == 0) {
        const auto around = edges.split(half, node_count);
        EXPECT_TRUE(std::all_of(around.begin() + 4, around.end(), [&](std::uint32_t at) {
          return edges.from(at) == node_count || edges.to(at) == node_count;
        }));
        ++node_count;
      } else if (left != right && !known.contains({left, right}) &&
                 !known.contains({right, left})) {
        const std::uint32_t diagonal = edges.flip(half).back();
        EXPECT_EQ(std::minmax(edges.from(diagonal), edges.to(diagonal)), std::minmax(left, right));
      }
      ASSERT_EQ(wrong(edges, tiles), "");
    }
  }
}

TEST(HalfEdges, OfMoreThanTwoTilesHaveNoTwin) {
  std::vector<Tile> tiles;
  for (const std::array<std::uint32_t, 3>& nodes :
       {std::array{0U, 1U, 2U}, {1U, 0U, 3U}, {0U, 1U, 4U}, {1U, 0U, 5U}})
    tiles.push_back({nodes, FaceKind::sheet});
  const HalfEdges edges(tiles);
  for (std::uint32_t half = 0; half < edges.count(); ++half)
    EXPECT_EQ(edges.twin(half), HalfEdges::none);
}

}  // namespace
}  // namespace loft
