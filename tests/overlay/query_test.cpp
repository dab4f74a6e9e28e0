// SPDX-License-Identifier: MIT
#include "overlay/query.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "overlay/boolean.h"
#include "tests/cases.h"
#include "tests/overlay/boxes.h"

namespace loft::overlay {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Query, TheNearestBorder) {
  Overlay overlay;
  EXPECT_FALSE(nearest_border(overlay, {0, 0}));
  const LayerId a = overlay.add_layer("a");
  const LayerId b = overlay.add_layer("b");
  overlay.insert(a, square(0, 0, 10));
  overlay.insert(b, square(4, 4, 2));
  overlay.insert(b, std::vector<Point>{{0, 5}, {4, 5}}, open);  // a line is no border
  const auto nearest = nearest_border(overlay, {3, 5});
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->place, (Point{4, 5}));
  EXPECT_EQ(nearest->distance, 1);
  EXPECT_EQ(nearest_border(overlay, {3, 5}, a)->distance, 3);
  EXPECT_EQ(nearest_border(overlay, {-3, -4})->distance, 5);
  EXPECT_EQ(nearest_border(overlay, {100, 5}, b)->place, (Point{6, 5}));
}

/// Random shapes in three layers.
class Shapes {
 public:
  explicit Shapes(std::uint64_t seed) : random_(seed) {
    for (int i = 0; i < 3; ++i) {
      const LayerId layer = overlay.add_layer(std::to_string(i));
      for (int k = 0; k < 3; ++k) {
        Ring ring;
        for (int j = 0; j < 4; ++j) ring.push_back(place());
        overlay.insert(layer, ring);
      }
    }
  }

  Point place() { return {number(), number()}; }
  double number() { return static_cast<double>(random_() % 40) / 2 - 4; }

  Overlay overlay;

 private:
  std::mt19937_64 random_;
};

TEST(Query, TheNearestBorderIsThatOfAll) {
  for (std::uint64_t seed = 0; seed < cases(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Shapes shapes(seed);
    for (std::uint32_t l = 0; l < 3; ++l) {
      const ResultId result = shapes.overlay.watch(LayerId(l));
      for (int i = 0; i < 10; ++i) {
        const Point p = shapes.place();
        double least = INFINITY;
        for (const BorderEdge& edge : shapes.overlay.border(result)) {
          const double x = edge.to.x - edge.from.x;
          const double y = edge.to.y - edge.from.y;
          const double t = std::clamp(
              ((p.x - edge.from.x) * x + (p.y - edge.from.y) * y) / (x * x + y * y), 0.0, 1.0);
          least = std::min(least, std::hypot(p.x - edge.from.x - t * x, p.y - edge.from.y - t * y));
        }
        const auto nearest = nearest_border(shapes.overlay, p, LayerId(l));
        ASSERT_EQ(nearest.has_value(), std::isfinite(least));
        if (nearest) {
          ASSERT_NEAR(nearest->distance, least, 1e-12);
        }
      }
    }
  }
}

/// The layers that share area with a box, as operations have it.
std::vector<LayerId> layers_by_hand(Overlay& overlay, const cdt::Box& where) {
  const MultiPolygon frame{{box(where.low.x, where.low.y, where.high.x, where.high.y), {}}};
  std::vector<LayerId> result;
  for (std::uint32_t l = 0; l < 3; ++l) {
    const ResultId layer = overlay.watch(LayerId(l));
    if (!intersect(overlay.polygons(layer), frame).empty()) result.emplace_back(l);
    overlay.unwatch(layer);
  }
  return result;
}

/// Shapes that only touch the box may be an ulp inside, as crossings are rounded.
TEST(Query, WhatIsInABox) {
  for (std::uint64_t seed = 0; seed < cases(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Shapes shapes(seed);
    for (int i = 0; i < 10; ++i) {
      cdt::Box where;
      where.add(shapes.place());
      where.add(shapes.place());
      const auto grown = [&](double by) {
        return cdt::Box{{where.low.x - by, where.low.y - by},
                        {where.high.x + by, where.high.y + by}};
      };
      const auto got = layers_in(shapes.overlay, where);
      if (where.low.x == where.high.x || where.low.y == where.high.y) {
        ASSERT_THAT(got, IsEmpty());
        continue;
      }
      ASSERT_TRUE(std::ranges::includes(got, layers_by_hand(shapes.overlay, grown(-1e-9))));
      ASSERT_TRUE(std::ranges::includes(layers_by_hand(shapes.overlay, grown(1e-9)), got));
    }
  }
}

TEST(Query, WhatIsNearAPoint) {
  Overlay overlay;
  const LayerId a = overlay.add_layer("a");
  const LayerId b = overlay.add_layer("b");
  overlay.insert(a, square(0, 0, 2));
  overlay.insert(b, square(2, 0, 2));
  EXPECT_THAT(layers_near(overlay, {1, 1}, 1), ElementsAre(a));
  EXPECT_THAT(layers_near(overlay, {1, 1}, 1.001), ElementsAre(a, b));
  EXPECT_THAT(layers_near(overlay, {7, 1}, 3), IsEmpty());
  EXPECT_THAT(layers_near(overlay, {7, 1}, 3.5), ElementsAre(b));
  EXPECT_THAT(layers_near(overlay, {7, 1}, 0), IsEmpty());
}

}  // namespace
}  // namespace loft::overlay
