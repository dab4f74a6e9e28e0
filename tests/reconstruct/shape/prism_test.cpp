// SPDX-License-Identifier: MIT
#include "reconstruct/shape/prism.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesh/vec3.h"

namespace loft {
namespace {

Vec3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution coordinate(-size, size);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

/// A place of a triangle.
Vec3 random_place(std::mt19937& random, const Corners& t) {
  std::uniform_real_distribution share(0.0, 1.0);
  const double s = share(random);
  const double u = share(random) * (1 - s);
  return along(along(t[0], s, minus(t[1], t[0])), u, minus(t[2], t[0]));
}

/// Whatever their shapes, and far from the origin as well: slivers, too, whose normals are
/// rounding.
TEST(Prism, MayMeetWhatComesWithinTheDistance) {
  constexpr unsigned seed = 43;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const double width : {1.0, 1e-3, 1e-8, 1e-15, 0.0}) {
    for (const double far : {0.0, 1e5}) {
      for (int i = 0; i < 300; ++i) {
        const Vec3 start{far, -far, far};
        const Vec3 a = along(start, 1, random_vector(random, 1));
        const Vec3 b = along(start, 1, random_vector(random, 1));
        const Vec3 c = along(along(a, 0.3, minus(b, a)), 1, random_vector(random, width));
        const Corners triangle{a, b, c};
        Vec3 way = random_vector(random, 1);
        const double distance = 0.1;
        way = along({}, 0.99 * distance / std::max(length(way), 1e-3), way);
        const Vec3 near = along(random_place(random, triangle), 1, way);
        const Corners other{near, along(near, 1, random_vector(random, 3)),
                            along(near, 1, random_vector(random, 3))};
        ASSERT_TRUE(Prism(triangle, distance).may_meet(other)) << width << ' ' << far << ' ' << i;
      }
    }
  }
}

TEST(Prism, TellsSliversSideBySideApartThoughTheirBoxesMeet) {
  const auto sliver = [](double at) {
    return Corners{Vec3{at, 0, 0}, Vec3{at + 0.01, 0, 0}, Vec3{at + 1, 1, 1}};
  };
  const Prism prism(sliver(0), 0.001);
  EXPECT_TRUE(prism.may_meet(sliver(0)));
  EXPECT_TRUE(prism.may_meet(sliver(0.01)));
  EXPECT_FALSE(prism.may_meet(sliver(0.05)));
  EXPECT_FALSE(prism.may_meet(sliver(-0.05)));
}

TEST(Prism, TellsTrianglesOverEachOtherApart) {
  const auto over = [](double z) { return Corners{Vec3{0, 0, z}, {1, 0, z + 1}, {0, 1, z}}; };
  const Prism prism(over(0), 0.1);
  EXPECT_TRUE(prism.may_meet(over(0.1)));
  EXPECT_FALSE(prism.may_meet(over(0.2)));
  EXPECT_FALSE(prism.may_meet(over(-0.2)));
}

}  // namespace
}  // namespace loft
