// SPDX-License-Identifier: MIT
#include "fields/volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/fields/edited.h"

namespace loft::fields {
namespace {

using Doubles = std::vector<double>;

[[nodiscard]] Field pyramid(double height) {
  Field field;
  for (const Point p : {Point{0, 0}, Point{4, 0}, Point{4, 4}, Point{0, 4}})
    field.insert(Sample{p, 0});
  field.insert(Sample{{2, 2}, height});
  return field;
}

TEST(Volume, OfAPyramid) {
  const Volume whole = volume(pyramid(6), 0);
  EXPECT_DOUBLE_EQ(whole.above, 32);
  EXPECT_EQ(whole.below, 0);
  EXPECT_DOUBLE_EQ(whole.area(), 16);
  const Volume tip = volume(pyramid(6), 3);
  EXPECT_DOUBLE_EQ(tip.above, 4);
  EXPECT_DOUBLE_EQ(tip.below, 20);
  EXPECT_DOUBLE_EQ(tip.area_above, 4);
}

TEST(Volume, WithinPolygons) {
  const overlay::MultiPolygon quarter{{.outer = {{2, 0}, {4, 0}, {4, 2}, {2, 2}}, .holes = {}}};
  EXPECT_DOUBLE_EQ(volume(pyramid(6), 0, quarter).above, 8);
  const overlay::MultiPolygon rest{
      {.outer = {{-1, -1}, {5, -1}, {5, 5}, {-1, 5}}, .holes = {{{2, 0}, {2, 2}, {4, 2}, {4, 0}}}}};
  EXPECT_DOUBLE_EQ(volume(pyramid(6), 0, rest).above, 24);
  EXPECT_DOUBLE_EQ(volume(pyramid(6), 0, rest).area(), 12);
}

TEST(Volume, BetweenTwoSurfaces) {
  const Volume between = volume_between(pyramid(6), pyramid(3));
  EXPECT_DOUBLE_EQ(between.above, 16);
  EXPECT_EQ(between.below, 0);
  EXPECT_DOUBLE_EQ(volume_between(pyramid(3), pyramid(6)).below, 16);
}

TEST(Volume, AreasBySlope) {
  Field field = pyramid(2);
  const std::vector<double> areas = areas_by_slope(field, Doubles{0.5, 1, 2});
  EXPECT_EQ(areas, (Doubles{0, 0, 16, 0}));
}

TEST(Volume, IsOverAndUnderALevelTogether) {
  for (std::uint64_t seed = 0; seed < fields_to_try(40); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Field& field = edited.field();
    const Volume whole = volume(field, 0);
    const double size = 1 + whole.above + whole.below;
    for (const double level : {3.0, 17.25, 40.0, 80.0}) {
      const Volume part = volume(field, level);
      EXPECT_NEAR(part.area(), whole.area(), 1e-12 * size);
      EXPECT_NEAR(level * part.area() + part.above - part.below, whole.above - whole.below,
                  1e-12 * (size + level * part.area()));
    }
    // The same, whoever cuts it.
    const overlay::MultiPolygon west{
        {.outer = {{-5, -5}, {7.3, -5}, {9.1, 30}, {-5, 30}}, .holes = {}}};
    const overlay::MultiPolygon east{
        {.outer = {{7.3, -5}, {30, -5}, {30, 30}, {9.1, 30}}, .holes = {}}};
    const Volume a = volume(field, 17.25, west);
    const Volume b = volume(field, 17.25, east);
    const Volume both = volume(field, 17.25);
    EXPECT_NEAR(a.above + b.above, both.above, 1e-9 * size);
    EXPECT_NEAR(a.below + b.below, both.below, 1e-9 * size);
    EXPECT_NEAR(a.area() + b.area(), both.area(), 1e-9 * size);
    const Volume none = volume_between(field, field);
    EXPECT_NEAR(none.above, 0, 1e-9 * size);
    EXPECT_NEAR(none.area(), both.area(), 1e-9 * size);
  }
}

TEST(Volume, DependsOnNothingButTheField) {
  for (std::uint64_t seed = 500; seed < 500 + fields_to_try(20); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Field fresh = edited.built();
    if (!edited.field().mesh().snaps().empty() || !fresh.mesh().snaps().empty()) continue;
    EXPECT_EQ(volume(edited.field(), 17.25).above, volume(fresh, 17.25).above);
  }
}

}  // namespace
}  // namespace loft::fields
