// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

/// Keeps what it gets.
class Kept : public SurfaceSink {
 public:
  void add_vertices(std::span<const SurfaceVertex> vertices) override {
    vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
  }
  void add_faces(std::span<const SurfaceFace> faces) override {
    faces_.insert(faces_.end(), faces.begin(), faces.end());
  }
  void end(const VertexNumbers& numbers) override {
    for (SurfaceFace& face : faces_)
      for (std::uint32_t& corner : face.corners) corner = numbers.final(corner);
  }

  std::vector<SurfaceVertex> vertices_;
  std::vector<SurfaceFace> faces_;
};

SliceSource source(const std::vector<Slice>& slices, std::size_t points_said) {
  SliceSource source;
  for (const Slice& slice : slices) source.slices.push_back({slice.z, points_said});
  source.read = [&slices](std::uint32_t i) { return slices[i]; };
  return source;
}

void expect_same_defects(const std::vector<Defect>& some, const std::vector<Defect>& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(describe(some[i]), describe(others[i]));
}

void expect_same(const Reconstructed& made, const OutOfCoreReport& report, const Kept& kept) {
  const Surface& surface = made.surface;
  ASSERT_EQ(kept.vertices_.size(), surface.n_vertices());
  ASSERT_EQ(kept.faces_.size(), surface.n_faces());
  for (const auto v : surface.vertices()) {
    const SurfaceVertex& vertex = kept.vertices_[static_cast<std::size_t>(v.idx())];
    const auto& p = surface.point(v);
    ASSERT_EQ(vertex.place, (Vec3{p[0], p[1], p[2]}));
    ASSERT_EQ(vertex.origin, surface.data(v).origin);
  }
  const Mesh mesh = to_mesh(surface);
  for (const auto f : surface.faces()) {
    const auto i = static_cast<std::size_t>(f.idx());
    ASSERT_EQ(kept.faces_[i].corners, mesh.faces[i]);
    ASSERT_EQ(kept.faces_[i].kind, surface.data(f).kind);
    ASSERT_EQ(kept.faces_[i].slab, surface.data(f).slab);
  }
  const Measures measures = measure(surface);
  EXPECT_EQ(report.measures.vertices, measures.vertices);
  EXPECT_EQ(report.measures.edges, measures.edges);
  EXPECT_EQ(report.measures.faces, measures.faces);
  EXPECT_EQ(report.measures.components, measures.components);
  EXPECT_EQ(report.measures.genus, measures.genus);
  EXPECT_EQ(report.measures.area, measures.area);
  EXPECT_EQ(report.measures.volume, measures.volume);
  expect_same_defects(report.repairs, made.repairs);
}

/// With groups of all sizes; each slice is said to have so many points that groups come out small.
void expect_same_out_of_core(const std::vector<Slice>& slices, const Options& options) {
  const Reconstructed made = reconstruct(slices, options);
  for (const std::size_t points_said : {1U << 20U, 1U << 15U, 0U}) {
    Kept kept;
    const OutOfCoreReport report =
        reconstruct_out_of_core(source(slices, points_said), options, kept);
    expect_same(made, report, kept);
  }
}

TEST(OutOfCore, MakesTheSameSurfaceInTheSameOrder) {
  std::mt19937_64 random(11);
  std::vector<std::vector<Slice>> stacks{stacks::Torus::slices(25, 20), stacks::y_branch(9, 30)};
  for (const double density : {0.4, 0.6}) {
    auto& masks = stacks.emplace_back();
    for (int i = 0; i < 7; ++i) masks.push_back(stacks::random_mask(i, random, 9, density));
  }
  std::reverse(stacks[0].begin(), stacks[0].end());
  for (const auto& slices : stacks) {
    for (const Cap cap : {Cap::flat, Cap::dome, Cap::open}) {
      expect_same_out_of_core(slices, {.cap = cap, .threads = 1});
      expect_same_out_of_core(slices, {.cap = cap, .smooth = true, .threads = 2});
      expect_same_out_of_core(slices,
                              {.cap = cap, .smooth = true, .smooth_tolerance = 0.03, .threads = 2});
      expect_same_out_of_core(slices, {.fair = 0.2, .cap = cap, .threads = 2});
    }
  }
}

TEST(OutOfCore, MakesTheSameOfAnyContours) {
  for (std::uint64_t seed = 0; seed < cases(40); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<Slice> slices;
    for (int i = 0; i < 6; ++i) slices.push_back(stacks::random_slice(i, random, true));
    expect_same_out_of_core(slices, {.threads = 1});
  }
}

TEST(OutOfCore, MergesTrimsAndWarnsAsInMemory) {
  std::vector<Slice> slices{{7, {}}, {2, {stacks::square(1)}}, {1, {}}, {3, {}}, {9, {}}};
  slices.push_back({4, {stacks::square(2)}});
  slices.push_back({4, {stacks::square(1), stacks::square(1)}});
  slices.push_back({5, {stacks::circle(9, 2)}});
  slices.push_back({2, {stacks::square(1, {5, 5})}});
  for (const Cap cap : {Cap::flat, Cap::dome, Cap::open})
    for (const bool smooth : {false, true})
      expect_same_out_of_core(slices, {.cap = cap, .smooth = smooth, .threads = 1});
}

void expect_refused_as_in_memory(const std::vector<Slice>& slices) {
  std::string expected;
  try {
    (void)reconstruct(slices);
  } catch (const InputError& error) {
    expected = error.what();
  }
  Kept kept;
  try {
    (void)reconstruct_out_of_core(source(slices, 1), {}, kept);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), expected);
  }
}

TEST(OutOfCore, RefusesWhatIsRefusedInMemory) {
  const Slice empty{5, {}};
  const Slice filled{7, {stacks::square(1)}};
  Slice bad{9, {stacks::square(2)}};
  bad.contours[0].points[2].x = 1e200;
  const Slice near{7 + 1e-14, {stacks::square(1)}};
  for (const auto& slices :
       std::vector<std::vector<Slice>>{{}, {empty}, {filled}, {filled, bad}, {filled, near}})
    expect_refused_as_in_memory(slices);
}

TEST(OutOfCore, NamesAllHeightsThatAreNoNumbers) {
  std::vector<Slice> slices = stacks::sphere(5, 10);
  slices[1].z = slices[3].z = std::numeric_limits<double>::quiet_NaN();
  expect_refused_as_in_memory(slices);
}

TEST(OutOfCore, PassesOnWhatReadingThrowsAndStopsWhenAskedTo) {
  const auto slices = stacks::sphere(30, 20);
  SliceSource broken = source(slices, 1U << 20U);
  broken.read = [&](std::uint32_t i) -> Slice {
    if (i >= 17) throw Error("slice " + std::to_string(i));
    return slices[i];
  };
  Kept kept;
  try {
    (void)reconstruct_out_of_core(broken, {.threads = 2}, kept);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "slice 17");
  }
  EXPECT_THROW((void)reconstruct_out_of_core(source(slices, 1U << 20U), {}, kept,
                                             [](Stage, double fraction) { return fraction < 0.5; }),
               Cancelled);
}

}  // namespace
}  // namespace loft
