// SPDX-License-Identifier: MIT
#include "fields/field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/cases.h"

namespace loft::fields {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;
using testing::Optional;

using Points = std::vector<Point>;
using Doubles = std::vector<double>;

/// A square from 0 to 10 with the values of a plane at its corners.
template <class Plane>
Field square(Plane plane) {
  Field field;
  for (const Point p : {Point{0, 0}, Point{10, 0}, Point{10, 10}, Point{0, 10}})
    field.insert(Sample{p, plane(p)});
  return field;
}

double tilted(Point p) { return p.x + 2 * p.y; }

// scipy/scipy#9737, #22831: points of which others say that they are nowhere.
TEST(Field, GivesSamplesBackBitForBit) {
  const std::vector<Sample> samples{{{42.95140444448968, 324.3801108160104}, 8.915229885057471},
                                    {{42.94872182954715, 324.3805993217575}, 8.943965517241379},
                                    {{42.94886055081152, 324.3806075832518}, 9.030172413793105},
                                    {{42.94870954506439, 324.3804284884243}, 8.96551724137931},
                                    {{42.94869726058163, 324.3802576550909}, 8.994252873563218},
                                    {{42.95140444448968, 324.3801108160104}, 8.915229885057471}};
  Field field;
  field.insert(samples);
  for (const Sample& s : samples) {
    EXPECT_EQ(field.value(s.place), s.value);
    EXPECT_EQ(field.value(s.place, Smoothness::cubic), s.value);
  }
  EXPECT_TRUE(field.conflicts().empty());
}

TEST(Field, HasValuesOnTheHullAndNoneBeyond) {
  Field field;
  field.insert(std::vector<Sample>{{{0, 0}, 1}, {{0, 0.008016}, 1}, {{3, -2}, 1}});
  EXPECT_EQ(field.value({1.5, -1}), 1);
  const Point beyond{1.7999999999999998, -1.2};
  EXPECT_EQ(field.value(beyond), std::nullopt);
  EXPECT_EQ(field.value(beyond, Smoothness::linear, Side::left, Outside::nearest), 1);
}

TEST(Field, HasValuesEverywhereOnItsHull) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> step(0, std::int64_t{1} << 40);
  const Field field = square(tilted);
  const double unit = std::ldexp(10, -40);
  for (std::uint64_t i = 0; i < cases(250'000); ++i) {
    const double t = static_cast<double>(step(random)) * unit;
    for (const Point p : {Point{t, 0}, Point{10, t}, Point{t, 10}, Point{0, t}}) {
      const std::optional<double> value = field.value(p);
      ASSERT_TRUE(value && std::abs(*value - tilted(p)) < 1e-13) << p;
    }
  }
}

TEST(Field, IsWhatOneSampleOrTwoSay) {
  Field field;
  EXPECT_EQ(field.value({0, 0}), std::nullopt);
  const SampleId only = field.insert(Sample{{1, 2}, 5});
  EXPECT_EQ(field.value({1, 2}), 5);
  EXPECT_EQ(field.value({1, 3}), std::nullopt);
  EXPECT_EQ(field.value({1, 3}, Smoothness::cubic, Side::left, Outside::nearest), 5);
  field.insert(Sample{{3, 2}, 9});
  EXPECT_EQ(field.value({1.5, 2}), 6);
  EXPECT_EQ(field.value({1.5, 7}, Smoothness::linear, Side::left, Outside::nearest), 6);
  EXPECT_EQ(field.value({9, 7}, Smoothness::linear, Side::right, Outside::nearest), 9);
  field.remove(only);
  EXPECT_EQ(field.value({1, 2}), std::nullopt);
  EXPECT_EQ(field.value({3, 2}), 9);
}

TEST(Field, FollowsSamplesThatMoveAndChange) {
  Field field = square([](Point) { return 1.0; });
  const SampleId peak = field.insert(Sample{{5, 5}, 3});
  EXPECT_EQ(field.value({5, 5}), 3);
  field.move(peak, {5, 4});
  EXPECT_EQ(field.value({5, 4}), 3);
  EXPECT_LT(field.value({5, 5}), 3);
  field.set_value(peak, 7);
  EXPECT_EQ(field.value({5, 4}), 7);
  field.remove(peak);
  EXPECT_EQ(field.value({5, 4}), 1);
}

// gwlucastrig/Tinfour#51.
TEST(Field, TellsOfFeaturesThatCrossWithDifferentValues) {
  Field field;
  const LineId up = field.insert(Line{.points = Points{{0, 0}, {2, 2}}, .values = Doubles{0, 2}});
  field.insert(Line{.points = Points{{0, 2}, {2, 0}}, .values = Doubles{4, 6}});
  const std::vector<Conflict> conflicts = field.conflicts();
  ASSERT_EQ(conflicts.size(), 1U);
  EXPECT_EQ(conflicts[0].place, Point(1, 1));
  ASSERT_EQ(conflicts[0].claims.size(), 2U);
  EXPECT_EQ(conflicts[0].claims[0].line, up);
  EXPECT_EQ(conflicts[0].claims[0].value, 1);
  EXPECT_EQ(conflicts[0].claims[1].value, 5);
  EXPECT_EQ(conflicts[0].taken, 3);
  EXPECT_EQ(field.value({1, 1}), 3);
  field.remove(up);
  EXPECT_TRUE(field.conflicts().empty());
  EXPECT_EQ(field.value({1, 1}), 5);
}

TEST(Field, TakesTheFirstValueIfAskedTo) {
  Field field(OnConflict::first);
  const SampleId high = field.insert(Sample{{1, 1}, 8});
  field.insert(Sample{{1, 1}, 2});
  EXPECT_EQ(field.value({1, 1}), 8);
  ASSERT_EQ(field.conflicts().size(), 1U);
  EXPECT_EQ(field.conflicts()[0].taken, 8);
  field.remove(high);
  EXPECT_EQ(field.value({1, 1}), 2);
}

TEST(Field, RefusesConflictsIfAskedTo) {
  Field field(OnConflict::refuse);
  field.insert(Line{.points = Points{{0, 0}, {2, 2}}, .values = Doubles{0, 2}});
  const auto cross = [&] {
    field.insert(Line{.points = Points{{0, 2}, {2, 0}}, .values = Doubles{4, 6}});
  };
  EXPECT_THAT(cross, testing::ThrowsMessage<std::invalid_argument>(HasSubstr("(1, 1)")));
  EXPECT_EQ(field.value({1, 1}), 1);
  EXPECT_EQ(field.mesh().constraint_count(), 1U);
  const SampleId beside = field.insert(Sample{{0, 2}, 4});
  EXPECT_THROW(field.move(beside, {1, 1}), std::invalid_argument);
  EXPECT_EQ(field.sample(beside).place, Point(0, 2));
  field.set_value(beside, 1);
  field.move(beside, {1, 1});
  EXPECT_THROW(field.set_value(beside, 2), std::invalid_argument);
  EXPECT_EQ(field.value({1, 1}), 1);
}

// Where lines cross the place is rounded, and so are their values there.
TEST(Field, TakesRoundedValuesForNoConflict) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(-3, 7);
  for (int i = 0; i < 200; ++i) {
    Field field;
    for (int k = 0; k < 6; ++k) {
      Points points{{anywhere(random), anywhere(random)}, {anywhere(random), anywhere(random)}};
      field.insert(Line{.points = points, .values = Doubles{tilted(points[0]), tilted(points[1])}});
    }
    ASSERT_TRUE(field.conflicts().empty());
  }
}

// qgis/QGIS#44501.
TEST(Field, SoftLinesLieOnWhatIsThere) {
  Field field = square(tilted);
  field.insert(Line{.points = Points{{2, 3}, {7, 8}}, .kind = LineKind::soft});
  EXPECT_THAT(field.value({2, 3}), Optional(8));
  EXPECT_THAT(field.value({7, 8}), Optional(23));
  EXPECT_THAT(field.value({4, 5}), Optional(DoubleNear(14, 1e-13)));
  EXPECT_THAT(field.value({5, 5}), Optional(DoubleNear(15, 1e-13)));
}

TEST(Field, SoftLinesFollowTheSurface) {
  Field field = square([](Point) { return 0.0; });
  const LineId soft = field.insert(Line{.points = Points{{4, 2}, {4, 8}}, .kind = LineKind::soft});
  const SampleId hill = field.insert(Sample{{5, 5}, 10});
  Field without = square([](Point) { return 0.0; });
  const SampleId same = without.insert(Sample{{5, 5}, 10});
  EXPECT_EQ(field.value({4, 2}), without.value({4, 2}));
  field.move(hill, {2, 3});
  without.move(same, {2, 3});
  EXPECT_EQ(field.value({4, 2}), without.value({4, 2}));
  field.remove(soft);
  EXPECT_EQ(field.value({4, 2}), without.value({4, 2}));
}

TEST(Field, WallsHaveAValueOnEachSide) {
  Field field = square([](Point p) { return p.x < 5 ? 1.0 : 2.0; });
  field.insert(Line{.points = Points{{5, 0}, {5, 10}},
                    .kind = LineKind::wall,
                    .left = Doubles{1, 1},
                    .right = Doubles{2, 2}});
  for (const Smoothness smoothness : {Smoothness::linear, Smoothness::cubic}) {
    EXPECT_THAT(field.value({4.999, 5}, smoothness), Optional(DoubleNear(1, 1e-15)));
    EXPECT_THAT(field.value({5.001, 5}, smoothness), Optional(DoubleNear(2, 1e-15)));
    EXPECT_EQ(field.value({5, 5}, smoothness, Side::left), 1);
    EXPECT_EQ(field.value({5, 5}, smoothness, Side::right), 2);
    EXPECT_EQ(field.value({5, 10}, smoothness, Side::left), 1);
    EXPECT_EQ(field.value({5, 0}, smoothness, Side::right), 2);
  }
  EXPECT_TRUE(field.conflicts().empty());
}

TEST(Field, AWallThatEndsWithinIsToldOfIfItStillJumps) {
  Field field = square([](Point) { return 0.0; });
  field.insert(Line{.points = Points{{5, 0}, {5, 5}},
                    .kind = LineKind::wall,
                    .left = Doubles{1, 2},
                    .right = Doubles{3, 2}});
  EXPECT_TRUE(field.conflicts().empty());
  const LineId other = field.insert(Line{.points = Points{{2, 0}, {2, 5}},
                                         .kind = LineKind::wall,
                                         .left = Doubles{1, 1},
                                         .right = Doubles{3, 4}});
  ASSERT_EQ(field.conflicts().size(), 1U);
  EXPECT_EQ(field.conflicts()[0].place, Point(2, 5));
  EXPECT_EQ(field.conflicts()[0].claims[0].line, other);
}

TEST(Field, BarriersTakeWhatIsOnTheirSide) {
  Field field = square([](Point p) { return p.x < 5 ? tilted(p) : 100.0 - p.y; });
  for (double y = 1; y < 10; y += 2) {
    field.insert(Sample{{2, y}, tilted({2, y})});
    field.insert(Sample{{8, y}, 100 - y});
  }
  field.insert(Line{.points = Points{{5, 0}, {4, 5}, {5, 10}}, .kind = LineKind::barrier});
  EXPECT_THAT(field.value({3.5, 5}), Optional(DoubleNear(13.5, 1e-12)));
  EXPECT_THAT(field.value({4, 5}, Smoothness::linear, Side::left), Optional(DoubleNear(14, 1e-12)));
  EXPECT_THAT(field.value({4, 5}, Smoothness::linear, Side::right),
              Optional(DoubleNear(95, 1e-12)));
  EXPECT_THAT(field.value({6, 5}), Optional(DoubleNear(95, 1e-12)));
}

TEST(Field, ThereIsNoValueWhereABarrierEnclosesNone) {
  Field field = square(tilted);
  const LineId pond = field.insert(Line{.points = Points{{4, 4}, {6, 4}, {6, 6}, {4, 6}},
                                        .kind = LineKind::barrier,
                                        .ends = cdt::closed});
  EXPECT_EQ(field.value({5, 5}), std::nullopt);
  EXPECT_EQ(field.value({4, 5}, Smoothness::cubic, Side::left), std::nullopt);
  EXPECT_THAT(field.value({4, 5}, Smoothness::linear, Side::right),
              Optional(DoubleNear(14, 1e-12)));
  field.insert(Sample{{5, 5.5}, 3});
  EXPECT_EQ(field.value({5, 5}), 3);
  field.remove(pond);
  EXPECT_NE(field.value({5, 5}), std::nullopt);
}

TEST(Field, RefusesWhatItCannotUse) {
  Field field;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(field.insert(Sample{{nan, 0}, 1}), std::invalid_argument);
  EXPECT_THROW(field.insert(Sample{{0, 1e80}, 1}), std::invalid_argument);
  EXPECT_THROW(field.insert(Sample{{0, 0}, nan}), std::invalid_argument);
  EXPECT_THROW(field.insert(Sample{{0, 0}, -1e200}), std::invalid_argument);
  EXPECT_THROW(field.insert(Line{}), std::invalid_argument);
  const Points twice{{1, 1}, {1, 1}};
  EXPECT_THROW(field.insert(Line{.points = twice, .kind = LineKind::soft}), std::invalid_argument);
  const Points two{{1, 1}, {1, 2}};
  EXPECT_THROW(field.insert(Line{.points = two}), std::invalid_argument);
  EXPECT_THROW(field.insert(Line{.points = two, .values = Doubles{1, nan}}), std::invalid_argument);
  EXPECT_THROW(field.insert(Line{.points = two, .kind = LineKind::wall, .left = Doubles{1, 2}}),
               std::invalid_argument);
  EXPECT_THROW(field.remove(SampleId(0)), std::invalid_argument);
  EXPECT_THROW(field.remove(LineId(3)), std::invalid_argument);
  EXPECT_THROW(field.move(SampleId(), {0, 0}), std::invalid_argument);
  EXPECT_EQ(field.mesh().vertex_count(), 0U);
  const SampleId one = field.insert(Sample{{0, 0}, 1});
  EXPECT_THROW(field.remove(LineId(one.index())), std::invalid_argument);
  EXPECT_THROW(field.move(one, {nan, 0}), std::invalid_argument);
  EXPECT_EQ(field.value({0, 0}), 1);
}

TEST(Field, BeyondTheHullTakesTheNearestPlace) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(0, 1);
  Field field;
  std::vector<Sample> samples;
  for (int i = 0; i < 40; ++i)
    samples.push_back({{anywhere(random), anywhere(random)}, anywhere(random)});
  field.insert(samples);
  std::uniform_real_distribution<double> around(-2, 3);
  for (int i = 0; i < 500; ++i) {
    const Point p{around(random), around(random)};
    if (field.value(p)) continue;
    double least = std::numeric_limits<double>::infinity();
    double expected = 0;
    const Triangulation& mesh = field.mesh();
    for (std::uint32_t e = 0; e < mesh.edge_bound(); ++e) {
      const EdgeId edge(e);
      if (!mesh.is_triangle(Triangulation::triangle(edge)) ||
          mesh.apex(edge) != Triangulation::infinite)
        continue;
      for (double t = 0; t <= 1; t += 1.0 / 1024) {
        const Point a = mesh.point(mesh.from(edge));
        const Point b = mesh.point(mesh.to(edge));
        const Point q{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        const double distance = std::hypot(p.x - q.x, p.y - q.y);
        if (distance >= least) continue;
        least = distance;
        expected = field.edge_value(mesh.twin(edge), q);
      }
    }
    ASSERT_THAT(field.value(p, Smoothness::linear, Side::left, Outside::nearest),
                Optional(DoubleNear(expected, 2e-3)));
  }
}

}  // namespace
}  // namespace loft::fields
