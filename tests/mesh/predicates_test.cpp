// SPDX-License-Identifier: MIT
#include "mesh/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/cases.h"

namespace loft {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Random = std::mt19937_64;

// --- The slow oracle: the intersection as a convex polygon in exact coordinates ---

using Place = std::array<Rational, 3>;
using Polygon = std::vector<Place>;

Place exact(const Vec3& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }

Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Rational dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_zero(const Place& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

/// The part of a convex polygon where dot(normal, point - origin) >= 0.
Polygon clipped(const Polygon& polygon, const Place& origin, const Place& normal) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place& from = polygon[i];
    const Place& to = polygon[(i + 1) % polygon.size()];
    const Rational from_height = dot(normal, minus(from, origin));
    const Rational to_height = dot(normal, minus(to, origin));
    if (from_height >= 0) result.push_back(from);
    if (from_height.sign() * to_height.sign() < 0) {
      const Rational t = from_height / (from_height - to_height);
      const Place way = minus(to, from);
      result.push_back({from[0] + t * way[0], from[1] + t * way[1], from[2] + t * way[2]});
    }
  }
  return result;
}

Polygon intersection(const Corners& p, const Corners& q) {
  Polygon result{exact(p[0]), exact(p[1]), exact(p[2])};
  const Polygon other{exact(q[0]), exact(q[1]), exact(q[2])};
  const Place normal = cross(minus(other[1], other[0]), minus(other[2], other[0]));
  result = clipped(result, other[0], normal);
  result = clipped(result, other[0], {-normal[0], -normal[1], -normal[2]});
  for (std::size_t i = 0; i < 3; ++i) {
    const Place edge = minus(other[(i + 1) % 3], other[i]);
    result = clipped(result, other[i], cross(normal, edge));
  }
  return result;
}

bool oracle_triangles_meet(const Corners& p, const Corners& q) {
  std::vector<Place> common;
  for (const Vec3& corner : p) {
    if (std::ranges::find(q, corner) != q.end()) common.push_back(exact(corner));
  }
  const auto is_allowed = [&](const Place& place) {
    if (common.size() == 1) return place == common[0];
    if (common.size() != 2) return false;
    return is_zero(cross(minus(place, common[0]), minus(common[1], common[0])));
  };
  return !std::ranges::all_of(intersection(p, q), is_allowed);
}

int oracle_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Place origin = exact(a);
  const Place normal = cross(minus(exact(b), origin), minus(exact(c), origin));
  return dot(normal, minus(exact(d), origin)).sign();
}

bool oracle_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return is_zero(cross(minus(exact(b), exact(a)), minus(exact(c), exact(a))));
}

// --- Nasty inputs ---

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct Generator {
  std::string name;
  std::function<Vec3(Random&)> make;
};

Generator grid(unsigned size, double unit = 1, double offset = 0) {
  const auto coordinate = [=](Random& random) {
    return offset + unit * static_cast<double>(random() % size);
  };
  return {"grid of " + std::to_string(size) + " by " + std::to_string(unit), [=](Random& random) {
            return Vec3{coordinate(random), coordinate(random), coordinate(random)};
          }};
}

/// Points that should be in the plane z = x / 3 + y / 7, but for rounding.
Vec3 nearly_coplanar(Random& random) {
  const double x = static_cast<double>(random() % 5) / 10;
  const double y = static_cast<double>(random() % 5) / 10;
  return {x, y, x / 3 + y / 7};
}

/// Points that should be on the line (t, 2t/3, t/7), but for rounding.
Vec3 nearly_collinear(Random& random) {
  const double t = uniform(random, 0, 1);
  return {t, 2 * t / 3, t / 7};
}

Vec3 log_uniform(Random& random) {
  const auto coordinate = [&] { return std::pow(10, uniform(random, -50, 50)); };
  return {coordinate(), -coordinate(), coordinate()};
}

std::vector<Generator> generators() {
  return {
      grid(2),
      grid(3),
      grid(4),
      grid(4, 0.1, 0.3),
      grid(4, 1e-5, 5e6),
      {"flat",
       [](Random& r) {
         return Vec3{static_cast<double>(r() % 4), static_cast<double>(r() % 4), 1};
       }},
      {"upright",
       [](Random& r) {
         return Vec3{2, static_cast<double>(r() % 4), static_cast<double>(r() % 4)};
       }},
      {"nearly coplanar", nearly_coplanar},
      {"nearly collinear", nearly_collinear},
      {"log-uniform", log_uniform},
      {"uniform",
       [](Random& r) {
         return Vec3{uniform(r, 0, 1), uniform(r, 0, 1), uniform(r, 0, 1)};
       }},
  };
}

/// Calls property(points) for many sets of N points of every generator.
template <std::size_t N, class Property>
void for_nasty_points(int count, Property property) {
  for (const Generator& generator : generators()) {
    constexpr std::uint64_t seed = 20240608;
    SCOPED_TRACE(generator.name + ", seed " + std::to_string(seed));
    Random random(seed);
    for (int i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
      std::array<Vec3, N> points;
      for (Vec3& p : points) p = generator.make(random);
      SCOPED_TRACE(::testing::PrintToString(points));
      property(points);
    }
  }
}

/// Calls property(p, q) for many pairs of triangles, many of them with common corners.
template <class Property>
void for_nasty_triangles(int count, Property property) {
  Random random(3);
  for_nasty_points<6>(count, [&](const std::array<Vec3, 6>& points) {
    const Corners p{points[0], points[1], points[2]};
    Corners q{points[3], points[4], points[5]};
    std::copy_n(p.begin(), random() % 3, q.begin());
    std::ranges::shuffle(q, random);
    if (collinear(p[0], p[1], p[2]) || collinear(q[0], q[1], q[2])) return;
    property(p, q);
  });
}

// --- Tests ---

TEST(Orient3d, IsPositiveWhereTheFaceLooksTo) {
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 0}), 0);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
}

TEST(Orient3d, HasTheSignOfTheExactDeterminant) {
  for_nasty_points<4>(1000, [](const std::array<Vec3, 4>& p) {
    const int expected = oracle_orient3d(p[0], p[1], p[2], p[3]);
    EXPECT_EQ(orient3d(p[0], p[1], p[2], p[3]), expected);
    EXPECT_EQ(detail::orient3d_exact(p[0], p[1], p[2], p[3]), expected);
  });
}

TEST(Orient3d, TurnsWithThePermutation) {
  for_nasty_points<4>(500, [](const std::array<Vec3, 4>& p) {
    const auto& [a, b, c, d] = p;
    const int sign = orient3d(a, b, c, d);
    EXPECT_EQ(orient3d(b, c, a, d), sign);
    EXPECT_EQ(orient3d(b, a, d, c), sign);
    EXPECT_EQ(orient3d(b, a, c, d), -sign);
    EXPECT_EQ(orient3d(a, b, d, c), -sign);
    EXPECT_EQ(orient3d(b, c, d, a), -sign);
    EXPECT_EQ(orient3d(a, b, c, a), 0);
  });
}

TEST(Collinear, HasTheExactAnswer) {
  for_nasty_points<3>(1000, [](const std::array<Vec3, 3>& p) {
    EXPECT_EQ(collinear(p[0], p[1], p[2]), oracle_collinear(p[0], p[1], p[2]));
  });
}

TEST(TrianglesMeet, IsFalseForNeighboursInASurface) {
  const Corners p{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_FALSE(triangles_meet(p, {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}));   // flat across an edge
  EXPECT_FALSE(triangles_meet(p, {{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));   // folded along an edge
  EXPECT_FALSE(triangles_meet(p, {{{0, 0, 0}, {-1, 0, 0}, {0, 0, 1}}}));  // in a corner
  EXPECT_FALSE(triangles_meet(p, {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}));   // apart
}

TEST(TrianglesMeet, IsTrueWhereASurfaceMeetsItself) {
  const Corners p{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};
  EXPECT_TRUE(triangles_meet(p, {{{2, 0, 0}, {0, 2, 0}, {0, 0, 0}}}));      // twice the same
  EXPECT_TRUE(triangles_meet(p, {{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}}));      // folded flat
  EXPECT_TRUE(triangles_meet(p, {{{0, 0, 0}, {1, 1, 1}, {1, 1, -1}}}));     // through the inside
  EXPECT_TRUE(triangles_meet(p, {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}}));      // along half an edge
  EXPECT_TRUE(triangles_meet(p, {{{0.5, 0.5, 0}, {0, 0, 1}, {1, 0, 1}}}));  // corner in the inside
  EXPECT_TRUE(triangles_meet(p, {{{1, 0, 0}, {1, -1, 0}, {0, -1, 0}}}));    // corner on an edge
  EXPECT_TRUE(triangles_meet(p, {{{0, 1, 0}, {0, 0.5, 0}, {-1, 0, 0}}}));   // edge within an edge
}

TEST(TrianglesMeet, HasTheExactAnswer) {
  int met = 0;
  int total = 0;
  for_nasty_triangles(static_cast<int>(cases(1200)), [&](const Corners& p, const Corners& q) {
    const bool expected = oracle_triangles_meet(p, q);
    EXPECT_EQ(triangles_meet(p, q), expected);
    ++total;
    met += expected ? 1 : 0;
  });
  EXPECT_GT(met, total / 5);
  EXPECT_LT(met, total * 4 / 5);
}

TEST(TrianglesMeet, DoesNotDependOnTheOrderOfArguments) {
  for_nasty_triangles(2000, [](const Corners& p, const Corners& q) {
    const bool expected = triangles_meet(p, q);
    EXPECT_EQ(triangles_meet(q, p), expected);
    EXPECT_EQ(triangles_meet({p[1], p[2], p[0]}, {q[0], q[2], q[1]}), expected);
    EXPECT_EQ(triangles_meet({q[2], q[1], q[0]}, {p[1], p[0], p[2]}), expected);
  });
}

}  // namespace
}  // namespace loft
