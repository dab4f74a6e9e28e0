// SPDX-License-Identifier: MIT
#include "reconstruct/shape/forks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <vector>

#include "mesh/vec3.h"
#include "reconstruct/clean/heights.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/reconstruction.h"
#include "tests/reconstruct/live/edit_script.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using Triangle = std::array<Vec3, 3>;

/// The slab of a stack that begins with a slice, and what is around it.
class ForkedSlab {
 public:
  ForkedSlab(const std::vector<Slice>& slices, std::size_t slab) {
    for (std::size_t i = slab - 1; i < slab + 3; ++i) {
      const Slice* const part = &slices[i];
      std::vector<Defect> ignored;
      cdt::Triangulation memory;
      regions_.push_back(clean(Height{slices[i].z, {static_cast<std::uint32_t>(i)}},
                               std::span(&part, 1), {}, ignored, memory));
    }
    for (const Region& region : regions_) shapes_.emplace_back(region);
    for (std::size_t i = 0; i < 4; ++i) around_[i] = &shapes_[i];
    tiles_ = tile(lower(), upper());
    pieces_ = find_pieces(lower(), upper(), tiles_);
  }

  [[nodiscard]] const Region& lower() const { return regions_[1]; }
  [[nodiscard]] const Region& upper() const { return regions_[2]; }
  [[nodiscard]] const TileSet& tiles() const { return tiles_; }
  [[nodiscard]] std::size_t contour_count() const {
    return lower().points.size() + upper().points.size();
  }
  [[nodiscard]] std::vector<bool> at_forks() const {
    return tiles_at_forks(lower(), upper(), pieces_, tiles_);
  }
  [[nodiscard]] TileSet bent() const {
    const std::vector<bool> there = at_forks();
    return there.empty() ? tiles_ : bend_forks(lower(), upper(), around_, pieces_, tiles_, there);
  }
  void shuffle(std::mt19937_64& random) {
    std::vector<std::size_t> order(tiles_.tiles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::shuffle(order, random);
    const auto tiles = tiles_.tiles;
    const auto of_tile = pieces_.of_tile;
    for (std::size_t i = 0; i < order.size(); ++i) {
      tiles_.tiles[i] = tiles[order[i]];
      auto& nodes = tiles_.tiles[i].nodes;
      std::rotate(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(random() % 3),
                  nodes.end());
      pieces_.of_tile[i] = of_tile[order[i]];
    }
  }

 private:
  std::vector<Region> regions_;
  std::vector<SliceShape> shapes_;
  Surroundings around_{};
  TileSet tiles_;
  Pieces pieces_;
};

/// With their smallest corners first, sorted.
std::vector<Triangle> triangles(const ForkedSlab& slab, const TileSet& tiles) {
  std::vector<Triangle> found;
  for (const Tile& tile : tiles.tiles) {
    Triangle& made = found.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      made[i] = place_of(slab.lower(), slab.upper(), tiles.inner, tile.nodes[i]);
    std::rotate(made.begin(), std::ranges::min_element(made), made.end());
  }
  std::ranges::sort(found);
  return found;
}

/// How far vertices between slices are from a torus, in the mean.
double mean_torus_error(const std::vector<InnerVertex>& vertices) {
  double sum = 0;
  for (const InnerVertex& vertex : vertices) {
    const auto& [x, y, z] = vertex.place;
    sum += std::abs(std::hypot(std::hypot(x, z) - stacks::Torus::ring, y) - stacks::Torus::tube);
  }
  return sum / static_cast<double>(vertices.size());
}

/// The slabs of a torus in which one part and two meet.
std::vector<std::size_t> forked_slabs(const std::vector<Slice>& slices) {
  std::vector<std::size_t> found;
  for (std::size_t i = 1; i + 2 < slices.size(); ++i)
    if (slices[i].contours.size() != slices[i + 1].contours.size()) found.push_back(i);
  return found;
}

TEST(Forks, ComeNearerToTheShapeByTheSlicesBeforeAndBeyond) {
  for (const std::size_t count : {12U, 15U, 20U}) {
    const auto slices = stacks::Torus::slices(count, 20);
    ASSERT_EQ(forked_slabs(slices).size(), 2U);
    for (const std::size_t i : forked_slabs(slices)) {
      const ForkedSlab slab(slices, i);
      EXPECT_LT(mean_torus_error(slab.bent().inner), 0.9 * mean_torus_error(slab.tiles().inner))
          << count;
    }
  }
}

TEST(Forks, WithoutVerticesBetweenSlicesNothingChanges) {
  const ForkedSlab slab(stacks::sphere(12, 50), 3);
  EXPECT_TRUE(slab.at_forks().empty());
  EXPECT_EQ(triangles(slab, slab.bent()), triangles(slab, slab.tiles()));
}

TEST(Forks, TilesElsewhereStayAndComeFirst) {
  auto slices = stacks::Torus::slices(15, 40);
  for (Slice& slice : slices) slice.contours.push_back(stacks::circle(30, 0.5, {9, 0}));
  const ForkedSlab slab(slices, forked_slabs(slices).front());
  const std::vector<bool> at_forks = slab.at_forks();
  const auto there = static_cast<std::size_t>(std::ranges::count(at_forks, true));
  ASSERT_GT(there, 0U);
  ASSERT_LT(there + 60, at_forks.size());
  const TileSet bent = slab.bent();
  for (std::size_t t = 0, place = 0; t < at_forks.size(); ++t) {
    if (at_forks[t]) continue;
    EXPECT_EQ(bent.tiles[place++].nodes, slab.tiles().tiles[t].nodes);
  }
}

TEST(Forks, TheOrderOfTilesHasNoPartInIt) {
  std::mt19937_64 random(5);
  const auto slices = stacks::Torus::slices(15, 20);
  ForkedSlab slab(slices, forked_slabs(slices).front());
  const auto usual = triangles(slab, slab.bent());
  for (int i = 0; i < 10; ++i) {
    slab.shuffle(random);
    EXPECT_EQ(triangles(slab, slab.bent()), usual);
  }
}

/// By the slab that they are in.
std::map<std::uint32_t, std::multiset<Triangle>> faces_by_slab(const std::vector<Slice>& slices) {
  const Surface surface = reconstruct(slices, {.cap = Cap::open}).surface;
  std::map<std::uint32_t, std::multiset<Triangle>> found;
  for (const auto f : surface.faces()) {
    Triangle made{};
    std::size_t i = 0;
    for (const auto v : f.vertices()) {
      const auto& p = surface.point(v);
      made[i++] = {p[0], p[1], p[2]};
    }
    std::rotate(made.begin(), std::ranges::min_element(made), made.end());
    found[surface.data(f).slab].insert(made);
  }
  return found;
}

TEST(Forks, AnEditOfASliceChangesAForkNextToItsSlabsAndNothingElseThere) {
  auto slices = stacks::Torus::slices(16, 20);
  const std::size_t forked = forked_slabs(slices).front();
  const auto before = faces_by_slab(slices);
  for (Contour& contour : slices[forked + 2].contours)
    for (cdt::Point& p : contour.points) p.y *= 0.9;
  const auto after = faces_by_slab(slices);
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [slab, triangles] : before) {
    const bool is_beside = slab == forked + 1 || slab == forked + 2;
    if (is_beside || slab == forked) {
      EXPECT_NE(triangles, after.at(slab)) << slab;
    } else if (slab < forked || slab > forked + 3) {
      EXPECT_EQ(triangles, after.at(slab)) << slab;
    }
  }
}

TEST(Forks, FollowEditsOfTheSlicesBeforeAndBeyondLive) {
  auto slices = stacks::Torus::slices(16, 20);
  const std::size_t forked = forked_slabs(slices).front();
  const Options options;
  Reconstruction live(options);
  for (const Slice& slice : slices) live.insert(slice);
  for (const std::size_t edited : {forked - 1, forked, forked + 1, forked + 2}) {
    for (Contour& contour : slices[edited].contours)
      for (cdt::Point& p : contour.points) p.y *= 0.95;
    const SurfaceChange change = live.replace(slices[edited].z, slices[edited]);
    EXPECT_LE(change.added.size(), 4U);
    const auto is_forked = [&](const SlabInfo& slab) { return slab.low == slices[forked].z; };
    EXPECT_TRUE(std::ranges::any_of(change.added, is_forked)) << edited;
    EXPECT_EQ(edits::difference(live, options), "");
    EXPECT_EQ(edits::broken(live.surface()), "");
  }
}

// In a slice of many parts an edit keeps the tiles of the others; not those of forks, which may
// follow it.
TEST(Forks, BesideManyPartsFollowEditsLive) {
  auto slices = stacks::Torus::slices(16, 20);
  for (Slice& slice : slices)
    for (int i = 0; i < 12; ++i)
      slice.contours.push_back(stacks::circle(12, 0.5, {9.0 + 2 * i, 0.1 * slice.z}));
  const std::size_t forked = forked_slabs(slices).front();
  const Options options;
  Reconstruction live(options);
  for (const Slice& slice : slices) live.insert(slice);
  for (const std::size_t edited : {forked - 1, forked, forked + 1, forked + 2}) {
    for (const std::size_t contour : {std::size_t{0}, slices[edited].contours.size() - 3}) {
      for (cdt::Point& p : slices[edited].contours[contour].points) p.y *= 0.95;
      live.replace(slices[edited].z, slices[edited]);
      EXPECT_EQ(edits::difference(live, options), "");
      EXPECT_EQ(edits::broken(live.surface()), "");
      EXPECT_EQ(solids::faults(live.snapshot().surface(1)), "");
    }
  }
}

}  // namespace
}  // namespace loft
