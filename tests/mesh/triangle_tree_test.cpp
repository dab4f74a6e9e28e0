// SPDX-License-Identifier: MIT
#include "mesh/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace loft {
namespace {

TEST(TriangleTree, FindsAllThatMeetWhileTrianglesComeChangeAndGo) {
  constexpr unsigned seed = 32;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 20);
  std::uniform_real_distribution<double> offset(-1, 1);
  const auto triangle = [&] {
    const Vec3 p{place(random), place(random), place(random)};
    const Vec3 way{5 * offset(random), 5 * offset(random), offset(random)};
    return Corners{p, Vec3{p[0] + way[0], p[1] + way[1], p[2] + way[2]},
                   Vec3{p[0] + 0.05, p[1], p[2] + 0.05 * offset(random)}};
  };
  std::vector<Corners> triangles(50);
  for (Corners& t : triangles) t = triangle();
  TriangleTree tree(triangles);
  std::vector<bool> is_there(triangles.size(), true);
  for (int step = 0; step < 1500; ++step) {
    const auto number = static_cast<std::uint32_t>(random() % triangles.size());
    if (step % 3 == 0) {
      triangles.push_back(triangle());
      is_there.push_back(true);
      tree.add(triangles.back(), number);
    } else if (is_there[number] && step % 3 == 1) {
      triangles[number] = triangle();
      tree.update(number, triangles[number]);
    } else if (is_there[number]) {
      is_there[number] = false;
      tree.remove(number);
    }
    if (step % 10 != 0) continue;
    const Corners query = triangle();
    std::multiset<std::uint32_t> found;
    EXPECT_TRUE(tree.all_of_meeting(query, [&](std::uint32_t n, const Corners& there) {
      EXPECT_EQ(there, triangles[n]);
      found.insert(n);
      return true;
    }));
    for (std::uint32_t n = 0; n < triangles.size(); ++n) {
      EXPECT_LE(found.count(n), is_there[n] ? 1U : 0U) << n;
      if (is_there[n] && triangles_meet(query, triangles[n])) {
        EXPECT_TRUE(found.contains(n)) << n;
      }
    }
  }
}

/// Long thin triangles side by side, slanted: boxes along the axes would all meet.
TEST(TriangleTree, TestsAFewTrianglesHoweverThinTheyAre) {
  const auto needle = [](double at) {
    return Corners{Vec3{std::cos(at), std::sin(at), 0}, Vec3{std::cos(at), std::sin(at), 1e-4},
                   Vec3{2 * std::cos(at + 0.5), 2 * std::sin(at + 0.5), 1}};
  };
  for (const int count : {1000, 16000}) {
    std::vector<Corners> triangles;
    for (int i = 0; i < count; ++i) triangles.push_back(needle(2 * std::numbers::pi * i / count));
    const TriangleTree tree(triangles);
    int tested = 0;
    for (int i = 0; i < 100; ++i) {
      EXPECT_TRUE(tree.all_of_meeting(needle(0.06 * i), [&](std::uint32_t, const Corners&) {
        ++tested;
        return true;
      }));
    }
    EXPECT_LT(tested, 100 * 60) << count;
  }
}

TEST(TriangleTree, WithoutTrianglesMeetsNothing) {
  const Corners one{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const auto never = [](std::uint32_t, const Corners&) { return false; };
  EXPECT_TRUE(TriangleTree().all_of_meeting(one, never));
  EXPECT_TRUE(TriangleTree(std::vector<Corners>{}).all_of_meeting(one, never));
  EXPECT_FALSE(TriangleTree(std::vector{one}).all_of_meeting(one, never));
}

}  // namespace
}  // namespace loft
