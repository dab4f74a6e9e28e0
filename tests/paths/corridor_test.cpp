// SPDX-License-Identifier: MIT
#include "paths/corridor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "overlay/distance.h"
#include "overlay/validity.h"

namespace loft::paths {
namespace {

/// How far a point is from a path of straight pieces and arcs.
double distance_to(const Path& path, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& piece : path.pieces) {
    const Point c = piece.centre;
    const double sign = piece.turn == Turn::left ? 1 : -1;
    const auto turn = [&](Point a, Point b) {
      return sign * ((a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x));
    };
    const double ends = std::min(overlay::distance(p, piece.from), overlay::distance(p, piece.to));
    if (piece.turn == Turn::straight)
      least = std::min(least,
                       overlay::distance(p, overlay::nearest_on_segment(p, piece.from, piece.to)));
    else if (turn(piece.from, p) >= 0 && turn(p, piece.to) >= 0)
      least = std::min(least, std::abs(overlay::distance(p, c) - overlay::distance(piece.from, c)));
    least = std::min(least, ends);
  }
  return least;
}

void expect_corridor(const Path& path, double half_width, double error) {
  const overlay::MultiPolygon polygons = corridor(path, half_width, error);
  EXPECT_EQ(polygons.size(), 1U);
  EXPECT_TRUE(overlay::is_valid(polygons));
  const auto expect_ring = [&](const overlay::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point b = ring[(i + 1) % ring.size()];
      const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
      EXPECT_NEAR(distance_to(path, a), half_width, error);
      EXPECT_NEAR(distance_to(path, middle), half_width, error);
    }
  };
  for (const overlay::Polygon& polygon : polygons) {
    expect_ring(polygon.outer);
    for (const overlay::Ring& hole : polygon.holes) expect_ring(hole);
  }
}

TEST(Corridor, IsRoundAtItsEnds) {
  const Path path{.status = Status::found, .length = 10, .pieces = {{{0, 0}, {6, 8}}}};
  const auto polygons = corridor(path, 2, 1e-6);
  ASSERT_EQ(polygons.size(), 1U);
  EXPECT_NEAR(overlay::area(polygons).to_double(), 40 + 4 * std::numbers::pi, 1e-5);
  expect_corridor(path, 2, 1e-6);
}

TEST(Corridor, GoesAlongArcs) {
  const Path path{.status = Status::found,
                  .length = 3,
                  .pieces = {{{-4, -5}, {0, -5}},
                             {{0, -5}, {5, 0}, Turn::left, {0, 0}},
                             {{5, 0}, {5, 3}},
                             {{5, 3}, {7, 5}, Turn::right, {7, 3}}}};
  expect_corridor(path, 0.5, 1e-3);
  expect_corridor(path, 3, 1e-3);
  expect_corridor(path, 8, 1e-3);
}

TEST(Corridor, IsNowhereFurtherFromThePathThanItsWidth) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<> coordinate(0, 100);
    Path path{.status = Status::found, .length = 0, .pieces = {}};
    Point from{50, 50};
    for (int i = 0; i < 8; ++i) {
      const double x = coordinate(random);
      const Point to{x, coordinate(random)};
      path.pieces.push_back({from, to});
      from = to;
    }
    expect_corridor(path, 1 + seed % 20, 0.01);
  }
}

TEST(Corridor, IsNoneForNoPieces) {
  EXPECT_TRUE(corridor({.status = Status::found, .length = 0, .pieces = {}}, 1, 0.1).empty());
  EXPECT_THROW((void)corridor({}, 0, 0.1), std::invalid_argument);
  EXPECT_THROW((void)corridor({}, 1, -1), std::invalid_argument);
}

}  // namespace
}  // namespace loft::paths
