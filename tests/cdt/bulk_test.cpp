// SPDX-License-Identifier: MIT
// Many polylines inserted at once: the same as one after the other.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "cdt/persist.h"
#include "cdt/triangulation.h"
#include "tests/cdt/constraints.h"
#include "tests/cdt/edits.h"
#include "tests/cdt/picture.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

using Outlines = std::vector<Outline>;

std::vector<Polyline> views(const Outlines& outlines) {
  std::vector<Polyline> polylines;
  for (const auto& [points, ends] : outlines) polylines.push_back({points, ends});
  return polylines;
}

Outlines left_after(const Script& script) {
  Constraints constraints;
  for (const Edit& edit : script)
    if (applies(edit, constraints)) carry_out(edit, constraints);
  Outlines outlines;
  for (const auto& [name, outline] : constraints) outlines.push_back(outline);
  return outlines;
}

std::string all_of(const Triangulation& mesh) {
  std::ostringstream out;
  save(mesh, out, Form::text);
  return out.str();
}

void expect_same_courses(const Triangulation& a, const Triangulation& b) {
  ASSERT_EQ(a.constraint_bound(), b.constraint_bound());
  for (std::uint32_t i = 0; i < a.constraint_bound(); ++i) {
    const ConstraintId c(i);
    ASSERT_EQ(a.is_constraint(c), b.is_constraint(c));
    if (!a.is_constraint(c)) continue;
    EXPECT_EQ(a.first_segment(c), b.first_segment(c));
    EXPECT_EQ(a.ends(c), b.ends(c));
    EXPECT_EQ(a.points(c), b.points(c));
  }
}

/// Inserts these into two copies. Where nothing snaps both are equal but for the ids of vertices
/// and triangles; returns whether that is so.
bool expect_same_at_once(const Triangulation& start, std::vector<ConstraintId> ids,
                         const Outlines& outlines) {
  Triangulation at_once = start;
  Triangulation one_by_one = start;
  const auto new_ids = at_once.insert(views(outlines));
  std::vector<ConstraintId> others;
  for (const auto& [points, ends] : outlines) others.push_back(one_by_one.insert(points, ends));
  EXPECT_EQ(new_ids, others);
  EXPECT_EQ(first_fault(at_once), "");
  expect_same_courses(at_once, one_by_one);
  if (!at_once.snaps().empty() || !one_by_one.snaps().empty()) return false;
  ids.insert(ids.end(), others.begin(), others.end());
  EXPECT_EQ(difference(picture_of(at_once, ids), picture_of(one_by_one, ids)), "");
  return true;
}

TEST(Bulk, IsTheSameAsOneByOne) {
  for (const Ground ground : all_grounds) {
    std::size_t compared = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(std::string(name_of(ground)) + ", seed " + std::to_string(seed));
      const Outlines outlines = left_after(random_script(seed, ground, 40, 10));
      if (expect_same_at_once(Triangulation(), {}, outlines)) ++compared;
    }
    EXPECT_GT(compared, 5U) << name_of(ground);
  }
}

TEST(Bulk, IsTheSameWhereMuchIsThereAlready) {
  for (const Ground ground : all_grounds) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      SCOPED_TRACE(std::string(name_of(ground)) + ", seed " + std::to_string(seed));
      Triangulation start;
      std::vector<ConstraintId> ids;
      for (const auto& [points, ends] : left_after(random_script(seed, ground, 40, 10)))
        ids.push_back(start.insert(points, ends));
      for (std::size_t i = 0; i < 2 && !ids.empty(); ++i) {  // leaves free ids
        start.remove(ids.front());
        ids.erase(ids.begin());
      }
      expect_same_at_once(start, ids, left_after(random_script(seed + 1000, ground, 20, 5)));
    }
  }
}

TEST(Bulk, TakesDuplicates) {
  const Outline square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, closed};
  const Outline point{{{0, 0}}, open};
  const Outline twice{{{2, 2}, {2, 2}, {0, 0}, {2, 2}}, open};
  EXPECT_TRUE(
      expect_same_at_once(Triangulation(), {},
                          {square, point, square, twice, point, point, twice, {{{1, 1}}, closed}}));
  const Outlines one_place(100, point);
  EXPECT_TRUE(expect_same_at_once(Triangulation(), {}, one_place));
}

TEST(Bulk, OfNothingChangesNothing) {
  Triangulation mesh;
  EXPECT_TRUE(mesh.insert(std::vector<Polyline>{}).empty());
  EXPECT_EQ(all_of(mesh), all_of(Triangulation()));
  mesh.insert(std::vector<Point>{{0, 0}, {1, 2}, {3, 0}}, closed);
  const std::string before = all_of(mesh);
  EXPECT_TRUE(mesh.insert(std::vector<Polyline>{}).empty());
  EXPECT_EQ(all_of(mesh), before);
}

TEST(Bulk, MayBeOnePoint) {
  Triangulation mesh;
  const std::array one{Point{1, 2}};
  const auto ids = mesh.insert(std::vector<Polyline>{{one, open}});
  ASSERT_EQ(ids.size(), 1U);
  EXPECT_EQ(mesh.vertex_count(), 1U);
  EXPECT_EQ(mesh.points(ids[0]), std::vector<Point>(one.begin(), one.end()));
  mesh.insert(std::vector<Polyline>{{one, open}, {one, closed}});
  EXPECT_EQ(mesh.vertex_count(), 1U);
  EXPECT_EQ(mesh.constraint_count(), 3U);
  const Outlines line{{{{1, 2}, {2, 4}, {0, 0}}, open}};
  EXPECT_TRUE(expect_same_at_once(mesh, {ids[0], ConstraintId(1), ConstraintId(2)}, line));
}

TEST(Bulk, TakesManyPointsInFewPlaces) {
  std::mt19937_64 random(5);
  const auto number = [&](std::uint64_t n) { return static_cast<double>(random() % n); };
  std::vector<Point> centres(20);
  for (Point& p : centres) {
    p.x = number(1000);
    p.y = number(1000);
  }
  Outlines outlines(20000);
  for (Outline& outline : outlines) {
    const Point centre = centres[random() % centres.size()];
    const double dx = number(1000) * 1e-9;
    outline.points = {{centre.x + dx, centre.y + number(1000) * 1e-9}};
  }
  EXPECT_TRUE(expect_same_at_once(Triangulation(), {}, outlines));
}

TEST(Bulk, WithBadPointsChangesNothing) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Triangulation mesh;
  mesh.insert(std::vector<Point>{{0, 0}, {4, 0}, {2, 3}}, closed);
  mesh.remove(mesh.insert(std::vector<Point>{{1, -1}, {1, 5}}, open));
  const std::string before = all_of(mesh);
  const std::vector<Point> good{{1, 1}, {2, 1}};
  const std::vector<std::vector<Point>> all_bad{{},
                                                {{std::nan(""), 0}},
                                                {{1, 1}, {0, infinity}},
                                                {{-infinity, 0}},
                                                {{1, 1}, {2e75, 1}, {0, 0}}};
  for (const auto& bad : all_bad) {
    for (const bool is_first : {true, false}) {
      std::vector<Polyline> polylines{{good, open}, {good, closed}};
      polylines.insert(is_first ? polylines.begin() : polylines.end(), Polyline{bad, open});
      EXPECT_THROW(mesh.insert(polylines), std::invalid_argument);
      EXPECT_EQ(all_of(mesh), before);
    }
  }
}

}  // namespace
}  // namespace loft::cdt
