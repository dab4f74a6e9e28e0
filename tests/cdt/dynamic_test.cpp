// SPDX-License-Identifier: MIT
// What happens when constraints go and move. Random edits are in edits_test.cpp; these are the
// cases that have a name.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/check.h"
#include "cdt/predicates.h"
#include "cdt/rounding.h"
#include "cdt/triangulation.h"
#include "tests/cdt/allocations.h"
#include "tests/cdt/judge.h"
#include "tests/cdt/picture.h"
#include "tests/cdt/player.h"
#include "tests/cdt/random_edits.h"
#include "tests/cdt/reference.h"

namespace loft::cdt {
namespace {

using Points = std::vector<Point>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string first_finding(const Triangulation& mesh) {
  const auto findings = check(mesh);
  return findings.empty() ? "" : findings.front().message;
}

/// The picture of a triangulation that has only seen insertions.
Picture fresh_picture(const std::vector<Outline>& outlines) {
  Triangulation mesh;
  std::vector<ConstraintId> ids;
  for (const auto& [points, ends] : outlines) ids.push_back(mesh.insert(points, ends));
  return picture_of(mesh, ids);
}

void expect_picture(const Triangulation& mesh, const std::vector<ConstraintId>& ids,
                    const std::vector<Outline>& outlines) {
  EXPECT_EQ(first_finding(mesh), "");
  EXPECT_EQ(difference(picture_of(mesh, ids), fresh_picture(outlines)), "");
}

/// Plays a script; after every edit all is as in a fresh triangulation and as the reference says.
void expect_right(std::string_view text) {
  const Script script = read_script(text);
  Tally tally;
  EXPECT_EQ(verdict(script, {1, 1000}, tally), "");
  EXPECT_EQ(tally.same_as_reference, script.size()) << text;
}

/// Inserts all and removes them one by one, in every order.
void expect_removable_in_every_order(const std::vector<Outline>& outlines) {
  std::vector<std::size_t> order(outlines.size());
  std::iota(order.begin(), order.end(), 0U);
  do {
    Script script;
    for (std::size_t i = 0; i < outlines.size(); ++i)
      script.push_back({Edit::Kind::insert, i, outlines[i], {}});
    for (const std::size_t i : order) script.push_back({Edit::Kind::remove, i, {}, {}});
    Tally tally;
    EXPECT_EQ(verdict(script, {1, 1000}, tally), "");
    EXPECT_EQ(tally.same_as_reference, script.size()) << tally;
  } while (std::ranges::next_permutation(order).found);
}

VertexId vertex_at(const Triangulation& mesh, Point p) {
  const Location place = mesh.locate(p);
  return place.kind == Location::Kind::vertex ? mesh.from(place.edge) : VertexId::none();
}

Points ring(std::size_t n, double radius, Point centre = {}) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return points;
}

// --- Removal ---

TEST(Removal, LeavesTheOtherConstraintOfASharedEdge) {
  expect_removable_in_every_order({{{{0, 0}, {4, 0}, {4, 4}}, closed},
                                   {{{0, 0}, {4, 0}, {2, -3}}, closed},
                                   {{{4, 0}, {0, 0}}, open}});
}

TEST(Removal, HealsAnEdgeThatWasSplitByACrossing) {
  Triangulation mesh;
  const auto line = mesh.insert(Points{{0, 0}, {4, 0}}, open);
  const auto across = mesh.insert(Points{{2, -1}, {2, 1}, {3, 1}, {3, -1}}, open);
  EXPECT_EQ(mesh.pieces(line).size(), 3U);
  mesh.remove(across);
  EXPECT_EQ(mesh.pieces(line).size(), 1U);
  EXPECT_EQ(mesh.vertex_count(), 2U);
  expect_picture(mesh, {line}, {{{{0, 0}, {4, 0}}, open}});
}

TEST(Removal, HealsAnEdgeThatEndedOnAnother) {
  Triangulation mesh;
  const auto line = mesh.insert(Points{{0, 0}, {4, 0}}, open);
  const auto post = mesh.insert(Points{{2, 0}, {2, 3}}, open);
  EXPECT_EQ(mesh.pieces(line).size(), 2U);
  mesh.remove(post);
  EXPECT_EQ(mesh.pieces(line).size(), 1U);
  expect_picture(mesh, {line}, {{{{0, 0}, {4, 0}}, open}});
}

TEST(Removal, LeavesAVertexThatSomeoneElseHasOnTheLine) {
  expect_removable_in_every_order({{{{0, 0}, {4, 0}}, open},
                                   {{{2, 0}}, open},
                                   {{{2, 0}, {3, 3}}, open},
                                   {{{2, -2}, {2, 2}}, open}});
}

TEST(Removal, OfCrossingConstraintsLeavesTheCrossingsOfTheOthers) {
  expect_removable_in_every_order({{{{0, 0}, {6, 6}}, open},
                                   {{{0, 6}, {6, 0}}, open},
                                   {{{3, 0}, {3, 6}}, open},
                                   {{{0, 2}, {6, 3}}, open}});
}

TEST(Removal, HealsWhereRoundingBentTheLine) {
  // (1/3, 1/3) and the like are no doubles: both lines are bent there while both are.
  expect_removable_in_every_order({{{{0, 0}, {1, 1}}, open},
                                   {{{0, 1}, {1, -1}}, open},
                                   {{{0, 0.5}, {1, 0}}, open},
                                   {{{0.25, 0.25}}, open}});
}

TEST(Removal, OfOverlappingPolylinesInEveryOrder) {
  expect_removable_in_every_order({{{{1, 0}, {4, 0}}, open},
                                   {{{2, 0}, {3, 0}}, open},
                                   {{{6, 0}, {0, 0}}, open},
                                   {{{3, 0}, {5, 0}, {5, 2}, {2.5, 0}}, closed}});
}

TEST(Removal, OfASelfCrossingPolyline) {
  expect_removable_in_every_order(
      {{{{0, 0}, {6, 0}, {1, 4}, {3, -2}, {5, 4}}, closed}, {{{0, 1}, {6, 1}}, open}});
}

TEST(Removal, OfSpikesThatGoOutAndBack) {
  expect_removable_in_every_order({{{{0, 0}, {4, 0}, {0, 0}}, open},
                                   {{{4, 0}, {0, 0}, {4, 0}, {2, 0}, {2, 3}}, open},
                                   {{{2, 0}, {2, 3}, {2, 0}}, closed}});
}

TEST(Removal, OfASpikeOverAnEdgeThatIsNotDelaunay) {
  expect_removable_in_every_order({{{{0, 0}, {10, 0}, {0, 0}, {0, 5}}, open},
                                   {{{5, 0.1}}, open},
                                   {{{5, -0.1}}, open},
                                   {{{-1, -1}, {12, -1}, {12, 6}, {-1, 6}}, closed}});
}

TEST(Removal, OfOneOfTwoEqualPolylinesLeavesTheOther) {
  const Points points{{0, 0}, {4, 1}, {2, 5}};
  expect_removable_in_every_order({{points, closed}, {points, closed}, {points, open}});

  Triangulation mesh;
  const auto one = mesh.insert(points, closed);
  const auto other = mesh.insert(points, closed);
  const EdgeId side = mesh.pieces(one).front();
  EXPECT_EQ(mesh.constraints(side), (std::vector{one, other}));
  mesh.remove(one);
  EXPECT_FALSE(mesh.is_constraint(one));
  EXPECT_EQ(mesh.constraints(mesh.pieces(other).front()), std::vector{other});
}

TEST(Removal, OfPointsGivenTwiceInARow) {
  expect_removable_in_every_order({{{{0, 0}, {0, 0}, {3, 0}, {3, 0}}, closed},
                                   {{{3, 0}, {3, 0}}, open},
                                   {{{1, 0}, {1, 0}, {1, 0}}, closed}});
}

TEST(Removal, DownToNothingAndUpAgain) {
  Triangulation mesh;
  for (int round = 0; round < 3; ++round) {
    const auto square = mesh.insert(Points{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, closed);
    const auto point = mesh.insert(Points{{1, 1}}, open);
    EXPECT_EQ(mesh.vertex_count(), 5U);
    mesh.remove(square);
    EXPECT_EQ(mesh.vertex_count(), 1U);
    EXPECT_EQ(first_finding(mesh), "");
    mesh.remove(point);
    EXPECT_EQ(mesh.vertex_count(), 0U);
    EXPECT_EQ(mesh.triangle_count(), 0U);
    EXPECT_EQ(mesh.constraint_count(), 0U);
    EXPECT_EQ(mesh.locate({1, 1}).kind, Location::Kind::nowhere);
    EXPECT_EQ(first_finding(mesh), "");
  }
}

TEST(Removal, OfHullVertices) {
  std::vector<Outline> outlines;
  for (const Point p : Points{{0, 0}, {4, 0}, {5, 3}, {-1, 2}}) outlines.push_back({{p}, open});
  expect_removable_in_every_order(outlines);
  outlines.push_back({{{0, 0}, {5, 3}}, open});
  expect_removable_in_every_order(outlines);
}

TEST(Removal, WhileAllPointsAreInOneLine) {
  expect_removable_in_every_order(
      {{{{0, 0}, {6, 3}}, open}, {{{2, 1}}, open}, {{{8, 4}}, open}, {{{4, 2}, {-2, -1}}, open}});
}

TEST(Removal, OfTheOnlyPointBesideALine) {
  expect_removable_in_every_order(
      {{{{0, 0}, {6, 0}}, open}, {{{2, 0}}, open}, {{{3, 5}}, open}, {{{3, -5}}, open}});
}

TEST(Removal, OfTheHubOfAWheelOfAThousandSpokes) {
  constexpr std::size_t spokes = 1000;
  const Points rim = ring(spokes, 1);
  Points wheel;
  for (const Point p : rim) wheel.insert(wheel.end(), {{0, 0}, p});
  Triangulation mesh;
  const auto tyre = mesh.insert(rim, closed);
  const auto hub = mesh.insert(wheel, open);
  EXPECT_EQ(mesh.constraints(vertex_at(mesh, {0, 0})), std::vector{hub});
  mesh.remove(hub);
  expect_picture(mesh, {tyre}, {{rim, closed}});

  const VertexId axle = mesh.insert({0, 0});
  mesh.remove(axle);
  expect_picture(mesh, {tyre}, {{rim, closed}});
}

TEST(Removal, OfAFreeVertexOfEveryDegree) {
  for (std::size_t degree = 3; degree <= 40; ++degree) {
    const Points rim = ring(degree, 1);
    Triangulation mesh;
    const auto tyre = mesh.insert(rim, closed);
    const VertexId axle = mesh.insert({0.01, 0.02});
    mesh.remove(axle);
    EXPECT_FALSE(mesh.is_vertex(axle));
    expect_picture(mesh, {tyre}, {{rim, closed}});
  }
}

TEST(Removal, LeavesAFreeVertexOnTheLine) {
  Triangulation mesh;
  const VertexId before = mesh.insert({2, 0});
  const auto line = mesh.insert(Points{{0, 0}, {4, 0}}, open);
  EXPECT_EQ(mesh.pieces(line).size(), 2U);
  mesh.remove(line);
  EXPECT_EQ(mesh.vertex_count(), 1U);
  EXPECT_TRUE(mesh.is_vertex(before));
  mesh.remove(before);
  EXPECT_EQ(mesh.vertex_count(), 0U);
  EXPECT_THROW(mesh.remove(before), std::invalid_argument);
}

TEST(Removal, OfAFreeVertexOnALineHealsTheLine) {
  Triangulation mesh;
  const VertexId on_it = mesh.insert({2, 0});
  const auto line = mesh.insert(Points{{0, 0}, {4, 0}}, open);
  mesh.insert({2, 1});
  mesh.remove(on_it);
  EXPECT_EQ(mesh.pieces(line).size(), 1U);
  EXPECT_THROW(mesh.remove(mesh.first_vertex(line)), std::invalid_argument);
  EXPECT_EQ(first_finding(mesh), "");
}

TEST(Removal, OfVerticesInEveryOrderLeavesTheDelaunayTriangulation) {
  const Points points{{0, 0}, {3, 1}, {1, 3}, {2, 2}, {5, 2}};
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  do {
    Triangulation mesh;
    std::vector<VertexId> vertices;
    for (const Point p : points) vertices.push_back(mesh.insert(p));
    std::vector<Outline> left;
    for (const std::size_t i : order) left.push_back({{points[i]}, open});
    for (const std::size_t i : order) {
      mesh.remove(vertices[i]);
      left.erase(left.begin());
      EXPECT_EQ(first_finding(mesh), "");
      EXPECT_EQ(difference(picture_of(mesh, {}), Reference(left).picture()), "");
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST(Removal, OfManyAtOnceIsThatOfOneAfterTheOther) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const Ground ground : {Ground::grid_8, Ground::decimals, Ground::flush}) {
      Player player;
      for (const Edit& edit : random_script(seed, ground, 60, 12)) player.play(edit);
      Triangulation& mesh = player.mesh();
      std::vector<VertexId> own;
      for (std::uint32_t i = 1; i < 40 && own.size() < 5; i += 7) {
        const VertexId v(i);
        if (mesh.is_vertex(v)) own.push_back(mesh.insert(mesh.point(v)));
      }
      const auto half = own.size() / 2;
      const auto ids = player.ids();
      const auto outlines = player.outlines();
      std::vector<ConstraintId> gone;
      std::vector<ConstraintId> left;
      std::vector<Outline> left_outlines;
      for (std::size_t i = 0; i < ids.size(); ++i) {
        (i % 2 == 0 ? gone : left).push_back(ids[i]);
        if (i % 2 != 0) left_outlines.push_back(outlines[i]);
      }
      mesh.remove(gone, std::span(own).first(half));
      mesh.remove({}, std::span(own).subspan(half));
      for (const ConstraintId id : gone) EXPECT_FALSE(mesh.is_constraint(id));
      expect_picture(mesh, left, left_outlines);
    }
  }
}

TEST(Removal, OfManyAtOnceWithOneThatIsNotThereChangesNothing) {
  Triangulation mesh;
  const auto square = mesh.insert(Points{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, closed);
  const std::vector<ConstraintId> ids{square, ConstraintId(7)};
  const std::vector<VertexId> corner{vertex_at(mesh, {4, 4})};
  EXPECT_THROW(mesh.remove(ids, {}), std::invalid_argument);
  EXPECT_THROW(mesh.remove(std::span(ids).first(1), corner), std::invalid_argument);
  expect_picture(mesh, {square}, {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, closed}});
}

TEST(Insertion, OfAPointThatASegmentRoundsToSplitsIt) {
  for (int i = 1; i < 40; ++i) {
    Triangulation mesh;
    const Points ends{{0.1, 0.7}, {0.1 + i / 7.0, 0.7 + 3 / 11.0}};
    const auto line = mesh.insert(ends, open);
    const auto cover = mesh.insert(ring(7, 9), closed);
    const Point across{ends[0].x + 0.3, ends[0].y - i / 3.0};
    const Point place = intersection(ends[0], ends[1], across, {across.x + 0.01, across.y + 7});
    const VertexId v = mesh.insert(place);
    const bool is_between = is_boxed(ends[0], ends[1], place);
    EXPECT_EQ(mesh.constraints(v).size(), is_between ? 1U : 0U);
    EXPECT_EQ(mesh.pieces(line).size(), is_between ? 2U : 1U);
    EXPECT_TRUE(mesh.snaps().empty());
    EXPECT_EQ(first_finding(mesh), "");
    mesh.remove(v);
    expect_picture(mesh, {line, cover}, {{ends, open}, {ring(7, 9), closed}});
  }
}

// --- Moves ---

TEST(Moving, IsRemovingAndInsertingUnderTheSameId) {
  Triangulation mesh;
  const auto frame = mesh.insert(Points{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed);
  const auto guest = mesh.insert(Points{{1, 1}, {3, 1}, {2, 3}}, closed);
  const Points elsewhere{{6, 4}, {10, 4}, {10, 6}, {6, 6}, {7, 5}};
  mesh.move(guest, elsewhere);
  EXPECT_TRUE(mesh.is_constraint(guest));
  EXPECT_EQ(mesh.points(guest), elsewhere);
  EXPECT_EQ(mesh.ends(guest), closed);
  expect_picture(mesh, {frame, guest},
                 {{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed}, {elsewhere, closed}});
  mesh.move(guest, Points{{5, 5}});
  expect_picture(mesh, {frame, guest},
                 {{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed}, {{{5, 5}}, closed}});
}

TEST(Moving, TranslatesEveryPoint) {
  Triangulation mesh;
  const auto frame = mesh.insert(Points{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed);
  Points points = ring(6, 1.5, {2, 2});
  const auto guest = mesh.insert(points, closed);
  for (int step = 0; step < 40; ++step) {
    mesh.translate(guest, {0.21, 0.17});
    for (Point& p : points) p = {p.x + 0.21, p.y + 0.17};
    EXPECT_EQ(mesh.points(guest), points);
    expect_picture(mesh, {frame, guest},
                   {{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed}, {points, closed}});
  }
}

TEST(Moving, OntoItselfChangesNothing) {
  expect_right(
      "insert 1 closed 0 0 4 0 4 4\ninsert 2 open 1 -1 1 5\nmove 1 0 0 4 0 4 4\n"
      "translate 1 0 0\ntranslate 2 0 0\n");
}

TEST(Moving, AlongItsOwnLine) {
  expect_right(
      "insert 1 open 0 0 8 0\ninsert 2 open 1 0 3 0\ntranslate 2 1 0\ntranslate 2 3 0\n"
      "translate 2 3 0\ntranslate 2 -12 0\nmove 2 0 0 8 0\nmove 2 8 0 0 0\n");
}

TEST(Moving, OntoAnotherConstraintAndOff) {
  expect_right(
      "insert 1 closed 0 0 4 0 2 3\ninsert 2 closed 1 1 5 1 3 4\ntranslate 2 -1 -1\n"
      "translate 2 0 1\ntranslate 1 0 1\nremove 1\n");
}

TEST(Moving, AHullCornerInwardsAndOut) {
  expect_right(
      "insert 1 closed 0 0 6 0 6 6 0 6\ninsert 2 open 9 3\ntranslate 2 -6 0\n"
      "translate 2 -8 0\ntranslate 2 2 0\nmove 2 3 0\nmove 2 3 -1\n");
}

TEST(Moving, OfEverythingIntoOneLineAndBack) {
  expect_right(
      "insert 1 open 0 0 2 1\ninsert 2 open 0 2 4 4\nmove 2 4 2 6 3\nmove 1 8 4 6 3\n"
      "move 2 0 5 1 1\nremove 1\nremove 2\n");
}

/// A coast: a ring in and out, as far as `depth`.
Points coast(std::size_t n, double depth, Point centre, std::mt19937& random) {
  std::uniform_real_distribution<> number(0, depth);
  Points points = ring(n, 1, {});
  for (Point& p : points) {
    const double reach = 10 - number(random);
    p = {centre.x + reach * p.x, centre.y + reach * p.y};
  }
  return points;
}

TEST(Moving, ManyVerticesAtOnceAsFarAsThereIsRoom) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> number(-1, 1);
  std::vector<Outline> outlines{{coast(70, 3, {0, 0}, random), closed}};
  for (int i = 0; i < 60; ++i)
    outlines.push_back({{{12 * number(random), 12 * number(random)}}, open});
  for (int i = 0; i < 6; ++i)
    outlines.push_back({coast(12, 5, {20 * number(random), 20 * number(random)}, random), closed});
  Triangulation mesh;
  std::vector<ConstraintId> ids;
  for (const auto& [points, ends] : outlines) ids.push_back(mesh.insert(points, ends));
  for (const double step : {1e-6, 1e-3, 0.01, 0.1, 1.0, 1e-9}) {
    for (int i = 0; i < 12; ++i) {
      const std::size_t which = i % 2 == 0 ? 0 : 61U + static_cast<std::size_t>(i) / 2;
      Points& points = outlines[which].points;
      const Point by{step * number(random), step * number(random)};
      const bool is_translation = i % 4 < 2;
      for (Point& p : points)
        p = is_translation ? Point{p.x + by.x, p.y + by.y}
                           : Point{p.x + step * number(random), p.y + step * number(random)};
      mesh.move(ids[which], points);
      ASSERT_EQ(mesh.points(ids[which]), points);
      expect_picture(mesh, ids, outlines);
    }
  }
}

TEST(Moving, TurnsSegmentsThatPointTheOtherWay) {
  Triangulation mesh;
  Points points{{0, 0}, {1e-3, 5}, {6, 7}, {6 - 1e-3, -1}};
  const auto turning = mesh.insert(points, closed);
  for (const double by : {2e-3, -2e-3, 2e-3}) {
    points[1].x -= by;
    points[3].x += by;
    mesh.move(turning, points);
    for (const EdgeId e : mesh.pieces(turning))
      EXPECT_TRUE(mesh.is_forward(e, mesh.passages(e)[0]));
    expect_picture(mesh, {turning}, {{points, closed}});
  }
}

// --- Bulk insertion ---

TEST(BulkInsertion, GivesWhatOneByOneGives) {
  for (const Ground ground : {Ground::grid_8, Ground::decimals}) {
    Constraints constraints;
    for (const Edit& edit : random_script(7, ground, 60, 25)) carry_out(edit, constraints);
    std::vector<Outline> outlines;
    for (const auto& [name, outline] : constraints) outlines.push_back(outline);
    std::vector<Polyline> polylines;
    for (const auto& [points, ends] : outlines) polylines.push_back({points, ends});
    Triangulation mesh;
    const std::vector<ConstraintId> ids = mesh.insert(polylines);
    ASSERT_EQ(ids.size(), outlines.size());
    for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(mesh.points(ids[i]), outlines[i].points);
    expect_picture(mesh, ids, outlines);
  }
}

TEST(BulkInsertion, AddsToWhatIsThere) {
  Triangulation mesh;
  const auto frame = mesh.insert(Points{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed);
  const Points one{{-1, 1}, {9, 1}};
  const Points other{{1, -1}, {1, 9}};
  const auto ids = mesh.insert(std::vector<Polyline>{{one, open}, {other, open}});
  ASSERT_EQ(ids.size(), 2U);
  expect_picture(mesh, {frame, ids[0], ids[1]},
                 {{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed}, {one, open}, {other, open}});
  EXPECT_TRUE(mesh.insert(std::vector<Polyline>{}).empty());
}

// --- Promises about ids, failures, changes, copies, memory ---

TEST(Ids, ThatAreUnknownAreRefused) {
  Triangulation mesh;
  const auto gone = mesh.insert(Points{{0, 0}, {4, 0}, {2, 3}}, closed);
  const auto there = mesh.insert(Points{{1, 1}, {5, 5}}, open);
  mesh.remove(gone);
  for (const ConstraintId id : {gone, ConstraintId(99), ConstraintId::none()}) {
    EXPECT_FALSE(mesh.is_constraint(id));
    EXPECT_THROW(mesh.remove(id), std::invalid_argument);
    EXPECT_THROW(mesh.move(id, Points{{0, 0}}), std::invalid_argument);
    EXPECT_THROW(mesh.translate(id, {1, 1}), std::invalid_argument);
  }
  const VertexId end = vertex_at(mesh, {1, 1});
  for (const VertexId id : {end, Triangulation::infinite, VertexId(99), VertexId::none()})
    EXPECT_THROW(mesh.remove(id), std::invalid_argument);
  expect_picture(mesh, {there}, {{{{1, 1}, {5, 5}}, open}});
}

TEST(Ids, OfWhatIsRemovedAreUsedAgain) {
  Triangulation mesh;
  const Points points{{0, 0}, {4, 0}, {2, 3}};
  mesh.insert(Points{{-9, -9}, {9, -9}, {0, 9}}, closed);
  auto guest = mesh.insert(points, closed);
  const std::array bounds{mesh.constraint_bound(), mesh.segment_bound(), mesh.vertex_bound(),
                          mesh.triangle_bound()};
  for (int round = 0; round < 10; ++round) {
    mesh.remove(guest);
    guest = mesh.insert(points, closed);
    EXPECT_EQ((std::array{mesh.constraint_bound(), mesh.segment_bound(), mesh.vertex_bound(),
                          mesh.triangle_bound()}),
              bounds);
  }
}

TEST(Ids, OfTheLivingAreCounted) {
  Triangulation mesh;
  const auto one = mesh.insert(ring(7, 1), closed);
  mesh.insert(ring(5, 2), closed);
  mesh.remove(one);
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t constraints = 0;
  for (std::uint32_t v = 1; v < mesh.vertex_bound(); ++v) vertices += mesh.is_vertex(VertexId(v));
  for (std::uint32_t t = 0; t < mesh.triangle_bound(); ++t)
    triangles += mesh.is_triangle(TriangleId(t));
  for (std::uint32_t c = 0; c < mesh.constraint_bound(); ++c)
    constraints += mesh.is_constraint(ConstraintId(c));
  EXPECT_EQ(vertices, 5U);
  EXPECT_EQ(mesh.vertex_count(), vertices);
  EXPECT_EQ(mesh.triangle_count(), triangles);
  EXPECT_EQ(mesh.constraint_count(), constraints);
  EXPECT_EQ(mesh.edge_bound(), 3 * mesh.triangle_bound());
}

TEST(Constraints, OfAVertexAreThoseThatEndThereOrPassThrough) {
  Triangulation mesh;
  const auto through = mesh.insert(Points{{0, 0}, {4, 0}}, open);
  const auto ending = mesh.insert(Points{{2, 0}, {2, 3}}, open);
  const auto point = mesh.insert(Points{{2, 0}}, open);
  const auto beside = mesh.insert(Points{{0, 1}, {1, 1}}, open);
  EXPECT_EQ(mesh.constraints(vertex_at(mesh, {2, 0})), (std::vector{through, ending, point}));
  EXPECT_EQ(mesh.constraints(vertex_at(mesh, {0, 1})), std::vector{beside});
  EXPECT_EQ(mesh.constraints(vertex_at(mesh, {2, 3})), std::vector{ending});
}

TEST(FailedEdits, LeaveEverythingAsItWas) {
  const std::vector<Outline> outlines{{ring(9, 3), closed}, {{{-4, 0}, {4, 1}}, open}};
  Triangulation mesh;
  const auto one = mesh.insert(outlines[0].points, closed);
  const auto other = mesh.insert(outlines[1].points, open);
  const Points far{{0, 0}, {1e76, 0}};
  EXPECT_THROW(mesh.move(one, Points{}), std::invalid_argument);
  EXPECT_THROW(mesh.move(one, Points{{0, 0}, {1, nan}}), std::invalid_argument);
  EXPECT_THROW(mesh.move(one, far), std::invalid_argument);
  EXPECT_THROW(mesh.translate(one, {nan, 0}), std::invalid_argument);
  EXPECT_THROW(mesh.translate(one, {0, 1e76}), std::invalid_argument);
  EXPECT_THROW(mesh.insert(Point{nan, 0}), std::invalid_argument);
  const Points good{{0, 0}, {5, 5}};
  EXPECT_THROW(mesh.insert(std::vector<Polyline>{{good, open}, {far, open}}),
               std::invalid_argument);
  EXPECT_THROW(mesh.insert(std::vector<Polyline>{{good, open}, {{}, open}}), std::invalid_argument);
  EXPECT_EQ(mesh.constraint_count(), 2U);
  expect_picture(mesh, {one, other}, outlines);
}

/// Keeps its own copy of the finite triangles by what changes() says alone.
class Onlooker {
 public:
  void follow(const Triangulation& mesh) {
    for (const TriangleId t : mesh.changes().unmade) triangles_.erase(t);
    for (const TriangleId t : mesh.changes().made) triangles_[t] = seen(mesh, t);
  }

  /// Whether every triangle, infinite ones included, is here as it is there, and no other.
  [[nodiscard]] bool agrees_with(const Triangulation& mesh) const {
    if (triangles_.size() != mesh.triangle_count()) return false;
    return std::ranges::all_of(triangles_, [&](const auto& known) {
      return mesh.is_triangle(known.first) && seen(mesh, known.first) == known.second;
    });
  }

 private:
  /// The corners and the passages of each side.
  using Seen = std::array<std::pair<Point, std::vector<Passage>>, 3>;

  [[nodiscard]] static Seen seen(const Triangulation& mesh, TriangleId t) {
    Seen seen;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const auto passages = mesh.passages(e);
      seen[corner] = {mesh.point(mesh.from(e)), {passages.begin(), passages.end()}};
    }
    return seen;
  }

  std::map<TriangleId, Seen> triangles_;
};

TEST(Changes, TellAFollowerEverything) {
  for (const Ground ground : all_grounds) {
    Player player;
    player.mesh().record_changes(true);
    Onlooker onlooker;
    for (const Edit& edit : random_script(3, ground, 120, 6)) {
      player.play(edit);
      onlooker.follow(player.mesh());
      ASSERT_TRUE(onlooker.agrees_with(player.mesh())) << name_of(ground);
    }
  }
}

/// Corners by their ids, and the passages of each side, as they go forward.
using Sides = std::array<std::pair<VertexId, std::vector<std::pair<SegmentId, bool>>>, 3>;

Sides sides_of(const Triangulation& mesh, TriangleId t) {
  Sides sides;
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId e = Triangulation::edge(t, corner);
    sides[corner].first = mesh.from(e);
    for (const Passage passage : mesh.passages(e))
      sides[corner].second.emplace_back(passage.segment(), mesh.is_forward(e, passage));
  }
  return sides;
}

void expect_moved_keep_their_sides(const Triangulation& mesh,
                                   const std::map<TriangleId, Sides>& before) {
  const Changes& changes = mesh.changes();
  EXPECT_TRUE(std::ranges::includes(changes.made, changes.moved));
  EXPECT_TRUE(std::ranges::includes(changes.unmade, changes.moved));
  for (const TriangleId t : changes.moved) EXPECT_EQ(sides_of(mesh, t), before.at(t)) << t;
}

TEST(Changes, OfTrianglesThatOnlyMovedLeaveTheirSides) {
  std::size_t moved = 0;
  for (const Ground ground : all_grounds) {
    for (const std::size_t batch : {1U, 3U}) {
      Player player;
      Triangulation& mesh = player.mesh();
      mesh.record_changes(true);
      const Script script = random_script(9, ground, 150, 6);
      for (std::size_t i = 0; i + batch <= script.size(); i += batch) {
        std::map<TriangleId, Sides> before;
        for (std::uint32_t t = 0; t < mesh.triangle_bound(); ++t)
          if (mesh.is_triangle(TriangleId(t)))
            before[TriangleId(t)] = sides_of(mesh, TriangleId(t));
        if (batch > 1) mesh.begin_batch();
        for (std::size_t k = i; k < i + batch; ++k) player.play(script[k]);
        if (batch > 1) mesh.end_batch();
        expect_moved_keep_their_sides(mesh, before);
        moved += mesh.changes().moved.size();
      }
    }
  }
  EXPECT_GT(moved, 0U);
}

TEST(Changes, OfAStepAreMovesAlone) {
  Triangulation mesh;
  std::mt19937 random(1);
  mesh.insert(ring(4, 100), closed);
  const auto guest = mesh.insert(coast(32, 5, {}, random), closed);
  mesh.record_changes(true);
  mesh.translate(guest, {1e-9, 2e-9});
  EXPECT_GE(mesh.changes().moved.size(), 32U);
  EXPECT_EQ(mesh.changes().moved, mesh.changes().made);
  EXPECT_EQ(mesh.changes().moved, mesh.changes().unmade);
  mesh.remove(guest);
  EXPECT_TRUE(mesh.changes().moved.empty());
}

TEST(Changes, OfASmallEditAreFew) {
  Triangulation mesh;
  for (int i = 0; i < 1000; ++i) mesh.insert({i % 40 + 0.01 * (i % 7), i / 40 + 0.01 * (i % 3)});
  const auto guest = mesh.insert(ring(5, 0.5, {20, 12}), closed);
  mesh.record_changes(true);
  mesh.translate(guest, {0.01, 0});
  EXPECT_FALSE(mesh.changes().made.empty());
  EXPECT_LT(mesh.changes().made.size() + mesh.changes().unmade.size(), 80U);
}

TEST(Copies, AreIndependent) {
  const Outline frame{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed};
  const Outline guest{{{1, 1}, {9, 1}, {2, 3}}, closed};
  Triangulation mesh;
  const auto first = mesh.insert(frame.points, closed);
  const auto second = mesh.insert(guest.points, closed);
  Triangulation copy = mesh;
  copy.remove(first);
  expect_picture(mesh, {first, second}, {frame, guest});
  expect_picture(copy, {second}, {guest});
  mesh.translate(second, {3, 3});
  expect_picture(copy, {second}, {guest});
  copy = mesh;
  mesh.remove(second);
  mesh.remove(first);
  expect_picture(copy, {first, second}, {frame, {{{4, 4}, {12, 4}, {5, 6}}, closed}});
}

TEST(Epsilon, MakesNearPointsOne) {
  Triangulation mesh(0.1);
  EXPECT_EQ(mesh.epsilon(), 0.1);
  EXPECT_EQ(Triangulation().epsilon(), 0);
  const VertexId one = mesh.insert({0, 0});
  EXPECT_EQ(mesh.insert({0.05, 0.05}), one);
  EXPECT_NE(mesh.insert({0.2, 0}), one);
  EXPECT_EQ(mesh.vertex_count(), 2U);
}

TEST(Epsilon, DrawsPointsOntoSegmentsNearby) {
  Triangulation mesh(0.1);
  const auto line = mesh.insert(Points{{0, 0}, {4, 0}}, open);
  const auto point = mesh.insert(Points{{2, 0.05}}, open);
  EXPECT_EQ(mesh.vertex_count(), 3U);
  EXPECT_EQ(mesh.pieces(line).size(), 2U);
  EXPECT_EQ(first_finding(mesh), "");
  mesh.remove(point);
  EXPECT_EQ(mesh.vertex_count(), 2U);
  EXPECT_EQ(mesh.pieces(line).size(), 1U);
}

TEST(Epsilon, LeadsASegmentThroughVerticesNearbyAlsoAlongAnEdge) {
  for (const double beside : {0.05, 0.5}) {
    Triangulation mesh(0.1);
    for (const Point p : Points{{0, 0}, {10, 0}, {5, beside}}) mesh.insert(p);
    const auto line = mesh.insert(Points{{0, 0}, {10, 0}}, open);
    EXPECT_EQ(mesh.pieces(line).size(), beside < 0.1 ? 2U : 1U);
  }
}

// Goals took each other's place for ever, or the way led to and fro.
TEST(Epsilon, NeverHangsBetweenGoals) {
  Triangulation fan(1);
  const double angle = 70 * std::numbers::pi / 180;
  for (const Point p : Points{{0, 0}, {1.02, 0}, {1.02 * std::cos(angle), 1.02 * std::sin(angle)}})
    fan.insert(p);
  fan.insert(Points{{0, 0}, {100, 0}}, open);
  EXPECT_EQ(first_finding(fan), "");

  Triangulation near(0.05);
  near.insert(Points{{0.8534999999999999, 0.2605}}, open);
  near.insert(Points{{0.958, 0.961}, {0.69, 0.613}, {0.958, 0.116}}, open);
  near.insert(Points{{0.772, 0.561}, {0.032, 0.064}}, open);
  near.insert(Points{{0.525, 0.488}, {0.795, 0.504}}, open);
  EXPECT_EQ(first_finding(near), "");

  Triangulation moved(0.3);
  moved.insert(Points{{4, 2}, {-4, 4}, {3, 5}, {-4, 0}}, closed);
  moved.translate(moved.insert(Points{{4, 3}, {1, 7}, {0, 3}}, closed), {3, -1});
  EXPECT_EQ(first_finding(moved), "");
}

TEST(Epsilon, StaysValidWhateverIsEdited) {
  for (const double epsilon : {1e-3, 0.05, 0.3}) {
    for (const Ground ground : all_grounds) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        Player player(epsilon);
        for (const Edit& edit : random_script(seed, ground, 60, 8)) {
          player.play(edit);
          ASSERT_EQ(first_finding(player.mesh()), "")
              << name_of(ground) << ", seed " << seed << ", epsilon " << epsilon;
        }
      }
    }
  }
}

TEST(Memory, IsNotAllocatedOnceTheWorkIsKnown) {
  Triangulation mesh;
  mesh.insert(ring(200, 10), closed);
  mesh.insert(ring(150, 10.1, {0.3, 0.2}), closed);
  const Points here = ring(20, 3, {6, 0});
  const Points there = ring(20, 3, {-6, 1});
  const auto walker = mesh.insert(here, closed);
  const auto slider = mesh.insert(Points{{-12, -1}, {12, -1.5}}, open);
  const auto round_trip = [&] {
    mesh.move(walker, there);
    mesh.move(walker, here);
    mesh.translate(slider, {0, 2});
    mesh.translate(slider, {0, -2});
  };
  for (int warm_up = 0; warm_up < 20; ++warm_up) round_trip();
  const std::size_t before = allocation_count();
  for (int i = 0; i < 250; ++i) round_trip();
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_EQ(first_finding(mesh), "");
}

// Each edit added those again that were known.
TEST(Snaps, AreListedOnce) {
  Triangulation mesh;
  for (const Edit& edit : random_script(5, Ground::nearly_equal, 60, 12))
    if (edit.kind == Edit::Kind::insert) mesh.insert(edit.outline.points, edit.outline.ends);
  const std::size_t before = mesh.snaps().size();
  const auto line = mesh.insert(Points{{-1, 0.5}, {3, 0.6}}, open);
  for (int i = 0; i < 200; ++i) mesh.translate(line, {0, i < 100 ? 1e-3 : -1e-3});
  mesh.remove(line);
  EXPECT_LE(mesh.snaps().size(), 2 * before);
}

TEST(Moving, KeepsTheVerticesOfASmallStep) {
  Triangulation mesh;
  mesh.insert(Points{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, closed);
  const auto guest = mesh.insert(ring(9, 2, {4, 4}), closed);
  const auto segments = mesh.segments(guest);
  const std::vector<Segment> before(segments.begin(), segments.end());
  mesh.translate(guest, {0.01, 0.02});
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(mesh.segments(guest)[i].from, before[i].from);
  mesh.remove(guest);
  EXPECT_EQ(mesh.vertex_count(), 4U);
}

/// A segment waits to be led through a crowd, and one of its ends does not stay.
TEST(Moving, OutOfACrowdOfItsOwnPoints) {
  Triangulation mesh;
  const Points points{
      {4.254260473141475, 1.5131790044483333},  {13.663879864515097, -7.512721136406262},
      {8.541577119679635, -30.188279575831324}, {4.254260473141475, 1.5131790044483342},
      {4.254260473141476, 1.5131790044483338},  {3.3822604731414745, 6.563179004448333},
      {5.264260473141475, 10.813179004448335}};
  const ConstraintId moved = mesh.insert(points, open);
  mesh.insert(Points{{3.99, 0.5}}, open);
  mesh.translate(moved, {0.005223101763100663, -0.014301012216522982});
  EXPECT_TRUE(check(mesh).empty());
  EXPECT_EQ(mesh.segments(moved).size(), points.size() - 1);
}

TEST(Snaps, GoWithTheSegmentsThatMadeThem) {
  Triangulation mesh;
  std::vector<ConstraintId> ids;
  Constraints constraints;
  for (const Edit& edit : random_script(11, Ground::nearly_equal, 60, 20))
    carry_out(edit, constraints);
  for (const auto& [name, outline] : constraints)
    ids.push_back(mesh.insert(outline.points, outline.ends));
  for (const Snap& snap : mesh.snaps()) EXPECT_TRUE(mesh.is_segment(snap.segment));
  for (const ConstraintId id : ids) mesh.remove(id);
  EXPECT_TRUE(mesh.snaps().empty());
}

}  // namespace
}  // namespace loft::cdt
