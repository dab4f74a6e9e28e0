// SPDX-License-Identifier: MIT
#include "reconstruct/fair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reconstruct/fair/edge_meetings.h"
#include "reconstruct/fair/fair_contours.h"
#include "reconstruct/fair/stairs.h"
#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;

double area(const std::vector<Point>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point a = points[i];
    const Point b = points[(i + 1) % points.size()];
    twice += (a.x - points[0].x) * (b.y - points[0].y) - (b.x - points[0].x) * (a.y - points[0].y);
  }
  return twice / 2;
}

/// By how much a contour turns in all, in whole turns.
double turning(const std::vector<Point>& points) {
  double sum = 0;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = points[i];
    const Point b = points[(i + 1) % n];
    const Point c = points[(i + 2) % n];
    sum += std::abs(std::remainder(
        std::atan2(c.y - b.y, c.x - b.x) - std::atan2(b.y - a.y, b.x - a.x), 2 * std::acos(-1.0)));
  }
  return sum / (2 * std::acos(-1.0));
}

bool encloses(const std::vector<Point>& points, Point place) {
  bool is_inside = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point a = points[i];
    const Point b = points[(i + 1) % points.size()];
    if ((a.y > place.y) == (b.y > place.y)) continue;
    if (place.x < a.x + (place.y - a.y) * (b.x - a.x) / (b.y - a.y)) is_inside = !is_inside;
  }
  return is_inside;
}

Slice faired(const Slice& slice, double distance) {
  return fair(std::vector{slice}, distance).front();
}

/// The places of a slice's points, and its edges by their numbers.
struct Drawn {
  std::vector<Point> before;
  std::vector<Point> after;
  std::vector<NetEdge> edges;

  Drawn(const Slice& slice, const Slice& moved) {
    std::map<Point, std::uint32_t> number;
    const auto number_of = [&](std::size_t c, std::size_t p) {
      const Point from = slice.contours[c].points[p];
      const auto [found, is_new] =
          number.try_emplace(from, static_cast<std::uint32_t>(before.size()));
      if (is_new) {
        before.push_back(from);
        after.push_back(moved.contours[c].points[p]);
      }
      EXPECT_EQ(after[found->second], moved.contours[c].points[p]) << "shared points are torn";
      return found->second;
    };
    std::set<NetEdge> all;
    for (std::size_t c = 0; c < slice.contours.size(); ++c)
      for (std::size_t p = 0; p < slice.contours[c].points.size(); ++p) {
        const std::uint32_t a = number_of(c, p);
        const std::uint32_t b = number_of(c, (p + 1) % slice.contours[c].points.size());
        if (a != b) all.emplace(std::min(a, b), std::max(a, b));
      }
    edges.assign(all.begin(), all.end());
  }
};

/// The laws of fair.h, by looking at everything.
void expect_laws(const Slice& slice, double distance) {
  const Slice moved = faired(slice, distance);
  ASSERT_EQ(moved.z, slice.z);
  ASSERT_EQ(moved.contours.size(), slice.contours.size());
  for (std::size_t c = 0; c < slice.contours.size(); ++c) {
    const auto& before = slice.contours[c].points;
    const auto& after = moved.contours[c].points;
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t p = 0; p < before.size(); ++p)
      ASSERT_LE(std::hypot(before[p].x - after[p].x, before[p].y - after[p].y), distance);
    ASSERT_NEAR(area(after), area(before), 1e-4 * std::abs(area(before)) + 1e-12);
  }
  const Drawn drawn(slice, moved);
  for (std::size_t i = 0; i < drawn.edges.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (do_meet(drawn.edges[i], drawn.edges[k], drawn.after)) {
        ASSERT_TRUE(do_meet(drawn.edges[i], drawn.edges[k], drawn.before));
      }
}

/// A star of jittery points; it may cross itself where it is wild.
Contour star(std::mt19937_64& random, Point centre, double radius, double jitter) {
  std::normal_distribution<double> off;
  Contour contour;
  const std::size_t count = 5 + random() % 60;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(count);
    contour.points.push_back({centre.x + radius * std::cos(angle) + jitter * off(random),
                              centre.y + radius * std::sin(angle) + jitter * off(random)});
  }
  return contour;
}

/// Stars beside and in each other, some copies, a point and a line; many cross.
Slice random_slice(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  Slice slice{1, {}};
  const std::size_t count = 1 + random() % 6;
  for (std::size_t i = 0; i < count; ++i) {
    const Point centre{12 * share(random), 12 * share(random)};
    const double jitter = 0.3 * share(random) * share(random);
    slice.contours.push_back(star(random, centre, 1 + 3 * share(random), jitter));
    if (random() % 3 == 0)
      slice.contours.push_back(star(random, centre, 0.1 + 0.8 * share(random), jitter));
    slice.contours.back().label = i % 2 == 0 ? "even" : "odd";
  }
  if (random() % 3 == 0) slice.contours.push_back(slice.contours[0]);
  if (random() % 3 == 0) slice.contours.push_back({{{6, 6}}, ""});
  if (random() % 3 == 0) slice.contours.push_back({{{5, 6}, {6, 6.5}, {7, 7}}, ""});
  return slice;
}

/// Outlines along the pixels of three labels that fill a square: they share their borders.
Slice random_map(std::mt19937_64& random, int size) {
  Slice slice{1, {}};
  std::vector<int> labels(static_cast<std::size_t>(size * size));
  for (int& label : labels) label = static_cast<int>(random() % 3);
  const auto at = [&](int x, int y) {
    const bool is_outside = x < 0 || y < 0 || x >= size || y >= size;
    return is_outside ? -1 : labels[static_cast<std::size_t>(y / 2 * 2 * size + x / 2 * 2)];
  };
  for (int label = 0; label < 3; ++label) {
    std::multimap<std::pair<int, int>, std::pair<int, int>> next;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        if (at(x, y) != label) continue;
        if (at(x, y - 1) != label) next.insert({{x, y}, {x + 1, y}});
        if (at(x + 1, y) != label) next.insert({{x + 1, y}, {x + 1, y + 1}});
        if (at(x, y + 1) != label) next.insert({{x + 1, y + 1}, {x, y + 1}});
        if (at(x - 1, y) != label) next.insert({{x, y + 1}, {x, y}});
      }
    while (!next.empty()) {
      Contour& contour = slice.contours.emplace_back();
      contour.label = std::to_string(label);
      for (auto found = next.begin(); found != next.end();) {
        contour.points.push_back(
            {static_cast<double>(found->first.first), static_cast<double>(found->first.second)});
        const auto to = found->second;
        next.erase(found);
        found = next.find(to);
      }
    }
  }
  return slice;
}

TEST(Fair, KeepsItsLawsOnRandomContours) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    expect_laws(random_slice(random), std::pow(10, static_cast<double>(random() % 300) / 100 - 2));
    if (HasFatalFailure()) return;
  }
}

TEST(Fair, KeepsItsLawsOnLabelsThatTouch) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    expect_laws(random_map(random, 12), 0.1 + static_cast<double>(random() % 20) / 10);
    if (HasFatalFailure()) return;
  }
}

TEST(Fair, LeavesEveryContourInsideOfWhatItWasIn) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 12; ++round) {
    // Crumbs on both sides of a ring, which could jump over it.
    Slice slice{0, {star(random, {0, 0}, 5, 0.1)}};
    for (int i = 0; i < 30; ++i) {
      const double angle = 6.3 * share(random);
      const double radius = 4 + 2 * share(random);
      slice.contours.push_back(
          star(random, {radius * std::cos(angle), radius * std::sin(angle)}, 0.05, 0));
    }
    const Slice moved = faired(slice, 3);
    const Drawn drawn(slice, slice);
    if (!find_meetings(drawn.edges, drawn.before).empty()) continue;
    for (std::size_t c = 1; c < slice.contours.size(); ++c)
      ASSERT_EQ(encloses(moved.contours[0].points, moved.contours[c].points[0]),
                encloses(slice.contours[0].points, slice.contours[c].points[0]))
          << "round " << round << " contour " << c;
  }
}

TEST(Fair, DependsNeitherOnOrderNorOnDirectionNorOnTheFirstPoint) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 60; ++round) {
    const Slice slice = round % 3 == 0 ? random_map(random, 8) : random_slice(random);
    const Slice moved = faired(slice, 0.4);
    std::vector<std::size_t> order(slice.contours.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::shuffle(order, random);
    Slice turned{slice.z, {}};
    Slice expected{slice.z, {}};
    for (const std::size_t i : order) {
      const bool is_reversed = random() % 2 == 0;
      const auto begin = static_cast<std::ptrdiff_t>(random() % slice.contours[i].points.size());
      for (auto [from, to] : {std::pair(&slice, &turned), std::pair(&moved, &expected)}) {
        Contour& contour = to->contours.emplace_back(from->contours[i]);
        std::rotate(contour.points.begin(), contour.points.begin() + begin, contour.points.end());
        if (is_reversed) std::ranges::reverse(contour.points);
      }
    }
    ASSERT_EQ(faired(turned, 0.4), expected) << "round " << round;
  }
}

TEST(Fair, BringsJitterNearerToWhatItIsJitterOf) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> off(0, 0.05);
  Contour jittery = stacks::circle(200, 10);
  for (Point& p : jittery.points) p = {p.x + off(random), p.y + off(random)};
  const Contour smooth = faired({0, {jittery}}, 0.15).contours[0];
  const auto spread = [](const Contour& contour) {
    double sum = 0;
    for (const Point p : contour.points) sum += std::pow(std::hypot(p.x, p.y) - 10, 2);
    return std::sqrt(sum / static_cast<double>(contour.points.size()));
  };
  EXPECT_LT(spread(smooth), 0.65 * spread(jittery));
  EXPECT_LT(turning(smooth.points), 1 + 0.1 * (turning(jittery.points) - 1));
}

/// The pixels of a disc, along their edges.
Contour pixel_disc(int radius) {
  Contour contour;
  const auto width = [&](int row) {
    return std::floor(std::sqrt(radius * radius - (row + 0.5) * (row + 0.5)));
  };
  const auto add = [&](double x, int y) {
    const Point p{x, static_cast<double>(y)};
    if (contour.points.empty() || contour.points.back() != p) contour.points.push_back(p);
  };
  for (int row = -radius; row < radius; ++row)
    for (const int y : {row, row + 1}) add(width(row), y);
  for (int row = radius; row-- > -radius;)
    for (const int y : {row + 1, row}) add(-width(row), y);
  return contour;
}

TEST(Fair, SmoothsStairs) {
  const Contour stairs = pixel_disc(20);
  const Contour smooth = faired({0, {stairs}}, 0.75).contours[0];
  EXPECT_GT(turning(stairs.points), 15);
  EXPECT_LT(turning(smooth.points), 2);
}

TEST(Fair, StairsAreNoticed) {
  Stairs pixels;
  pixels.add({0, {pixel_disc(20)}});
  EXPECT_TRUE(pixels.are_there());
  Stairs others;
  others.add({0, {stacks::circle(100, 10), stacks::square(5)}});
  others.add({1, {faired({0, {pixel_disc(20)}}, 0.5).contours[0]}});
  EXPECT_FALSE(others.are_there());
}

TEST(Fair, DistanceNothingChangesNothing) {
  std::mt19937_64 random(8);
  const Slice slice = random_slice(random);
  EXPECT_EQ(faired(slice, 0), slice);
}

TEST(Fair, StraightSidesAndWhatCrossesStay) {
  // Uneven points on a straight line, far from its corners.
  Contour square = stacks::square(10);
  for (int i = 0; i < 60; ++i)
    square.points.insert(square.points.begin() + 1 + i,
                         {-9.9 + i * (i % 2 == 0 ? 0.33 : 0.332), -10});
  ASSERT_EQ(square.points[0], (Point{-10, -10}));
  const Slice moved = faired({0, {square}}, 0.01);
  EXPECT_NEAR(moved.contours[0].points[30].y, moved.contours[0].points[31].y, 1e-12);
  EXPECT_NEAR(moved.contours[0].points[30].x, square.points[30].x, 1e-9);
  // Two contours that cross: the four edges there keep their ends.
  const Slice crossing{
      0,
      {{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, "a"}, {{{5, 5}, {15, 5}, {15, 15}, {5, 15}}, "b"}}};
  const Slice kept = faired(crossing, 1);
  EXPECT_EQ(kept.contours[0].points[2], crossing.contours[0].points[2]);
  EXPECT_EQ(kept.contours[1].points[0], crossing.contours[1].points[0]);
}

TEST(Fair, SlicesOfOneHeightAreFairTogether) {
  std::mt19937_64 random(5);
  const Slice map = random_map(random, 8);
  std::vector<Slice> parts;
  for (const Contour& contour : map.contours) parts.push_back({map.z, {contour}});
  const Slice together = faired(map, 0.7);
  const std::vector<Slice> apart = fair(parts, 0.7);
  for (std::size_t i = 0; i < parts.size(); ++i)
    EXPECT_EQ(apart[i].contours[0], together.contours[i]);
}

std::vector<Slice> jittery_stack(std::mt19937_64& random, std::size_t count) {
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < count; ++i) {
    slices.push_back(random_slice(random));
    slices.back().z = static_cast<double>(i);
  }
  return slices;
}

TEST(Fair, SurfacesAreValidAndHaveTheFairPoints) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 5; ++round) {
    const std::vector<Slice> slices = jittery_stack(random, 4);
    const Options options{.fair = 0.3, .label = "even"};
    const Surface surface = reconstruct(slices, options).surface;
    ASSERT_EQ(solids::faults(surface), "") << "round " << round;
    const std::vector<Slice> moved = fair(slices, 0.3);
    for (const auto v : surface.vertices()) {
      const Origin& origin = surface.data(v).origin;
      if (origin.kind != VertexKind::contour) continue;
      const Slice& slice = moved[origin.slice];
      const Point p = slice.contours[origin.contour].points[origin.point];
      ASSERT_EQ(surface.point(v), (OpenMesh::Vec3d{p.x, p.y, slice.z}));
    }
  }
}

TEST(Fair, TheNumberOfThreadsChangesNothing) {
  std::mt19937_64 random(4);
  const std::vector<Slice> slices = jittery_stack(random, 12);
  EXPECT_EQ(fair(slices, 0.4, 0, 1), fair(slices, 0.4, 0, 4));
}

TEST(Fair, DistancesThatAreNoneAreRefused) {
  const std::vector<Slice> slices{{0, {stacks::square(1)}}, {1, {stacks::square(1)}}};
  EXPECT_THROW(static_cast<void>(reconstruct(slices, {.fair = -1.0})), InputError);
  EXPECT_THROW(static_cast<void>(reconstruct(slices, {.fair = std::nan("")})), InputError);
}

TEST(Fair, ContoursWithCoordinatesThatAreNoneAreLeftOut) {
  Slice slice{0, {pixel_disc(5), pixel_disc(5)}};
  slice.contours[0].points[3].x = std::nan("");
  const Slice moved = faired(slice, 0.5);
  EXPECT_EQ(moved.contours[1], faired({0, {pixel_disc(5)}}, 0.5).contours[0]);
  EXPECT_EQ(moved.contours[0].points[4], slice.contours[0].points[4]);
}

TEST(Fair, ContoursAtTheEndsOfNumbersStayAdmitted) {
  for (const double size : {1e69, 1e-29}) {
    Slice slice{0, {pixel_disc(5)}};
    for (Point& p : slice.contours[0].points) p = {p.x * size, p.y * size};
    expect_laws(slice, size / 2);
  }
}

}  // namespace
}  // namespace loft
