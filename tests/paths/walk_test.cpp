// SPDX-License-Identifier: MIT
#include "paths/walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace loft::paths {
namespace {

/// To the right, then a quarter of a circle to the left, then up.
const Path bend{.status = Status::found,
                .length = 4 + std::numbers::pi / 2,
                .pieces = {{.from = {0, 0}, .to = {2, 0}},
                           {.from = {2, 0}, .to = {3, 1}, .turn = Turn::left, .centre = {2, 1}},
                           {.from = {3, 1}, .to = {3, 3}}}};

void expect_near(Point p, Point q) {
  EXPECT_NEAR(p.x, q.x, 1e-15);
  EXPECT_NEAR(p.y, q.y, 1e-15);
}

TEST(Walk, GoesAlongPiecesAndArcs) {
  EXPECT_EQ(point_along(bend, {0, 0}, -1), Point(0, 0));
  EXPECT_EQ(point_along(bend, {0, 0}, 1.5), Point(1.5, 0));
  const double half = std::sqrt(0.5);
  expect_near(point_along(bend, {0, 0}, 2 + std::numbers::pi / 4), {2 + half, 1 - half});
  expect_near(point_along(bend, {0, 0}, 3 + std::numbers::pi / 2), {3, 2});
  EXPECT_EQ(point_along(bend, {0, 0}, 100), Point(3, 3));
}

TEST(Walk, OfNoPathStaysWhereItIs) { EXPECT_EQ(point_along({}, {4, 5}, 1), Point(4, 5)); }

TEST(Walk, LengthsOfPiecesSumToThatOfThePath) {
  double sum = 0;
  for (const Piece& piece : bend.pieces) sum += length(piece);
  EXPECT_DOUBLE_EQ(sum, bend.length);
}

TEST(Status, IsToldInWords) {
  EXPECT_EQ(name_of(Status::found), "found");
  EXPECT_EQ(name_of(Status::start_blocked), "start blocked");
  EXPECT_EQ(name_of(Status::gave_up), "gave up");
}

}  // namespace
}  // namespace loft::paths
