// SPDX-License-Identifier: MIT
// What follows where courses follow their lines: the regions of polygons that touch, overlap and
// hardly miss each other have their areas.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cdt/check.h"
#include "cdt/predicates.h"
#include "cdt/regions.h"
#include "cdt/triangulation.h"
#include "tests/cases.h"
#include "tests/cdt/courses.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

using Points = std::vector<Point>;
using Rational = boost::multiprecision::cpp_rational;

Rational twice_area(const Points& corners) {
  Rational sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i];
    const Point b = corners[(i + 1) % corners.size()];
    sum += Rational(a.x) * Rational(b.y) - Rational(a.y) * Rational(b.x);
  }
  return sum;
}

/// Half of the area of the triangles within an odd number of the constraints.
Rational region_area(const Triangulation& mesh) {
  const std::vector<bool> parity = odd_parity(mesh);
  Rational sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_bound(); ++t) {
    if (!mesh.is_triangle(TriangleId(t)) || !parity[t]) continue;
    const EdgeId e = Triangulation::edge(TriangleId(t));
    sum += twice_area({mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))});
  }
  return sum / 2;
}

/// A side of the polygons, from left to right.
struct Side {
  Rational x[2];
  Rational y[2];

  [[nodiscard]] Rational height(const Rational& at) const {
    return y[0] + (at - x[0]) * (y[1] - y[0]) / (x[1] - x[0]);
  }
};

/// The exact area within an odd number of polygons: between the places where anything begins, ends
/// or crosses, sides are in one order, and every other gap between them counts.
Rational odd_area(const std::vector<Points>& polygons) {
  std::vector<Side> sides;
  std::set<Rational> stops;
  for (const Points& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      Point a = polygon[i];
      Point b = polygon[(i + 1) % polygon.size()];
      stops.insert(Rational(a.x));
      if (a.x == b.x) continue;
      if (b.x < a.x) std::swap(a, b);
      sides.push_back({{Rational(a.x), Rational(b.x)}, {Rational(a.y), Rational(b.y)}});
    }
  for (const Side& s : sides)
    for (const Side& t : sides) {
      const Rational low = std::max(s.x[0], t.x[0]);
      const Rational high = std::min(s.x[1], t.x[1]);
      if (&s == &t || low >= high) continue;
      const Rational before = s.height(low) - t.height(low);
      const Rational after = s.height(high) - t.height(high);
      if (before * after < 0) stops.insert(low + (high - low) * before / (before - after));
    }
  Rational sum = 0;
  for (auto stop = stops.begin(); stop != stops.end() && std::next(stop) != stops.end(); ++stop) {
    const Rational& low = *stop;
    const Rational& high = *std::next(stop);
    std::vector<Rational> heights;  // in the middle: the mean of both ends
    for (const Side& s : sides)
      if (s.x[0] <= low && s.x[1] >= high) heights.push_back(s.height((low + high) / 2));
    std::ranges::sort(heights);
    for (std::size_t i = 1; i < heights.size(); i += 2)
      sum += (high - low) * (heights[i] - heights[i - 1]);
  }
  return sum;
}

/// A simple polygon: points around the middle one of a few, by their directions.
Points star_shaped(Points points) {
  Point centre;
  for (const Point p : points) {
    centre.x += p.x / static_cast<double>(points.size());
    centre.y += p.y / static_cast<double>(points.size());
  }
  std::ranges::sort(points, {}, [&](Point p) {
    return std::pair(std::atan2(p.y - centre.y, p.x - centre.x), p);
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Polygons whose points are of one kind: many are flush with others, or hardly beside them.
std::vector<Points> random_polygons(std::uint64_t seed, Ground ground) {
  std::vector<Points> polygons;
  for (const Edit& edit : random_script(seed, ground, 40, 30)) {
    if (edit.kind != Edit::Kind::insert || edit.outline.points.size() < 3) continue;
    Points polygon = star_shaped(edit.outline.points);
    if (polygon.size() >= 3) polygons.push_back(polygon);
    if (polygons.size() == 6) break;
  }
  return polygons;
}

void expect_exact_areas(const std::vector<Points>& polygons) {
  Triangulation mesh;
  double bounds = 0;
  for (const Points& polygon : polygons) {
    mesh.insert(polygon, closed);
    for (const Point p : polygon) bounds = std::max({bounds, std::abs(p.x), std::abs(p.y)});
  }
  const auto findings = check(mesh);
  EXPECT_TRUE(findings.empty()) << findings.front().message;
  EXPECT_EQ(wrong_course(mesh), "");
  const Rational right = odd_area(polygons);
  const Rational wrong = abs(region_area(mesh) - right);
  EXPECT_LE(wrong.convert_to<double>(), 1e-12 * bounds * bounds)
      << "right is " << right.convert_to<double>();
}

class Areas : public testing::TestWithParam<Ground> {};

TEST_P(Areas, OfRandomPolygonsAreExact) {
  constexpr std::uint64_t first_seed = 20240901;
  for (std::uint64_t seed = first_seed; seed < first_seed + cases(50); ++seed) {
    SCOPED_TRACE(std::string(name_of(GetParam())) + ", seed " + std::to_string(seed));
    expect_exact_areas(random_polygons(seed, GetParam()));
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(, Areas,
                         testing::Values(Ground::decimals, Ground::near_parallel,
                                         Ground::beside_lines, Ground::near_zero, Ground::flush),
                         [](const auto& chosen) {
                           std::string name = name_of(chosen.param);
                           std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
                           return name;
                         });

// Whole rooms went with the corridor's wall, which was led away from it.
TEST(Regions, OfRoomsAlongACorridor) {
  for (int rooms = 1; rooms <= 12; ++rooms) {
    // A wall from (-1.2, 2.4) along (0.6, 1.8), a corridor on one side and rooms on the other, in
    // steps that are rounded to decimals.
    const auto at = [](double along, double across) {
      const auto decimal = [](double x) { return std::round(1000 * x) / 1000; };
      return Point{decimal(-1.2 + 0.6 * along + 1.8 * across),
                   decimal(2.4 + 1.8 * along - 0.6 * across)};
    };
    std::vector<Points> polygons{
        {at(-0.1, 0), at(rooms + 0.1, 0), at(rooms + 0.1, 1), at(-0.1, 1)}};
    for (int i = 0; i < rooms; ++i)
      polygons.push_back({at(i / 1.7, 0), at((i + 1) / 1.7, 0), at((i + 1) / 1.7, -1.0 / 3),
                          at(i / 1.7, -1.0 / 3)});
    SCOPED_TRACE(std::to_string(rooms) + " rooms");
    expect_exact_areas(polygons);
  }
}

// The third line went from (4.3, 2.4) back by (3.5, 1.6).
TEST(Courses, OfALineAndPartOfItAndOneFromItsEndAreTheSameInEveryOrder) {
  std::vector<Points> lines{{{2, 0}, {1.9, 0}, {5.1, 3.2}},
                            {{2, 0}, {3.5, 1.6}, {4.3, 2.4}},
                            {{2, 0}, {4.3, 2.4}, {0.1, 3.8}}};
  std::ranges::sort(lines);
  std::set<std::vector<Points>> ways;
  do {
    Triangulation mesh;
    std::vector<std::pair<Points, Points>> courses;
    for (const Points& line : lines) {
      const auto id = mesh.insert(line, open);
      courses.push_back({line, {}});
      (void)id;
    }
    for (std::uint32_t c = 0; c < courses.size(); ++c)
      for (const EdgeId e : mesh.pieces(ConstraintId(c)))
        courses[c].second.push_back(mesh.point(mesh.to(e)));
    EXPECT_EQ(wrong_course(mesh), "");
    std::ranges::sort(courses);
    std::vector<Points> way;
    for (const auto& [line, course] : courses) way.push_back(course);
    ways.insert(way);
  } while (std::ranges::next_permutation(lines).found);
  EXPECT_EQ(ways.size(), 1U);
}

}  // namespace
}  // namespace loft::cdt
