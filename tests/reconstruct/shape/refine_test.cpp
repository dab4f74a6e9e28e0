// SPDX-License-Identifier: MIT
#include "reconstruct/shape/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "mesh/check.h"
#include "mesh/measure.h"
#include "mesh/vec3.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"
#include "tests/reconstruct/triangles.h"

namespace loft {
namespace {

/// Two slices and the tiles between them.
struct TiledSlab {
  TiledSlab(const Slice& low, const Slice& high)
      : lower(region(low, 0)), upper(region(high, 1)), tiles(tile(lower, upper)) {}

  static Region region(const Slice& slice, std::uint32_t index) {
    std::vector<ContourSource> sources;
    for (std::uint32_t c = 0; c < slice.contours.size(); ++c)
      sources.push_back({slice.contours[c].points, index, c});
    std::vector<Defect> repairs;
    return clean(sources, slice.z, {}, repairs);
  }

  [[nodiscard]] Mesh mesh(const TileSet& set) const {
    Mesh mesh;
    const auto count = lower.points.size() + upper.points.size() + set.inner.size();
    for (std::uint32_t node = 0; node < count; ++node)
      mesh.points.push_back(place_of(lower, upper, set.inner, node));
    for (const Tile& tile : set.tiles) mesh.faces.push_back(tile.nodes);
    return mesh;
  }

  [[nodiscard]] bool in_one_slice(std::uint32_t a, std::uint32_t b) const {
    const auto low = lower.points.size();
    const auto all = low + upper.points.size();
    return a < all && b < all && (a < low) == (b < low);
  }

  Region lower;
  Region upper;
  TileSet tiles;
};

/// Of the open surface and the cone from a fixed place to its rim.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [i, j, k] : mesh.faces)
    sum += dot(mesh.points[i], cross(mesh.points[j], mesh.points[k])) / 6;
  return sum;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The edges of a slab's tiles, with the lengths of the longest other edges of their faces.
std::map<Edge, std::vector<double>> edges(const Mesh& mesh) {
  const auto length = [&](std::uint32_t a, std::uint32_t b) {
    return std::sqrt(squared_length(minus(mesh.points[a], mesh.points[b])));
  };
  std::map<Edge, std::vector<double>> result;
  for (const auto& face : mesh.faces)
    for (unsigned i = 0; i < 3; ++i) {
      const auto [a, b, c] = std::array{face[i], face[(i + 1) % 3], face[(i + 2) % 3]};
      result[std::minmax(a, b)].push_back(std::max(length(b, c), length(c, a)));
    }
  return result;
}

/// The edges in the slice planes, each with the number of its faces.
std::map<Edge, std::size_t> contour_edges(const TiledSlab& slab, const TileSet& tiles) {
  std::map<Edge, std::size_t> result;
  for (const auto& [edge, faces] : edges(slab.mesh(tiles)))
    if (slab.in_one_slice(edge.first, edge.second)) result[edge] = faces.size();
  return result;
}

/// Slabs as they are in well-made stacks: plain, forking, ending, empty on one side.
std::vector<TiledSlab> plain_slabs() {
  std::vector<TiledSlab> slabs;
  slabs.emplace_back(Slice{0, {stacks::circle(12, 1)}}, Slice{4, {stacks::circle(17, 0.8, {.3})}});
  slabs.emplace_back(Slice{0, {stacks::square(2)}}, Slice{9, {stacks::square(2)}});
  slabs.emplace_back(Slice{0, {stacks::circle(30, 1)}}, Slice{1, {}});
  for (const auto& slices : {stacks::y_branch(5, 30), stacks::Torus::slices(6, 12)})
    for (std::size_t i = 0; i + 1 < slices.size(); ++i)
      slabs.emplace_back(slices[i], slices[i + 1]);
  return slabs;
}

/// Random contours and masks, too, with slivers and touching parts everywhere.
std::vector<TiledSlab> all_slabs() {
  std::vector<TiledSlab> slabs = plain_slabs();
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    std::mt19937_64 random(seed);
    const Slice lower = stacks::random_slice(0, random, seed % 2 == 0);
    slabs.emplace_back(
        lower, stacks::random_slice(1 + 3 * static_cast<double>(seed % 3), random, seed % 2 == 0));
  }
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    std::mt19937_64 random(seed);
    const Slice lower = stacks::random_mask(0, random, 6, 0.5);
    slabs.emplace_back(lower, stacks::random_mask(4, random, 6, 0.5));
  }
  return slabs;
}

/// What both ways to refine promise, for edges up to `most`.
void expect_refined(const TiledSlab& slab, const TileSet& refined, double most) {
  EXPECT_EQ(contour_edges(slab, refined), contour_edges(slab, slab.tiles));
  EXPECT_EQ(refined.is_linked, slab.tiles.is_linked);
  const Mesh mesh = slab.mesh(refined);
  double bound = most;
  for (const auto& [edge, count] : contour_edges(slab, refined))
    bound = std::max(
        bound, std::sqrt(squared_length(minus(mesh.points[edge.first], mesh.points[edge.second]))));
  std::size_t touching = 0;
  for (const auto& [edge, longest_beside] : edges(mesh)) {
    const double length =
        std::sqrt(squared_length(minus(mesh.points[edge.first], mesh.points[edge.second])));
    EXPECT_LE(length, bound * (1 + 1e-12));
    if (longest_beside.size() > 2) ++touching;
  }
  // Within itself the slab is as valid as it was: open at its contours, nothing else.
  for (const Finding& finding : check(mesh)) {
    EXPECT_NE(finding.fault, Fault::self_intersection);
    EXPECT_NE(finding.fault, Fault::degenerate_face);
    if (touching == 0) {
      EXPECT_NE(finding.fault, Fault::inconsistent_edge);
    }
  }
}

TEST(Refine, MaxEdgeSplitsWithoutMovingTheSurface) {
  for (const TiledSlab& slab : all_slabs()) {
    const Measures before = measure(slab.mesh(slab.tiles));
    for (const double most : {3.0, 0.5}) {
      SCOPED_TRACE(most);
      const TileSet refined = split_long_edges(slab.lower, slab.upper, slab.tiles, most);
      expect_refined(slab, refined, most);
      const Measures after = measure(slab.mesh(refined));
      EXPECT_NEAR(after.area, before.area, 1e-12 * before.area);
      EXPECT_NEAR(volume(slab.mesh(refined)), volume(slab.mesh(slab.tiles)), 1e-11 * before.area);
      EXPECT_GE(after.angles.smallest, before.angles.smallest / 2 - 1e-9);
    }
  }
}

TEST(Refine, MaxEdgeLeavesALongEdgeOnlyBesideALongerOne) {
  for (const TiledSlab& slab : plain_slabs()) {
    const double most = 0.3;
    const Mesh mesh = slab.mesh(split_long_edges(slab.lower, slab.upper, slab.tiles, most));
    for (const auto& [edge, longest_beside] : edges(mesh)) {
      if (slab.in_one_slice(edge.first, edge.second)) continue;
      const double length =
          std::sqrt(squared_length(minus(mesh.points[edge.first], mesh.points[edge.second])));
      if (length > most) {
        EXPECT_GE(*std::ranges::max_element(longest_beside), length);
      }
    }
  }
}

TEST(Refine, MaxEdgeIsKeptWhereContourEdgesAreShort) {
  const TiledSlab slab({0, {stacks::circle(60, 1)}}, {5, {stacks::circle(50, 1.2)}});
  const Mesh mesh = slab.mesh(split_long_edges(slab.lower, slab.upper, slab.tiles, 0.2));
  for (const auto& [edge, beside] : edges(mesh))
    EXPECT_LE(squared_length(minus(mesh.points[edge.first], mesh.points[edge.second])), 0.04);
}

TEST(Refine, ALargeMaxEdgeChangesNothing) {
  for (const TiledSlab& slab : all_slabs()) {
    const TileSet refined = split_long_edges(slab.lower, slab.upper, slab.tiles, 1000);
    EXPECT_EQ(slab.mesh(refined), slab.mesh(slab.tiles));
  }
}

TEST(Refine, TargetEdgeKeepsContoursAndStaysNear) {
  for (const TiledSlab& slab : all_slabs()) {
    if (slab.tiles.tiles.empty()) continue;
    for (const double target : {2.0, 0.5}) {
      SCOPED_TRACE(target);
      const TileSet refined = even_out_edges(slab.lower, slab.upper, slab.tiles, target);
      expect_refined(slab, refined, target * 4 / 3);
      const Mesh before = slab.mesh(slab.tiles);
      const Mesh after = slab.mesh(refined);
      EXPECT_LE(triangles::farthest(after, before), 0.5 * target);
      EXPECT_LE(triangles::farthest(before, after), 0.5 * target);
    }
  }
}

TEST(Refine, TargetEdgeMakesGoodTriangles) {
  const TiledSlab slab({0, {stacks::circle(60, 1)}}, {5, {stacks::circle(50, 1.2)}});
  const TileSet refined = even_out_edges(slab.lower, slab.upper, slab.tiles, 0.13);
  const Measures before = measure(slab.mesh(slab.tiles));
  const Measures after = measure(slab.mesh(refined));
  EXPECT_LT(before.angles.median, 2);
  EXPECT_GT(after.angles.fifth_percentile, 30);
  EXPECT_GT(after.angles.median, 45);
  std::vector<double> lengths;
  const Mesh mesh = slab.mesh(refined);
  for (const auto& [edge, beside] : edges(mesh))
    lengths.push_back(
        std::sqrt(squared_length(minus(mesh.points[edge.first], mesh.points[edge.second]))));
  std::ranges::sort(lengths);
  EXPECT_GT(lengths[lengths.size() / 20], 0.13 * 0.7);
  EXPECT_NEAR(lengths[lengths.size() / 2], 0.13, 0.13 * 0.1);
}

/// Random stacks, refined in every way, make valid solids as others do.
TEST(Refine, AnyContoursMakeASolid) {
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<Slice> slices;
    for (int i = 0; i < 3; ++i)
      slices.push_back(seed % 3 == 2 ? stacks::random_mask(i, random, 5, 0.5)
                                     : stacks::random_slice(i, random, seed % 3 == 0));
    Options options;
    const double length = std::uniform_real_distribution<double>(0.2, 1)(random);
    (seed / 3 % 2 == 0 ? options.max_edge : options.target_edge) = length;
    try {
      EXPECT_EQ(solids::faults(reconstruct(slices, options).surface), "");
    } catch (const InputError&) {
      // Fewer than two slices with an area: rare, and right.
    }
  }
}

TEST(Refine, RoundingFarFromTheOriginMakesNothingMeet) {
  // Numbers there are 0.001 apart: most middles are rounded, and fold the surface if they may.
  std::vector<Slice> slices = stacks::Torus::slices(8, 8);
  for (Slice& slice : slices)
    for (Contour& contour : slice.contours)
      for (cdt::Point& p : contour.points) p = {p.x + 5e12, p.y - 5e12};
  EXPECT_EQ(solids::faults(reconstruct(slices, {.max_edge = 0.05}).surface), "");
  EXPECT_EQ(solids::faults(reconstruct(slices, {.target_edge = 0.05}).surface), "");
}

TEST(Refine, NumbersOfVerticesHaveNoPartInIt) {
  std::vector<Slice> slices = stacks::Torus::slices(6, 12);
  std::vector<Slice> renumbered = slices;
  for (Slice& slice : renumbered) {
    std::ranges::reverse(slice.contours);
    for (Contour& contour : slice.contours)
      std::rotate(contour.points.begin(), contour.points.begin() + 5, contour.points.end());
  }
  for (const Options& options : {Options{.max_edge = 0.2}, Options{.target_edge = 0.2}})
    EXPECT_EQ(triangles::by_place(reconstruct(slices, options).surface),
              triangles::by_place(reconstruct(renumbered, options).surface));
}

TEST(Refine, RefusesLengthsThatWouldFillTheMemory) {
  const TiledSlab slab({0, {stacks::circle(12, 1)}}, {4, {stacks::circle(17, 0.8)}});
  EXPECT_THROW((void)split_long_edges(slab.lower, slab.upper, slab.tiles, 1e-6), InputError);
  EXPECT_THROW((void)even_out_edges(slab.lower, slab.upper, slab.tiles, 1e-6), InputError);
}

}  // namespace
}  // namespace loft
