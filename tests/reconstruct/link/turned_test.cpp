// SPDX-License-Identifier: MIT
// A stack that is turned gets the same surface, turned: what the slices have in common exactly, a
// side or a corner, they have within rounding only from then on.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "mesh/measure.h"
#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;
using std::numbers::pi;

std::vector<Slice> turned(std::vector<Slice> slices, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (Slice& slice : slices)
    for (Contour& contour : slice.contours)
      for (Point& p : contour.points) p = {p.x * c - p.y * s, p.x * s + p.y * c};
  return slices;
}

/// What must be the same whichever way a stack is turned.
struct Shape {
  std::size_t components = 0;
  int genus = 0;
  std::map<std::string, int> links;
  double volume = 0;
};

Shape shape(const std::vector<Slice>& slices, Options options = {}) {
  options.reports_slabs = true;
  const Reconstructed made = reconstruct(slices, options);
  EXPECT_EQ(solids::faults(made.surface), "");
  const Measures measures = measure(to_mesh(made.surface));
  Shape shape{measures.components, measures.genus, {}, measures.volume};
  for (const SlabReport& slab : made.slabs) {
    for (const LinkReport& link : slab.links) {
      std::string words = std::string(name(link.kind)) + ' ' + name(link.reason);
      for (const auto* ids : {&link.lower, &link.upper}) {
        words += " |";
        for (const ContourId& id : *ids)
          words += ' ' + std::to_string(id.slice) + '.' + std::to_string(id.contour);
      }
      ++shape.links[words];
    }
  }
  return shape;
}

/// Expects of a stack turned by an angle what it is unturned.
void expect_same(const std::vector<Slice>& slices, double angle, const Options& options = {}) {
  SCOPED_TRACE("turned by " + std::to_string(angle));
  const Shape before = shape(slices, options);
  const Shape after = shape(turned(slices, angle), options);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.genus, before.genus);
  EXPECT_EQ(after.links, before.links);
  EXPECT_NEAR(after.volume, before.volume, 1e-6 * before.volume);
}

/// Some angles all around, of no special value.
std::vector<double> angles(int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(0.0123 + 2 * pi * i / count);
  return all;
}

Contour box(Point low, Point high) { return {{low, {high.x, low.y}, high, {low.x, high.y}}, {}}; }

TEST(Turned, PartsWithASideInCommonAreLinkedByTheirPlaces) {
  const std::vector<Slice> slices{{0, {box({3, 5}, {13, 15})}}, {4, {box({13, 5}, {23, 15})}}};
  EXPECT_NEAR(shape(slices).volume, 400, 1e-9);
  for (const double angle : angles(50)) expect_same(slices, angle);
}

TEST(Turned, AnOrderedLinkOfPartsWithASideInCommonKeepsItsVolume) {
  const std::vector<Slice> slices{{0, {box({3, 5}, {13, 15})}}, {4, {box({13, 5}, {23, 15})}}};
  Options options;
  options.links = {{{0, 0}, {1, 0}, true, {}}};
  EXPECT_NEAR(shape(slices, options).volume, 400, 1e-9);
  for (const double angle : angles(50)) expect_same(slices, angle, options);
}

TEST(Turned, PartsThatTouchInACornerOrAlongPartOfASideStayApart) {
  for (const Contour& other : {box({13, 18}, {20, 27.1}), box({13, 9}, {16, 12.9})}) {
    const std::vector<Slice> slices{{0, {box({3, 5}, {13, 18})}}, {4, {other}}};
    EXPECT_EQ(shape(slices).components, 2U);
    for (const double angle : angles(50)) expect_same(slices, angle);
  }
}

TEST(Turned, ASideInCommonBesideAnOverlapMakesNoTunnel) {
  // Two hooks that overlap at their feet, and run along each other above.
  const Contour hook{{{0, 0}, {10, 0}, {10, 9.3}, {7, 9.1}, {7, 2}, {3, 2.5}, {3, 8}, {0, 8}}, {}};
  const Contour other{
      {{1, -1}, {9, -1}, {9, 1}, {6, 1.2}, {6, 6}, {7, 6}, {7, 9}, {5.5, 9}, {5.2, 1}, {1, 1}}, {}};
  const std::vector<Slice> slices{{0, {hook}}, {3, {other}}};
  EXPECT_EQ(shape(slices).genus, 0);
  for (const double angle : angles(50)) expect_same(slices, angle);
}

TEST(Turned, CornersOnASideKeepTheHeightsOfTheirChords) {
  // Both corners of the upper base lie on one side of the lower triangle, which is led through them
  // whether rounding puts them inside or outside.
  const Point a{10, 0};
  const Point b{3, 8};
  const auto at = [&](double share, double off) {
    return Point{a.x + share * (b.x - a.x) + off * (b.y - a.y),
                 a.y + share * (b.y - a.y) - off * (b.x - a.x)};
  };
  const Contour base{{{0, 0}, a, b}, {}};
  for (const double rise : {0.3, -0.2}) {
    const std::vector<Slice> slices{{0, {base}},
                                    {1, {{{at(0.2, 0), at(0.5, rise), at(0.7, 0)}, {}}}}};
    for (const double angle : angles(50)) expect_same(slices, angle);
  }
}

TEST(Turned, AnEdgeWithinAWallTouchesItWhicheverWayItWasRounded) {
  // Three corners of the upper outline lie on a side of the lower one, but for rounding. A crossing
  // was pulled into one of them, so that an edge ran within the wall there.
  const std::vector<Slice> slices{{0, {{{{2.1, -2.1}, {6.9, -1.5}, {2.3, 2.7}}, {}}}},
                                  {1, {{{{2.9, -2}, {5.3, -1.7}, {6.1, -1.6}, {5.1, 0.7}}, {}}}}};
  for (const double angle : angles(50)) expect_same(slices, angle);
}

TEST(Turned, ANotchInASideThatIsCommonKeepsItsSheet) {
  // Along the side there are slivers by rounding, beside which it could not be split.
  const Contour whole{{{0, 0}, {27.618, 0}, {27.618, 15.333}, {0, 15.333}}, {}};
  const Contour notched{{{1, 1},
                         {27.618, 5.2678},
                         {27.618, 10.179719},
                         {21.7754, 10.1572},
                         {23.148, 10.464678},
                         {24.258, 10.649571},
                         {25.374, 10.779361},
                         {26.496, 10.859806},
                         {27.618, 10.883923},
                         {27.618, 15.333},
                         {1, 15}},
                        {}};
  const std::vector<Slice> slices{{7, {whole}}, {9, {notched}}};
  for (const double angle : angles(50)) expect_same(slices, angle);
}

TEST(Turned, EndsOfRegularOutlinesAreTheSameDomes) {
  // All their points are on one circle: which diagonals are Delaunay's is left to rounding.
  for (const std::size_t n : {5U, 6U, 7U, 8U, 12U, 24U, 64U}) {
    SCOPED_TRACE(n);
    const std::vector<Slice> slices{{0, {stacks::circle(n, 1)}},
                                    {1, {stacks::circle(n, 1, {5, 0})}}};
    for (const double angle : angles(7)) expect_same(slices, angle);
  }
}

TEST(Turned, PartsThatMoveByJustWhatIsAllowedAreLinked) {
  const std::vector<Slice> slices{{0, {stacks::circle(12, 1)}},
                                  {1, {stacks::circle(12, 1, {3, 4})}}};
  Options options;
  options.max_shift = 5;
  EXPECT_EQ(shape(slices, options).components, 1U);
  for (const double angle : angles(50)) expect_same(slices, angle, options);
}

TEST(Turned, PartsThatOverlapJustEnoughAreLinkedAlike) {
  // Both cover 0.6, and 0.15, of what they cover together.
  for (const double aside : {2.5, 170 / 23.0}) {
    const std::vector<Slice> slices{{0, {box({3, 5}, {13, 15})}},
                                    {4, {box({3 + aside, 5}, {13 + aside, 15})}}};
    for (const double angle : angles(50)) expect_same(slices, angle);
  }
}

// --- Random stacks ---

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11U) * 0x1p-53);
}

/// Cells of one uneven grid: their sides and corners are in common with cells of other slices.
std::vector<Slice> cells(Random& random) {
  constexpr int n = 4;
  Point grid[n + 1][n + 1];
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k)
      grid[i][k] = {i + uniform(random, -0.3, 0.3), k + uniform(random, -0.3, 0.3)};
  std::vector<Slice> slices;
  for (int z = 0; z < 3; ++z) {
    Slice slice{z + uniform(random, 0, 0.5), {}};
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k)
        if (uniform(random, 0, 1) < 0.5)
          slice.contours.push_back(
              {{grid[i][k], grid[i + 1][k], grid[i + 1][k + 1], grid[i][k + 1]}, {}});
    slices.push_back(slice);
  }
  return slices;
}

Contour blob(Random& random, Point centre, double size) {
  Contour contour;
  const int n = 5 + static_cast<int>(random() % 8);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * (i + uniform(random, 0, 0.7)) / n;
    const double radius = size * uniform(random, 0.5, 1);
    contour.points.push_back(
        {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return contour;
}

/// Outlines that cross anyhow.
std::vector<Slice> blobs(Random& random) {
  std::vector<Slice> slices;
  for (int z = 0; z < 4; ++z) {
    Slice slice{z + uniform(random, 0, 0.5), {}};
    for (int i = 0; i < 3; ++i)
      if (i == 0 || uniform(random, 0, 1) < 0.7)
        slice.contours.push_back(blob(random, {3.0 * i + uniform(random, -0.3, 0.3), 0}, 1));
    slices.push_back(slice);
  }
  return slices;
}

/// Triangles upon the sides of a polygon, outside or inside: one side, a piece of a side, or a
/// corner in common.
std::vector<Slice> neighbours(Random& random) {
  const Contour base = blob(random, {}, 3);
  std::vector<Slice> slices{{0, {base}}, {1, {}}};
  const std::size_t n = base.points.size();
  for (std::size_t i = 0; i < n; i += 2) {
    const Point a = base.points[i];
    const Point b = base.points[(i + 1) % n];
    const double from = random() % 2 == 0 ? 0 : uniform(random, 0.1, 0.4);
    const double to = random() % 2 == 0 ? 1 : uniform(random, 0.6, 0.9);
    const double rise = uniform(random, 0.1, 0.3) * (random() % 4 == 0 ? -1 : 1);
    const auto at = [&](double share, double off) {
      return Point{a.x + share * (b.x - a.x) + off * (b.y - a.y),
                   a.y + share * (b.y - a.y) - off * (b.x - a.x)};
    };
    slices[1].contours.push_back({{at(from, 0), at(0.55, rise), at(to, 0)}, {}});
  }
  return slices;
}

void expect_same_of_seed(std::uint64_t seed) {
  Random random(seed);
  const auto kind = seed % 3;
  const std::vector<Slice> slices = kind == 0   ? cells(random)
                                    : kind == 1 ? blobs(random)
                                                : neighbours(random);
  SCOPED_TRACE("seed " + std::to_string(seed));
  try {
    expect_same(slices, uniform(random, 0, 2 * pi));
  } catch (const InputError&) {
    // Fewer than two slices with an area.
  }
}

TEST(Turned, AnyStackKeepsItsLinksItsGenusAndItsVolume) {
  const char* count = std::getenv("LOFT_TURNED_COUNT");
  const std::uint64_t seeds = count == nullptr ? 60 : std::strtoull(count, nullptr, 10);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) expect_same_of_seed(seed);
}

TEST(Turned, PlacesThatAreAsNearToSeveralOthersGoToTheMiddleOfThem) {
  // Cells that are drawn over others: which of two sides is nearer was left to rounding, and with
  // it the volume, by up to a fifth.
  for (const std::uint64_t seed : {78U, 342U, 417U, 423U, 555U, 909U, 948U})
    expect_same_of_seed(seed);
}

}  // namespace
}  // namespace loft
