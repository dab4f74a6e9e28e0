// SPDX-License-Identifier: MIT
#include "fields/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "cdt/predicates.h"
#include "tests/fields/edited.h"

namespace loft::fields {
namespace {

using testing::ElementsAre;

using Points = std::vector<Point>;
using Doubles = std::vector<double>;

[[nodiscard]] ProfilePoint entry(Point place, double distance, std::optional<double> before,
                                 std::optional<double> after) {
  return {.place = place, .distance = distance, .before = before, .after = after};
}

/// Two triangles, (0, 0) to (2, 2) between them, and a peak at (2, 2).
[[nodiscard]] Field roof() {
  Field field;
  field.insert(Line{.points = Points{{0, 0}, {2, 2}}, .values = Doubles{0, 4}});
  field.insert(Sample{{2, 0}, 0});
  field.insert(Sample{{0, 2}, 0});
  return field;
}

TEST(Profile, HasAnEntryAtEachCrossing) {
  EXPECT_THAT(profile(roof(), Points{{0.5, 1.5}, {1.5, 0.5}}),
              ElementsAre(entry({0.5, 1.5}, 0, 1, 1), entry({1, 1}, std::sqrt(0.5), 2, 2),
                          entry({1.5, 0.5}, std::sqrt(2), 1, 1)));
}

TEST(Profile, ComesFromBeyondTheHullAndGoesThere) {
  const std::optional<double> none;
  EXPECT_THAT(
      profile(roof(), Points{{-1, 1}, {3, 1}}),
      ElementsAre(entry({-1, 1}, 0, none, none), entry({0, 1}, 1, none, 0), entry({1, 1}, 2, 2, 2),
                  entry({2, 1}, 3, 2, none), entry({3, 1}, 4, none, none)));
  EXPECT_THAT(profile(roof(), Points{{-1, 1}, {1, -1}}),
              ElementsAre(entry({-1, 1}, 0, none, none), entry({0, 0}, std::sqrt(2), 0, 0),
                          entry({1, -1}, 2 * std::sqrt(2), none, none)));
  EXPECT_THAT(profile(roof(), Points{{-1, 5}, {3, 5}}),
              ElementsAre(entry({-1, 5}, 0, none, none), entry({3, 5}, 4, none, none)));
  EXPECT_TRUE(profile(roof(), Points{{1, 1}, {1, 1}}).empty());
}

TEST(Profile, RunsAlongEdgesAndTurns) {
  EXPECT_THAT(profile(roof(), Points{{-1, -1}, {1, 1}, {1, 2}}),
              ElementsAre(entry({-1, -1}, 0, {}, {}), entry({0, 0}, std::sqrt(2), {}, 0),
                          entry({1, 1}, 2 * std::sqrt(2), 2, 2),
                          entry({1, 2}, 2 * std::sqrt(2) + 1, 2, 2)));
}

TEST(Profile, JumpsAtAWall) {
  Field field;
  for (const Point corner : {Point{0, 0}, Point{2, 0}, Point{2, 2}, Point{0, 2}})
    field.insert(Sample{corner, 0});
  field.insert(Line{.points = Points{{1, 0}, {1, 2}},
                    .kind = LineKind::wall,
                    .left = Doubles{1, 1},
                    .right = Doubles{7, 7}});
  const std::vector<ProfilePoint> points = profile(field, Points{{0.5, 1.5}, {1.5, 1.5}});
  double jump = 0;
  for (const ProfilePoint& point : points) jump += *point.after - *point.before;
  EXPECT_EQ(jump, 6);
  EXPECT_GE(climb(points).up, 6);
}

[[nodiscard]] bool is_same(std::optional<double> value, double inserted) {
  if (!value) return inserted != inserted;
  return std::abs(*value - inserted) <= 1e-11 * (64 + std::abs(*value));
}

/// The edges of a line that is in a field, and the values along it. Where a wall comes within
/// rounding of a point of the line, there is an entry before and one behind it.
void expect_as_inserted(const Field& field, std::span<const ProfilePoint> points, LineId line) {
  const Triangulation& mesh = field.mesh();
  std::size_t next = 0;
  for (const EdgeId e : mesh.pieces(cdt::ConstraintId(line.index())))
    for (const EdgeId corner : {e, Triangulation::next(e)}) {
      const Point place = mesh.point(mesh.from(corner));
      while (next < points.size() && points[next].place != place) ++next;
      ASSERT_LT(next, points.size()) << "no entry at " << place;
      if (field.is_separating(e)) continue;
      bool is_there = false;
      for (std::size_t i = next; i < points.size() && points[i].place == place; ++i)
        is_there = is_there || is_same(corner == e ? points[i].after : points[i].before,
                                       field.corner_value(corner));
      ASSERT_TRUE(is_there) << place;
    }
}

TEST(Profile, IsWhatTheLineIsOnOnceItIsInserted) {
  for (std::uint64_t seed = 0; seed < fields_to_try(100); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    // It does not cross itself.
    const Points line{edited.place(), edited.place(), edited.place()};
    Field field = edited.built();
    // What is there without soft lines is what one more is on.
    for (std::uint32_t i = 0; i < field.id_bound(); ++i)
      if (field.is_line(LineId(i)) && field.kind(LineId(i)) == LineKind::soft)
        field.remove(LineId(i));
    for (const Point corner : {Point{-1, -1}, Point{17, -1}, Point{17, 17}, Point{-1, 17}})
      field.insert(Sample{corner, 0});
    if (cdt::orient(line[0], line[1], line[2]) == 0) continue;
    const std::vector<ProfilePoint> points = profile(field, line);
    for (std::size_t i = 1; i < points.size(); ++i)
      ASSERT_LE(points[i - 1].distance, points[i].distance);
    const LineId soft = field.insert(Line{.points = line, .kind = LineKind::soft});
    if (!field.mesh().snaps().empty()) continue;
    ASSERT_NO_FATAL_FAILURE(expect_as_inserted(field, points, soft));
  }
}

}  // namespace
}  // namespace loft::fields
