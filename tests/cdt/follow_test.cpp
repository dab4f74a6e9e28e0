// SPDX-License-Identifier: MIT
#include "cdt/follow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "tests/cdt/player.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

/// The closed constraints that are around a triangle an odd number of times: sorted.
using Around = std::vector<ConstraintId>;

/// Crossing an edge takes each of its closed constraints in or out, once a passage.
struct InAndOut {
  const Triangulation* mesh;

  Around operator()(EdgeId e, Around value) const {
    for (const Passage passage : mesh->passages(e)) {
      const ConstraintId c = mesh->segment(passage.segment()).constraint;
      if (mesh->ends(c) != closed) continue;
      const auto place = std::ranges::lower_bound(value, c);
      if (place != value.end() && *place == c)
        value.erase(place);
      else
        value.insert(place, c);
    }
    return value;
  }
};

/// What follow() had to do by itself: triangles whose value is another one, but which no edit made
/// other than by moving corners.
std::vector<TriangleId> changed_by_hand(const Triangulation& mesh,
                                        const std::vector<Around>& before,
                                        const std::vector<Around>& after) {
  std::vector<TriangleId> changed;
  const auto& [unmade, made, moved] = mesh.changes();
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
    const TriangleId t(i);
    if (!mesh.is_triangle(t)) continue;
    if (std::ranges::binary_search(made, t) && !std::ranges::binary_search(moved, t)) continue;
    if (before[i] != after[i]) changed.push_back(t);
  }
  return changed;
}

/// Plays a script in batches of so many edits, and floods after each.
void expect_floods(std::uint64_t seed, Ground ground, std::size_t batch) {
  SCOPED_TRACE(std::string(name_of(ground)) + ", seed " + std::to_string(seed));
  Player player;
  const Triangulation& mesh = player.mesh();
  player.mesh().record_changes(true);
  Follower follower(mesh, Around{}, InAndOut{&mesh});
  const Script script = random_script(seed, ground, 200, 8);
  for (std::size_t i = 0; i < script.size(); i += batch) {
    const std::vector<Around> before = follower.values();
    if (batch > 1) player.mesh().begin_batch();
    for (std::size_t k = i; k < std::min(i + batch, script.size()); ++k) player.play(script[k]);
    if (batch > 1) player.mesh().end_batch();
    follower.follow(mesh.changes());
    const std::vector<Around> expected = flood(mesh, Around{}, InAndOut{&mesh});
    ASSERT_EQ(follower.values(), expected) << "edit " << i;
    if (batch > 1) continue;
    std::vector<TriangleId> changed(follower.changed().begin(), follower.changed().end());
    std::ranges::sort(changed);
    ASSERT_EQ(changed, changed_by_hand(mesh, before, expected)) << "edit " << i;
  }
}

class Follow : public ::testing::TestWithParam<Ground> {};

TEST_P(Follow, IsFlood) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) expect_floods(seed, GetParam(), 1);
}

TEST_P(Follow, OfBatchesIsFlood) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) expect_floods(seed, GetParam(), 7);
}

INSTANTIATE_TEST_SUITE_P(Grounds, Follow, ::testing::ValuesIn(all_grounds), [](const auto& chosen) {
  std::string name = name_of(chosen.param);
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

std::vector<Point> square(Point centre, double half) {
  return {{centre.x - half, centre.y - half},
          {centre.x + half, centre.y - half},
          {centre.x + half, centre.y + half},
          {centre.x - half, centre.y + half}};
}

TEST(Follower, SeesAPolygonJumpOverTrianglesThatStay) {
  Triangulation mesh;
  mesh.insert(square({0, 0}, 1), closed);
  mesh.insert(square({0, 0}, 50), closed);  // apart from what moves, so that nothing there is made
  const ConstraintId moving = mesh.insert(square({500, 0}, 100), closed);
  mesh.record_changes(true);
  Follower follower(mesh, Around{}, InAndOut{&mesh});
  const TriangleId middle = Triangulation::triangle(mesh.locate({0.25, 0.5}).edge);
  ASSERT_EQ(follower[middle].size(), 2U);
  mesh.translate(moving, {-500, 0});
  follower.follow(mesh.changes());
  ASSERT_FALSE(std::ranges::binary_search(mesh.changes().made, middle));
  EXPECT_EQ(follower[middle].size(), 3U);
  EXPECT_EQ(follower.changed().size(), 2U + 8U);  // of the small square, and around it
  mesh.remove(moving);
  follower.follow(mesh.changes());
  EXPECT_EQ(follower[middle].size(), 2U);
}

TEST(Follower, HasNothingToDoForWhatOnlyMoves) {
  Triangulation mesh;
  mesh.insert(square({0, 0}, 50), closed);
  const ConstraintId moving = mesh.insert(
      std::vector<Point>{{0, 0}, {5, 1}, {9, 0}, {8, 5}, {9, 9}, {4, 8}, {1, 9}, {0.5, 5}}, closed);
  mesh.record_changes(true);
  Follower follower(mesh, Around{}, InAndOut{&mesh});
  mesh.translate(moving, {1e-6, -1e-6});
  follower.follow(mesh.changes());
  EXPECT_FALSE(mesh.changes().moved.empty());
  EXPECT_TRUE(follower.unmade().empty());
  EXPECT_TRUE(follower.remade().empty());
  EXPECT_TRUE(follower.changed().empty());
  EXPECT_EQ(follower.values(), flood(mesh, Around{}, InAndOut{&mesh}));
}

TEST(Follower, BeginsAnew) {
  Triangulation mesh;
  mesh.record_changes(true);
  Follower follower(mesh, Around{}, InAndOut{&mesh});
  mesh.insert(square({0, 0}, 1), closed);
  follower.begin();
  EXPECT_EQ(follower.values(), flood(mesh, Around{}, InAndOut{&mesh}));
  mesh.clear();
  follower.begin();
  EXPECT_TRUE(follower.values().empty());
}

/// An int that counts how often it is compared: once for each triangle that is looked at.
struct Counted {
  int value = 0;
  static inline std::size_t comparisons = 0;
  friend bool operator==(const Counted& a, const Counted& b) {
    ++comparisons;
    return a.value == b.value;
  }
};

std::vector<Point> disc(Point centre, double radius) {
  std::vector<Point> points;
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6;
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return points;
}

/// How much is looked at where one of so many discs moves about, on average.
double looks_of_a_move(int count) {
  std::mt19937_64 random(7);
  const double size = std::sqrt(count);
  std::uniform_real_distribution<double> place(0, size);
  Triangulation mesh;
  std::vector<ConstraintId> ids;
  for (int i = 0; i < count; ++i)
    ids.push_back(mesh.insert(disc({place(random), place(random)}, 0.6), closed));
  mesh.record_changes(true);
  const auto count_up = [&mesh](EdgeId e, Counted depth) {
    for (const Passage passage : mesh.passages(e))
      depth.value += mesh.is_forward(e, passage) ? -1 : 1;
    return depth;
  };
  Follower follower(mesh, Counted{}, count_up);
  constexpr int moves = 100;
  Counted::comparisons = 0;
  for (int i = 0; i < moves; ++i) {
    mesh.translate(ids[static_cast<std::size_t>(i)], {place(random) / size, place(random) / size});
    follower.follow(mesh.changes());
  }
  const double looks = static_cast<double>(Counted::comparisons) / moves;
  EXPECT_EQ(follower.values(), flood(mesh, Counted{}, count_up));
  return looks;
}

TEST(Follower, LooksAtNoMoreInALargerScene) {
  const double few = looks_of_a_move(500);
  EXPECT_LT(looks_of_a_move(8000), 1.3 * few);
}

TEST(Batch, IsOneChange) {
  Triangulation mesh;
  mesh.insert(square({0, 0}, 9), closed);
  mesh.record_changes(true);
  mesh.begin_batch();
  const ConstraintId guest = mesh.insert(square({1, 1}, 2), closed);
  EXPECT_TRUE(mesh.changes().made.empty());
  mesh.remove(guest);
  mesh.end_batch();
  for (const TriangleId t : mesh.changes().made)
    EXPECT_TRUE(mesh.is_triangle(t));  // as they were, perhaps, but under other ids
  EXPECT_EQ(mesh.changes().made.size(), mesh.changes().unmade.size());
  EXPECT_LE(mesh.changes().made.size(), mesh.triangle_count());
}

}  // namespace
}  // namespace loft::cdt
