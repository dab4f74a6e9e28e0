// SPDX-License-Identifier: MIT
#include "io/rounding/rounded_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "io/meshes/extent.h"
#include "io/meshes/stl.h"
#include "io/surfaces.h"
#include "mesh/check.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/io/shapes.h"
#include "tests/reconstruct/random_pairs.h"
#include "tests/reconstruct/stacks.h"

namespace loft::io {
namespace {

/// As who knows places only sees it: one vertex a place.
Mesh welded(const Mesh& mesh) {
  Mesh result;
  std::map<Vec3, std::uint32_t> at;
  std::vector<std::uint32_t> numbers;
  for (const Vec3& point : mesh.points) {
    const auto [entry, is_new] = at.try_emplace(point, result.points.size());
    if (is_new) result.points.push_back(point);
    numbers.push_back(entry->second);
  }
  result.faces = mesh.faces;
  for (auto& face : result.faces)
    for (std::uint32_t& corner : face) corner = numbers[corner];
  return result;
}

Mesh as_in_file(const Surface& surface, const FloatFrame& frame) {
  Mesh mesh = to_mesh(surface);
  for (Vec3& point : mesh.points) point = frame.rounded(point);
  return mesh;
}

/// What is wrong with it for those who know places only; empty: nothing.
std::string complaint(const Mesh& mesh) {
  std::string result;
  for (const Finding& finding : check(welded(mesh)))
    result += std::string(name(finding.fault)) + ' ';
  if (contacts(mesh).points > 0) result += "contacts";
  return result;
}

/// The distance between two places, in units in the last place of a size.
double units_apart(const Vec3& a, const Vec3& b, double size) {
  double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) most = std::max(most, std::abs(a[axis] - b[axis]));
  return most / (size * 0x1p-23);
}

double largest_coordinate(const Mesh& mesh) {
  double largest = 0;
  for (const Vec3& point : mesh.points)
    for (const double coordinate : point) largest = std::max(largest, std::abs(coordinate));
  return largest;
}

struct Tally {
  int surfaces = 0;
  int at_fault = 0;
  int left = 0;
};

/// Rounds a surface about a place, and holds what comes out against the promises.
void expect_promises(const Surface& surface, const FloatFrame& frame, Tally& tally) {
  const Part part{"", &surface};
  SCOPED_TRACE("about " + std::to_string(frame.origin[0]) + ", times " +
               std::to_string(frame.factor));
  const RoundedParts rounded({&part, 1}, frame, true);
  const Rounding& rounding = rounded.rounding();
  const Surface& mended = *rounded.parts()[0].surface;
  const Mesh before = as_in_file(surface, frame);
  const Mesh after = as_in_file(mended, frame);
  ++tally.surfaces;
  EXPECT_EQ(rounding.faults == 0, complaint(before).empty()) << complaint(before);
  EXPECT_EQ(rounding.left == 0, complaint(after).empty()) << complaint(after);
  if (rounding.faults == 0) {
    EXPECT_EQ(&mended, &surface) << "copied for nothing";
    return;
  }
  ++tally.at_fault;
  if (&mended == &surface) {
    Box3 box = no_box;
    for (const Vec3& point : before.points) box = extended(box, point);
    EXPECT_TRUE(is_coarse(box, 0x1p-10)) << "not mended";
    return;
  }
  tally.left += rounding.left > 0 ? 1 : 0;
  EXPECT_LE(rounding.left, rounding.faults);
  EXPECT_LE(before.points.size() - after.points.size(), rounding.collapsed);
  if (rounding.collapsed > 0) return;  // vertices have other numbers
  ASSERT_EQ(after.faces, before.faces);
  const double size = largest_coordinate(before);
  for (std::size_t v = 0; v < before.points.size(); ++v)
    EXPECT_LE(units_apart(before.points[v], after.points[v], size), 9);  // 8, and rounding
}

TEST(RoundedParts, RandomPairsOfSlicesAreSolidsInFloat) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= cases(160); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + " (" + stacks::kind_of_pair(seed) + ")");
    const stacks::Pair pair = stacks::random_pair(seed);
    Options options;
    options.fill = pair.fill;
    Surface surface;
    try {
      surface = reconstruct(pair.slices, options).surface;
    } catch (const Error&) {
      continue;  // nothing with an area
    }
    if (surface.n_faces() == 0) continue;
    const Part part{"", &surface};
    const Box3 box = extent({&part, 1});
    expect_promises(surface, {{}, 1}, tally);
    expect_promises(surface, {centre_of(box), 0.001}, tally);
    // Some bits fewer.
    expect_promises(surface, {{box.low[0] - 300 * (box.high[0] - box.low[0] + 1), 0, 0}, 1}, tally);
    if (HasFailure()) break;
  }
  RecordProperty("surfaces", tally.surfaces);
  RecordProperty("at_fault", tally.at_fault);
  RecordProperty("left", tally.left);
  EXPECT_GT(tally.at_fault, tally.surfaces / 100) << "nothing is tested";
  EXPECT_LE(tally.left, tally.surfaces / 20) << "what nearly coincides may be beyond mending";
}

// GCC 12 left some conversions out where it made vectors of them.
TEST(RoundedParts, AreTheSameWithSeveralThreads) {
  std::vector<Surface> surfaces;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const stacks::Pair pair = stacks::random_pair(seed);
    Options options;
    options.fill = pair.fill;
    try {
      surfaces.push_back(reconstruct(pair.slices, options).surface);
    } catch (const Error&) {
      continue;  // nothing with an area
    }
  }
  std::vector<Part> parts;
  for (const Surface& surface : surfaces) parts.push_back({"", &surface});
  const Vec3 far{1 << 12, 1 << 12, 1 << 12};  // some bits fewer
  for (const bool are_one : {false, true}) {
    const RoundedParts alone(parts, {far, 1}, are_one, 1);
    EXPECT_GT(alone.rounding().faults, 0U);
    for (const unsigned threads : {2U, 5U}) {
      const RoundedParts together(parts, {far, 1}, are_one, threads);
      EXPECT_EQ(together.rounding(), alone.rounding());
      for (std::size_t i = 0; i < parts.size(); ++i)
        EXPECT_EQ(to_mesh(*together.parts()[i].surface), to_mesh(*alone.parts()[i].surface));
    }
  }
}

TEST(FloatFrame, EveryCoordinateIsAFloat) {
  std::vector<Vec3> places;
  for (int i = 0; i < 100; ++i) places.push_back({0.1 * i + 0.1, 0.2 * i + 0.1, 0.3 * i + 0.1});
  const FloatFrame frame{{0.05, 0.1, 0.2}, 0.001};
  for (Vec3& place : places) place = frame.rounded(place);
  for (const Vec3& place : places) {
    for (const double coordinate : place) {
      const volatile auto number = static_cast<float>(coordinate);
      EXPECT_EQ(coordinate, static_cast<double>(number));
    }
  }
}

TEST(RoundedParts, PartsThatTouchInACornerAreDrawnApart) {
  const std::vector<Slice> slices{{0, {stacks::square(1), stacks::square(1, {2, 2})}},
                                  {1, {stacks::square(1), stacks::square(1, {2, 2})}}};
  const Surface surface = reconstruct(slices).surface;
  ASSERT_GT(contacts(to_mesh(surface)).points, 0U);
  std::stringstream file;
  const Part part{"", &surface};
  const Written written = write(file, ".stl", {&part, 1});
  EXPECT_EQ(written.rounding.left, 0U);
  EXPECT_GT(written.rounding.moved, 0U);
  const auto meshes = read_stl(file.str(), "file");
  EXPECT_EQ(complaint(meshes.at(0).mesh), "");
  EXPECT_NEAR(measure(meshes.at(0).mesh).volume, 8, 1e-5);
}

TEST(RoundedParts, TheSameSolidTwiceInAnStlIsTwoSolids) {
  const Surface surface = testing::prism(7);
  std::stringstream file;
  const std::vector<Part> parts{{"a", &surface}, {"b", &surface}};
  EXPECT_EQ(write(file, ".stl", parts).rounding.left, 0U);
  const Mesh mesh = read_stl(file.str(), "file").at(0).mesh;
  EXPECT_EQ(contacts(mesh).points, 0U);
  EXPECT_EQ(welded(mesh).points.size(), 14U * 2);
}

TEST(Surfaces, AnStlOfMapCoordinatesIsAboutARoundPlaceNearThem) {
  const Surface surface = testing::prism(16, {448'251.3, 5'411'943.2, 500}, 2);
  const Part part{"", &surface};
  std::stringstream file;
  const Written written = write(file, ".stl", {&part, 1});
  ASSERT_TRUE(written.origin.has_value());
  EXPECT_EQ(*written.origin, (Vec3{448'253, 5'411'945, 501}));
  EXPECT_EQ(written.rounding.left, 0U);
  EXPECT_EQ(file.str().substr(0, 80).find("origin 448253 5411945 501"),
            std::string("loft 0.1.0 ").size());
  const Mesh mesh = read_stl(file.str(), "file").at(0).mesh;
  EXPECT_EQ(complaint(mesh), "");
  EXPECT_NEAR(measure(mesh).volume, measure(surface).volume, 1e-4);
}

TEST(Surfaces, AnStlIsAboutTheOriginOfTheOptions) {
  const Surface surface = testing::prism(16, {10, 20, 30});
  const Part part{"", &surface};
  std::stringstream file;
  WriteOptions options;
  options.origin = Vec3{10, 20, 30};
  EXPECT_EQ(write(file, ".stl", {&part, 1}, options).origin, options.origin);
  const Mesh mesh = read_stl(file.str(), "file").at(0).mesh;
  EXPECT_EQ(std::ranges::min(mesh.points, {}, [](const Vec3& p) { return p[2]; })[2], 0);
}

TEST(Surfaces, ExactFormatsAreLeftAlone) {
  const Surface surface = testing::prism(16, {448'251.3, 5'411'943.2, 500}, 2);
  const Part part{"", &surface};
  for (const char* extension : {".ply", ".obj", ".off"}) {
    std::stringstream file;
    const Written written = write(file, extension, {&part, 1});
    EXPECT_EQ(written.rounding, Rounding{});
    EXPECT_FALSE(written.origin.has_value());
  }
}

}  // namespace
}  // namespace loft::io
