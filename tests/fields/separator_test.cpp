// SPDX-License-Identifier: MIT
#include "fields/separator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/cases.h"
#include "tests/fields/separators.h"

namespace loft::fields {
namespace {

/// The side by what a separator is said to be, in another way: whether a place is on the line by
/// arithmetic on integers, and else the angles under which a closed line is seen. Coordinates are
/// multiples of a quarter below 16.
class SlowSeparator {
 public:
  explicit SlowSeparator(const std::vector<Point>& points) : points_(points) {
    const std::size_t last = points.size() - 1;
    const Far first_end = end_from(points[1], points[0]);
    const Far last_end = end_from(points[last - 1], points[last]);
    line_.push_back(first_end.place);
    line_.insert(line_.end(), points.begin(), points.end());
    line_.push_back(last_end.place);
    double way = first_end.angle - last_end.angle;
    if (way < -same) way += 2 * half_turn;
    for (double angle = 0.1; angle < way; angle += 0.1)
      line_.push_back(
          {radius * std::cos(last_end.angle + angle), radius * std::sin(last_end.angle + angle)});
  }

  [[nodiscard]] Sign sign(Point p) const {
    if (is_on(p)) return Sign::on;
    double sum = 0;
    for (std::size_t i = 0; i < line_.size(); ++i) {
      const Point a = seen_from(p, line_[i]);
      const Point b = seen_from(p, line_[(i + 1) % line_.size()]);
      sum += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    }
    return std::lround(sum / (2 * half_turn)) > 0 ? Sign::left : Sign::right;
  }

 private:
  struct Far {
    Point place;
    double angle;
  };
  static constexpr double half_turn = 3.14159265358979323846;
  static constexpr double radius = 1e6;
  static constexpr double same = 1e-10;  // of angles

  static Point seen_from(Point p, Point q) { return {q.x - p.x, q.y - p.y}; }
  static double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
  static double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

  /// Where the way from a over b meets the circle.
  static Far end_from(Point a, Point b) {
    const Point way = seen_from(a, b);
    const double along = dot(b, way) / dot(way, way);
    const double t =
        -along + std::sqrt(along * along + (radius * radius - dot(b, b)) / dot(way, way));
    const Point place{b.x + t * way.x, b.y + t * way.y};
    return {place, std::atan2(place.y, place.x)};
  }

  [[nodiscard]] bool is_on(Point p) const {
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const Point way = seen_from(points_[i - 1], points_[i]);
      const Point to_p = seen_from(points_[i - 1], p);
      if (cross(way, to_p) != 0) continue;
      const double along = dot(way, to_p);
      const bool is_behind = along < 0 && i > 1;
      const bool is_ahead = along > dot(way, way) && i + 1 < points_.size();
      if (!is_behind && !is_ahead) return true;
    }
    return false;
  }

  std::vector<Point> points_;
  std::vector<Point> line_;
};

/// Whether both ends lie on one another, far out, and run the same way.
bool has_ends_on_one_another(const std::vector<Point>& points) {
  const std::size_t last = points.size() - 1;
  const Point a{points[0].x - points[1].x, points[0].y - points[1].y};
  const Point b{points[last].x - points[last - 1].x, points[last].y - points[last - 1].y};
  const Point between{points[last].x - points[0].x, points[last].y - points[0].y};
  return a.x * b.y == a.y * b.x && a.x * b.x + a.y * b.y > 0 && a.x * between.y == a.y * between.x;
}

std::vector<Point> places() {
  std::vector<Point> result;
  for (double x = -7; x <= 7; x += 0.5)
    for (double y = -7; y <= 7; y += 0.5) result.push_back({x, y});
  return result;
}

TEST(Separator, SaysWhatEverybodyWouldSay) {
  const Separator straight({{0, 0}, {1, 0}});
  EXPECT_EQ(straight.sign({5, 1}), Sign::left);
  EXPECT_EQ(straight.sign({-5, -1}), Sign::right);
  EXPECT_EQ(straight.sign({-99, 0}), Sign::on);
  EXPECT_EQ(straight.sign({99, 0}), Sign::on);
  const Separator wedge({{-1, 1}, {0, 0}, {1, 1}});
  EXPECT_EQ(wedge.sign({0, 50}), Sign::left);
  EXPECT_EQ(wedge.sign({51, 50}), Sign::right);
  EXPECT_EQ(wedge.sign({0, -50}), Sign::right);
  EXPECT_EQ(wedge.sign({50, 50}), Sign::on);
}

TEST(Separator, IsExactBesideALongLine) {
  const Separator line({{0, 0}, {1, 3}});
  const double x = 1e15 + 1;
  EXPECT_EQ(line.sign({x, 3 * x}), Sign::on);
  EXPECT_EQ(line.sign({x, std::nextafter(3 * x, 1e30)}), Sign::left);
  EXPECT_EQ(line.sign({x, std::nextafter(3 * x, 0)}), Sign::right);
}

TEST(Separator, LoopsChangeNothing) {
  const Separator left_loop({{-9, 0}, {2, 0}, {2, 2}, {1, 2}, {1, -5}, {3, -5}});
  EXPECT_EQ(left_loop.sign({1.5, 1}), Sign::left);
  const Separator right_loop({{-9, 0}, {2, 0}, {2, -2}, {1, -2}, {1, 5}, {3, 5}});
  EXPECT_EQ(right_loop.sign({1.5, -1}), Sign::right);
}

TEST(Separator, DividesBetweenParallelEnds) {
  const Separator strip({{0, 1}, {0, 0}, {1, 0}, {1, 1}});
  EXPECT_EQ(strip.sign({0.5, 99}), Sign::left);
  EXPECT_EQ(strip.sign({-1, 99}), Sign::right);
  EXPECT_EQ(strip.sign({9, 0}), Sign::right);
  const Separator other_way({{1, 1}, {1, 0}, {0, 0}, {0, 1}});
  EXPECT_EQ(other_way.sign({0.5, 99}), Sign::right);
  EXPECT_EQ(other_way.sign({-1, 99}), Sign::left);
  const Separator spike({{0, 0}, {1, 0}, {0, 0}});
  EXPECT_EQ(spike.sign({-3, 0}), Sign::on);
  EXPECT_EQ(spike.sign({1.5, 0}), Sign::right);
  EXPECT_EQ(spike.sign({0, 1}), Sign::right);
}

TEST(Separator, AgreesWithTheAnglesOfTheClosedLine) {
  const std::vector<Point> all = places();
  for (std::uint64_t seed = 0; seed < cases(400); ++seed) {
    std::mt19937_64 random(seed);
    const std::vector<Point> points = random_separator(random, PointGround::grid);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + testing::PrintToString(points));
    const Separator fast(points);
    const SlowSeparator slow(points);
    for (const Point& p : all) ASSERT_EQ(fast.sign(p), slow.sign(p)) << p;
  }
}

TEST(Separator, HasLeftAndRightExchangedTheOtherWay) {
  const std::vector<Point> all = places();
  for (std::uint64_t seed = 0; seed < cases(400); ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Point> points = random_separator(random, PointGround::grid);
    if (has_ends_on_one_another(points)) continue;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + testing::PrintToString(points));
    const Separator one(points);
    std::ranges::reverse(points);
    const Separator other(points);
    for (const Point& p : all)
      ASSERT_EQ(static_cast<int>(one.sign(p)), -static_cast<int>(other.sign(p))) << p;
  }
}

std::string complaint(const std::vector<Point>& points) {
  try {
    (void)Separator(points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Separator, RefusesWhatHasNoDirection) {
  using testing::HasSubstr;
  EXPECT_THAT(complaint({}), HasSubstr("has 0 points and needs two"));
  EXPECT_THAT(complaint({{1, 2}}), HasSubstr("has 1 point and needs two"));
  EXPECT_THAT(complaint({{1, 2}, {3, 4}, {3, 4}}),
              HasSubstr("point 2 of the separator repeats the one before"));
  EXPECT_THAT(complaint({{1, 2}, {3, std::nan("")}}),
              HasSubstr("point 1 of the separator has a coordinate"));
  EXPECT_THAT(complaint({{1, 1e80}, {3, 4}}),
              HasSubstr("point 0 of the separator has a coordinate"));
}

TEST(Separator, KnowsWhatItSharesWithAnother) {
  const Separator one({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 1}});
  const Separator other({{0, 0}, {1, 0}, {2, 5}, {3, 0}, {4, 1}});
  EXPECT_EQ(own_pieces(one, other).first, 2U);  // from infinity, and one more
  EXPECT_EQ(own_pieces(one, other).last, 4U);
  EXPECT_EQ(own_pieces(one, one).first, own_pieces(one, one).last);
}

}  // namespace
}  // namespace loft::fields
