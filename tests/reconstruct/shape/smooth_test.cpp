// SPDX-License-Identifier: MIT
#include "reconstruct/shape/smooth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "cdt/effort.h"
#include "mesh/measure.h"
#include "mesh/vec3.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using std::numbers::pi;

Surface make(const std::vector<Slice>& slices, bool is_smooth, Cap cap = Cap::flat) {
  return reconstruct(slices, {.cap = cap, .smooth = is_smooth}).surface;
}

double volume(const Surface& surface) { return measure(to_mesh(surface)).volume; }

/// Every contour edge of a clean stack is an edge of the surface, in one piece.
void expect_contour_edges(const std::vector<Slice>& slices, const Surface& surface) {
  std::map<OpenMesh::Vec3d, OpenMesh::SmartVertexHandle> vertices;
  for (const auto v : surface.vertices()) vertices.emplace(surface.point(v), v);
  for (const Slice& slice : slices) {
    for (const Contour& contour : slice.contours) {
      for (std::size_t i = 0; i < contour.points.size(); ++i) {
        const cdt::Point a = contour.points[i];
        const cdt::Point b = contour.points[(i + 1) % contour.points.size()];
        const auto from = vertices.find({a.x, a.y, slice.z});
        const auto to = vertices.find({b.x, b.y, slice.z});
        ASSERT_TRUE(from != vertices.end() && to != vertices.end());
        EXPECT_TRUE(surface.find_halfedge(from->second, to->second).is_valid());
      }
    }
  }
}

/// The mean over the vertices and middles of edges of how far they are from a ball's surface.
double mean_error(const Surface& surface, double radius, double highest) {
  double sum = 0;
  double count = 0;
  const auto look = [&](const OpenMesh::Vec3d& p) {
    if (std::abs(p[2]) > highest) return;
    sum += std::abs(p.norm() - radius);
    ++count;
  };
  for (const auto v : surface.vertices()) look(surface.point(v));
  for (const auto e : surface.edges()) look(surface.calc_edge_midpoint(e));
  return sum / count;
}

TEST(Smooth, ABallIsSeveralTimesRounder) {
  const auto slices = stacks::sphere(8, 200);
  const Surface plain = make(slices, false);
  const Surface bent = make(slices, true);
  EXPECT_TRUE(check(bent).empty());
  expect_contour_edges(slices, bent);
  const double highest = slices.back().z;
  EXPECT_LT(mean_error(bent, 1, highest), mean_error(plain, 1, highest) / 4);
  const double between = pi * (2 * highest - 2 * std::pow(highest, 3) / 3);
  EXPECT_LT(std::abs(volume(bent) - between), std::abs(volume(plain) - between) / 4);
}

TEST(Smooth, ABallTakesTwiceAsManyTriangles) {
  const auto slices = stacks::sphere(8, 200);
  EXPECT_LT(make(slices, true).n_faces(), 2.1 * static_cast<double>(make(slices, false).n_faces()));
}

TEST(Smooth, ALargerToleranceMakesFewerTriangles) {
  for (const auto& slices :
       {stacks::sphere(8, 40), stacks::Torus::slices(12, 24), stacks::y_branch(6, 16)}) {
    std::size_t finer = std::numeric_limits<std::size_t>::max();
    for (double tolerance = 1e-3; tolerance < 2; tolerance *= 2) {
      const Surface bent =
          reconstruct(slices, {.smooth = true, .smooth_tolerance = tolerance}).surface;
      EXPECT_EQ(solids::faults(bent), "");
      EXPECT_LE(bent.n_faces(), finer) << tolerance;
      finer = bent.n_faces();
    }
    // Straight tiles are split where they fork.
    EXPECT_LE(finer, make(slices, false).n_faces());
  }
}

TEST(Smooth, ATolerance0IsThatOfTheSlices) {
  const auto slices = stacks::Torus::slices(12, 40);
  const Surface bent = reconstruct(slices, {.smooth = true, .smooth_tolerance = 0}).surface;
  EXPECT_EQ(to_mesh(bent), to_mesh(make(slices, true)));
}

SliceShape shape_of(const Slice& slice) {
  std::vector<ContourSource> contours;
  for (const Contour& contour : slice.contours) contours.push_back({contour.points});
  std::vector<Defect> repairs;
  return SliceShape(clean(contours, slice.z, {}, repairs));
}

/// How far a surface is from the smooth one through its slices, at most over vertices and middles
/// of edges, in the slabs that have slices on both sides.
double most_off(const std::vector<Slice>& slices, const Surface& surface) {
  std::vector<SliceShape> shapes;
  for (const Slice& slice : slices) shapes.push_back(shape_of(slice));
  double most = 0;
  for (std::size_t i = 1; i + 2 < slices.size(); ++i) {
    const SmoothPassage passage({&shapes[i - 1], &shapes[i], &shapes[i + 1], &shapes[i + 2]});
    const auto look = [&](const OpenMesh::Vec3d& p) {
      if (p[2] <= slices[i].z || p[2] >= slices[i + 1].z) return;
      const Sample sample = passage.at({p[0], p[1], p[2]});
      most = std::max(most, std::abs(sample.value) / length(sample.gradient));
    };
    for (const auto v : surface.vertices()) look(surface.point(v));
    for (const auto e : surface.edges()) look(surface.calc_edge_midpoint(e));
  }
  return most;
}

TEST(Smooth, TrianglesAreWithinTheTolerance) {
  const auto slices = stacks::sphere(10, 120);
  const double straight = most_off(slices, make(slices, false));
  for (const double tolerance : {0.006, 0.004, 0.002, 0.001}) {
    ASSERT_LT(tolerance, straight);
    const Surface bent =
        reconstruct(slices, {.smooth = true, .smooth_tolerance = tolerance}).surface;
    EXPECT_LE(most_off(slices, bent), tolerance) << tolerance;
  }
}

// Of a dense stack every third slice is kept; the others tell the volume.
TEST(Smooth, ATorusOnEdgeComesNearerToItsVolume) {
  const auto dense = stacks::Torus::slices(36, 60);
  std::vector<Slice> kept;
  for (std::size_t i = 1; i < dense.size(); i += 3) kept.push_back(dense[i]);
  const Surface plain = make(kept, false);
  const Surface bent = make(kept, true);
  EXPECT_TRUE(check(bent).empty());
  expect_contour_edges(kept, bent);
  EXPECT_EQ(measure(to_mesh(bent)).genus, 1);
  const double between = volume(make({dense.begin() + 1, dense.end() - 1}, true));
  EXPECT_LT(std::abs(volume(bent) - between), std::abs(volume(plain) - between) / 2);
}

// A cone's distances are linear in z, a prism's do not change: there is nothing to bend.
TEST(Smooth, WhatIsStraightStaysStraight) {
  std::vector<Slice> cone;
  std::vector<Slice> prism;
  for (int i = 0; i < 5; ++i) {
    cone.push_back({static_cast<double>(i), {stacks::circle(60, 10 - i)}});
    prism.push_back({static_cast<double>(i), {stacks::square(2)}});
  }
  for (const auto& slices : {cone, prism})
    EXPECT_EQ(to_mesh(make(slices, true)), to_mesh(make(slices, false)));
}

// Distances outside of a corner are round; the links along the edges tell that the faces are flat.
TEST(Smooth, ASlantedPyramidKeepsItsFaces) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i) {
    Contour contour = stacks::square(10 - 1.5 * i);
    for (cdt::Point& p : contour.points) p = {p.x + 2 * i, p.y + i};
    slices.push_back({static_cast<double>(i), {contour}});
  }
  EXPECT_EQ(to_mesh(make(slices, true)), to_mesh(make(slices, false)));
}

/// A box about the origin that lies askew, and its slices.
class TiltedBox {
 public:
  explicit TiltedBox(Vec3 half_lengths) : half_(half_lengths) {}

  /// How far a place is outside, along the axis in which that is furthest; negative inside.
  [[nodiscard]] double distance(const OpenMesh::Vec3d& p) const {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i)
      most = std::max(most, std::abs(dot({p[0], p[1], p[2]}, axes_[i])) - half_[i]);
    return most;
  }
  [[nodiscard]] Slice slice(double z) const {
    std::vector<cdt::Point> points;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double s : {-1.0, 1.0}) {
        for (const double t : {-1.0, 1.0}) {
          const Vec3 middle = along(along({}, s * half_[(axis + 1) % 3], axes_[(axis + 1) % 3]),
                                    t * half_[(axis + 2) % 3], axes_[(axis + 2) % 3]);
          const double way = (z - middle[2]) / axes_[axis][2];
          if (std::abs(way) > half_[axis]) continue;
          const Vec3 p = along(middle, way, axes_[axis]);
          points.push_back({p[0], p[1]});
        }
      }
    }
    cdt::Point middle;
    for (const cdt::Point p : points) {
      middle.x += p.x / static_cast<double>(points.size());
      middle.y += p.y / static_cast<double>(points.size());
    }
    std::ranges::sort(points, {},
                      [&](cdt::Point p) { return std::atan2(p.y - middle.y, p.x - middle.x); });
    Contour contour;
    contour.points = points;
    return {z, {contour}};
  }

 private:
  Vec3 half_;
  // Turned by 15 degrees about y, then by 25 about x.
  static constexpr double cos_15 = 0.9659258262890683;
  static constexpr double sin_15 = 0.25881904510252074;
  static constexpr double cos_25 = 0.9063077870366499;
  static constexpr double sin_25 = 0.42261826174069944;
  std::array<Vec3, 3> axes_{Vec3{cos_15, sin_25* sin_15, -cos_25* sin_15}, Vec3{0, cos_25, sin_25},
                            Vec3{sin_15, -sin_25* cos_15, cos_25* cos_15}};
};

// What is machined: faces flat, edges sharp, whatever way it lies.
TEST(Smooth, ATiltedBoxIsNoWorseThanStraight) {
  const TiltedBox box({10, 6, 14});
  std::vector<Slice> slices;
  for (double z = -15; z < 15.5; z += 1.25) slices.push_back(box.slice(z));
  const auto mean = [&](const Surface& surface) {
    double sum = 0;
    double all = 0;
    for (const auto f : surface.faces()) {
      const auto p = surface.calc_face_centroid(f);
      if (std::abs(p[2]) >= 15) continue;
      sum += std::abs(box.distance(p)) * surface.calc_face_area(f);
      all += surface.calc_face_area(f);
    }
    return sum / all;
  };
  const Surface plain = make(slices, false);
  const Surface bent = make(slices, true);
  EXPECT_TRUE(check(bent).empty());
  expect_contour_edges(slices, bent);
  EXPECT_LE(mean(bent), 1.02 * mean(plain));
}

// Noise of 3% beside a gap twenty times as high; continued all the way it would be 16%.
TEST(Smooth, WhereSlicesAreMissingItDoesNotBulge) {
  std::vector<Slice> slices;
  for (const auto& [z, radius] : {std::pair(0.0, 10.0), {1.0, 10.3}, {21.0, 10.3}, {22.0, 10.0}})
    slices.push_back({z, {stacks::circle(64, radius)}});
  const Surface bent = make(slices, true);
  EXPECT_TRUE(check(bent).empty());
  const double prism = volume(make(slices, false));
  EXPECT_NEAR(volume(bent), prism, 0.05 * prism);
}

// Both sides of a wall are bent alike, however near the other one is.
TEST(Smooth, WallsKeepTheirThickness) {
  constexpr double radius = 20;
  constexpr std::size_t count = 60;
  const auto ball = [](double r) {
    const double height = std::min(18.0, r);
    return count * std::sin(2 * pi / count) * (r * r * height - std::pow(height, 3) / 3);
  };
  for (const double wall : {3.0, 1.0, 0.3, 0.1}) {
    SCOPED_TRACE(wall);
    std::vector<Slice> slices;
    for (double z = -18; z <= 18; z += 3) {
      Slice& slice = slices.emplace_back(Slice{z, {}});
      for (const double r : {radius, radius - wall})
        if (r > std::abs(z))
          slice.contours.push_back(stacks::circle(count, std::sqrt(r * r - z * z)));
    }
    const Surface bent = make(slices, true);
    EXPECT_TRUE(check(bent).empty());
    const double right = ball(radius) - ball(radius - wall);
    EXPECT_LE(std::abs(volume(bent) - right), std::abs(volume(make(slices, false)) - right));
  }
}

/// A ball whose last slices are its poles' caps: the dome above them has their curvature.
TEST(Smooth, EndsGoOnAsTheSlicesBeforeThem) {
  std::vector<Slice> slices;
  const double gap = 0.25;
  for (double z = -0.875; z < 1; z += gap)
    slices.push_back({z, {stacks::circle(200, std::sqrt(1 - z * z))}});
  const Surface bent = make(slices, true, Cap::dome);
  EXPECT_TRUE(check(bent).empty());
  double top = 0;
  for (const auto v : bent.vertices()) top = std::max(top, bent.point(v)[2]);
  EXPECT_NEAR(top, 1, 0.1 * gap);
  EXPECT_NEAR(volume(bent), 4 * pi / 3, 0.01 * 4 * pi / 3);
}

// A hole that is a ball's half.
TEST(Smooth, AHoleThatEndsIsRoundedToo) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i) {
    Slice slice{static_cast<double>(i), {stacks::square(10)}};
    if (i < 3) slice.contours.push_back(stacks::circle(60, std::sqrt(6.76 - i * i)));
    slices.push_back(slice);
  }
  const Surface bent = make(slices, true);
  EXPECT_TRUE(check(bent).empty());
  expect_contour_edges(slices, bent);
  double top = 0;
  for (const auto v : bent.vertices())
    if (bent.point(v)[2] < 3) top = std::max(top, bent.point(v)[2]);
  EXPECT_NEAR(top, 2.6, 0.05);
}

/// The triangles of each slab, by places.
std::map<std::uint32_t, std::set<std::set<OpenMesh::Vec3d>>> slabs(const Surface& surface) {
  std::map<std::uint32_t, std::set<std::set<OpenMesh::Vec3d>>> found;
  for (const auto f : surface.faces()) {
    std::set<OpenMesh::Vec3d> corners;
    for (const auto v : surface.fv_range(f)) corners.insert(surface.point(v));
    found[surface.data(f).slab].insert(corners);
  }
  return found;
}

/// The triangles of a slab that are not in one of its slices.
std::set<std::set<OpenMesh::Vec3d>> between_slices_of(const Surface& surface, std::uint32_t slab) {
  std::set<std::set<OpenMesh::Vec3d>> found = slabs(surface)[slab];
  std::erase_if(found, [](const std::set<OpenMesh::Vec3d>& corners) {
    return std::ranges::all_of(
        corners, [&](const OpenMesh::Vec3d& p) { return p[2] == (*corners.begin())[2]; });
  });
  return found;
}

// A slice in which a part is not yet does not tell how the part goes on from where it begins.
TEST(Smooth, APartBendsWhereItBeginsAsAtTheEndOfTheStack) {
  const auto ball = stacks::sphere(8, 60);
  auto after_another = ball;
  after_another.insert(after_another.begin(), {ball.front().z - 0.25, {stacks::square(1, {9, 9})}});
  const auto expected = between_slices_of(make(ball, true), 0);
  EXPECT_EQ(between_slices_of(make(after_another, true), 1), expected);
  EXPECT_NE(between_slices_of(make(ball, false), 0), expected);
}

// The ball's top is 0.85 of a slab above its last slice; the rod beside it goes on.
TEST(Smooth, AnEndIsAsHighAsItsTrendLeads) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i) {
    const double z = 2.0 * i + 0.3;
    slices.push_back({z, {stacks::circle(20, 1, {40, 0})}});
    if (z < 10) slices.back().contours.push_back(stacks::circle(80, std::sqrt(100 - z * z)));
  }
  const Surface bent = make(slices, true);
  EXPECT_EQ(solids::faults(bent), "");
  double top = 0;
  for (const auto v : bent.vertices())
    if (bent.point(v)[0] < 20) top = std::max(top, bent.point(v)[2]);
  EXPECT_NEAR(top, 10, 0.05);
}

/// A section of a spheroid around the origin that lies along x, 12 long and 4 wide and high to
/// either side.
Contour lying_spheroid(double z) {
  Contour contour = stacks::circle(120, std::sqrt(16 - z * z));
  for (cdt::Point& p : contour.points) p.x *= 3;
  return contour;
}

// A part that is longer than wide ends as a spheroid does, not as a ridge. The rod beside it goes
// on.
TEST(Smooth, ALongEndGetsLowerTowardsItsFarEnds) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i) {
    const double z = 1.2 * i - 2;
    slices.push_back({z, {stacks::circle(20, 1, {40, 0})}});
    if (z < 4) slices.back().contours.push_back(lying_spheroid(z));
  }
  const double last = 2.8;
  const Surface bent = make(slices, true);
  EXPECT_EQ(solids::faults(bent), "");
  double sum = 0;
  double count = 0;
  for (const auto v : bent.vertices()) {
    const OpenMesh::Vec3d p = bent.point(v);
    if (p[0] > 20 || p[2] <= last) continue;
    sum += std::abs(p[2] - std::sqrt(16 - p[0] * p[0] / 9 - p[1] * p[1]));
    ++count;
  }
  EXPECT_LT(sum / count, 0.03);
}

// A long hole is bent the same where it begins, however near the outline around it is there.
TEST(Smooth, ALongHoleBendsAsItGoesWhereItBegins) {
  const auto hole = [](double wide) {
    std::vector<Slice> slices;
    for (double z = -3; z <= 3; z += 1.2) {
      Contour box = stacks::square(wide);
      for (cdt::Point& p : box.points) p.x = std::copysign(20, p.x);
      slices.push_back({z, {box}});
      if (z > -2) slices.back().contours.push_back(lying_spheroid(z));
    }
    const Surface bent = reconstruct(slices, {.smooth = true, .smooth_tolerance = 0.01}).surface;
    EXPECT_EQ(solids::faults(bent), "");
    return 80 * wide * 6 - volume(bent);
  };
  EXPECT_NEAR(hole(5), hole(20), 1e-3);
}

// A hollow ball's last outline is around nothing; the one before it is around a hole. Its bottom
// is half a slab below; beside it a rod goes on.
TEST(Smooth, AnEndOfWhatIsHollowIsAsHighAsItsOutlinesLead) {
  std::vector<Slice> slices;
  for (double z = -7; z <= 7; z += 2) {
    Slice& slice = slices.emplace_back(Slice{z, {stacks::circle(20, 1, {40, 0})}});
    for (const double radius : {6.0, 4.5})
      if (radius > std::abs(z))
        slice.contours.push_back(stacks::circle(80, std::sqrt(radius * radius - z * z)));
  }
  const Surface bent = make(slices, true);
  EXPECT_EQ(solids::faults(bent), "");
  double bottom = 0;
  for (const auto v : bent.vertices())
    if (bent.point(v)[0] < 20) bottom = std::min(bottom, bent.point(v)[2]);
  EXPECT_NEAR(bottom, -6, 0.05);
}

/// Slices of a box that stands on a corner, turned about it, between the same two heights.
std::vector<Slice> tilted_box(std::size_t slabs, double turn) {
  const auto corner = [&](unsigned bits) {
    const Vec3 p{bits & 1U ? 3.0 : -3.0, bits & 2U ? 2.0 : -2.0, bits & 4U ? 1.5 : -1.5};
    const Vec3 q{p[0] * std::cos(turn) - p[1] * std::sin(turn),
                 p[0] * std::sin(turn) + p[1] * std::cos(turn), p[2]};
    return Vec3{q[0], q[1] * 0.8 - q[2] * 0.6, q[1] * 0.6 + q[2] * 0.8};
  };
  double top = 0;
  for (unsigned bits = 0; bits < 8; ++bits) top = std::max(top, corner(bits)[2]);
  std::vector<Slice> slices;
  for (std::size_t i = 0; i <= slabs; ++i) {
    const double z = 0.9 * top * (2 * static_cast<double>(i) / static_cast<double>(slabs) - 1);
    std::vector<cdt::Point> points;
    for (unsigned bits = 0; bits < 8; ++bits) {
      for (unsigned axis = 1; axis < 8; axis *= 2) {
        const Vec3 a = corner(bits & ~axis);
        const Vec3 b = corner(bits | axis);
        if ((bits & axis) != 0 || (a[2] < z) == (b[2] < z)) continue;
        const Vec3 p = along(a, (z - a[2]) / (b[2] - a[2]), minus(b, a));
        points.push_back({p[0], p[1]});
      }
    }
    cdt::Point middle{};
    for (const cdt::Point p : points)
      middle = {middle.x + p.x / static_cast<double>(points.size()),
                middle.y + p.y / static_cast<double>(points.size())};
    std::ranges::sort(points, {}, [&](const cdt::Point& p) {
      return std::atan2(p.y - middle.y, p.x - middle.x);
    });
    slices.push_back({z, {{points, ""}}});
  }
  return slices;
}

// Where an edge of the box is between two slices, links do not go on straight; and beside its
// corners distances are round.
TEST(Smooth, ABoxOnItsCornerIsHardlyBent) {
  double plain_off = 0;
  double bent_off = 0;
  for (double turn = 0.1; turn < 1.5; turn += 0.2) {
    const auto slices = tilted_box(12, turn);
    const double exact = volume(make(tilted_box(12 * 50, turn), false));
    plain_off += std::abs(volume(make(slices, false)) - exact);
    bent_off += std::abs(volume(make(slices, true)) - exact);
  }
  EXPECT_LT(bent_off, plain_off);
}

// Discs that do not overlap their neighbours, one upon the other but for a shear.
TEST(Smooth, ASlantedRodStaysStraight) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i)
    slices.push_back({static_cast<double>(i), {stacks::circle(40, 1, {1.5 * i, 0.5 * i})}});
  const Surface bent = make(slices, true);
  EXPECT_TRUE(check(bent).empty());
  EXPECT_NEAR(volume(bent), 5 * 20 * std::sin(2 * pi / 40), 1e-6);
  EXPECT_EQ(bent.n_vertices(), 240);
}

/// Vertices in the middles of edges lie where their neighbours do, however thin the tiles are: else
/// nearly all of a fan meets nearly all of it.
TEST(Smooth, AFanOfThinTilesBendsEvenly) {
  const std::vector<Slice> slices{{0, {stacks::circle(4000, 10)}}, {1, {stacks::circle(3, 9)}}};
  const auto smooth = [&] {
    const cdt::Effort effort(1'000'000);  // five times as many where its tiles meet
    return reconstruct(slices, {.smooth = true, .threads = 1}).surface;
  };
  EXPECT_EQ(solids::faults(smooth()), "");
}

/// Each split in a fan was followed by flips of a good part of it.
TEST(Smooth, AWideFanTakesAFixedNumberOfStepsAPoint) {
  for (const std::size_t few : {3U, 12U}) {
    const std::vector<Slice> slices{{0, {stacks::circle(4000, 10)}},
                                    {1, {stacks::circle(few, 9)}},
                                    {2, {stacks::circle(4000, 10)}}};
    const cdt::Effort effort(250 * 8000);  // 194 and 175 are taken
    EXPECT_NO_THROW(reconstruct(slices, {.smooth = true, .threads = 1})) << few;
  }
}

TEST(Smooth, AnEditOfASliceChangesFourSlabs) {
  auto slices = stacks::sphere(12, 50);
  const auto before = slabs(make(slices, true));
  for (cdt::Point& p : slices[6].contours[0].points) p.x *= 1.1;
  const auto after = slabs(make(slices, true));
  ASSERT_EQ(before.size(), 11);
  for (const auto& [slab, triangles] : before)
    EXPECT_EQ(triangles == after.at(slab), slab < 4 || slab > 7) << slab;
}

// Between them a bent surface would leave one and enter the other.
TEST(Smooth, ShellsThinnerThanTheirBendDoNotMeet) {
  for (const double thickness : {0.1, 0.01, 1e-4}) {
    const double turn = thickness > 0.05 ? 0.05 : 0;  // thinner ones would cross
    std::vector<Slice> slices;
    for (int i = -4; i <= 4; ++i) {
      const double outer = std::sqrt(25 - i * i);
      slices.push_back(
          {static_cast<double>(i),
           {stacks::circle(40, outer), stacks::circle(40, outer - thickness, {}, turn)}});
    }
    const Surface bent = make(slices, true);
    EXPECT_TRUE(check(bent).empty()) << thickness;
    expect_contour_edges(slices, bent);
  }
}

// Next to such a gap the trend of what ends there was lost in rounding, and its heights with it.
TEST(Smooth, APartMayEndNextToAVeryThinSlab) {
  for (const double gap : {1e-7, 1e-9, 1e-12}) {
    const std::vector<Slice> slices{{0, {stacks::circle(24, 1)}},
                                    {gap, {stacks::circle(24, 0.1)}},
                                    {1, {stacks::circle(24, 0.1, {50, 0})}},
                                    {2, {stacks::circle(24, 0.1, {50, 0})}}};
    const Surface bent = reconstruct(slices, {.smooth = true, .link = LinkRule::overlap}).surface;
    EXPECT_EQ(solids::faults(bent), "") << gap;
    expect_contour_edges(slices, bent);
  }
}

TEST(Smooth, AnyContoursMakeASolid) {
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<Slice> slices;
    for (int i = 0; i < 4; ++i)
      slices.push_back(seed % 3 == 0 ? stacks::random_mask(i, random, 6, 0.4)
                                     : stacks::random_slice(i, random, seed % 3 == 1));
    solids::expect_solid(slices, {.smooth = true});
  }
}

}  // namespace
}  // namespace loft
