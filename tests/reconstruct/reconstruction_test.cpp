// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "reconstruct/measure.h"
#include "tests/reconstruct/edit_script.h"
#include "tests/reconstruct/random_pairs.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using edits::broken;
using edits::difference;
using edits::RandomEdits;

/// Edits in CI; LOFT_SOAK_EDITS makes it more.
std::size_t edit_count(std::size_t usual) {
  const char* const wanted = std::getenv("LOFT_SOAK_EDITS");
  return wanted == nullptr ? usual : std::strtoul(wanted, nullptr, 10);
}

/// Plays random edits; the surface is compared with the one built at once after every few.
void play(const std::vector<Slice>& pool, const Options& options, std::uint64_t seed,
          std::size_t count, std::size_t every = 10) {
  Reconstruction live(options);
  RandomEdits edits(pool, seed);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string words = edits.next(live);
    ASSERT_EQ(words, "") << "seed " << seed << " edit " << i;
    if (i % every != 0 && i + 1 != count) continue;
    ASSERT_EQ(broken(live.surface()), "") << "seed " << seed << " edit " << i;
    ASSERT_EQ(difference(live, options), "") << "seed " << seed << " edit " << i;
    if (options.cap != Cap::open) {
      Surface compact = live.snapshot().surface(1);
      ASSERT_EQ(solids::faults(compact), "") << "seed " << seed << " edit " << i;
    }
    if (i % (5 * every) == 0) live.collect_garbage();
  }
}

std::vector<Slice> random_pool(std::uint64_t seed, std::size_t count, bool on_grid) {
  std::mt19937_64 random(seed);
  std::vector<Slice> pool;
  for (std::size_t i = 0; i < count; ++i)
    pool.push_back(stacks::random_slice(static_cast<double>(i), random, on_grid));
  return pool;
}

std::vector<Slice> mask_pool(std::uint64_t seed, std::size_t count, double density) {
  std::mt19937_64 random(seed);
  std::vector<Slice> pool;
  for (std::size_t i = 0; i < count; ++i)
    pool.push_back(stacks::random_mask(static_cast<double>(i), random, 4, density));
  return pool;
}

TEST(Reconstruction, StackBuiltSliceBySliceIsTheStackBuiltAtOnce) {
  for (const Cap cap : {Cap::flat, Cap::dome, Cap::open}) {
    const Options options{.cap = cap};
    Reconstruction live(options);
    for (const Slice& slice : stacks::sphere(12, 24)) {
      const SurfaceChange change = live.insert(slice);
      EXPECT_LE(change.added.size(), 3U);
      EXPECT_EQ(broken(live.surface()), "");
      EXPECT_EQ(difference(live, options), "");
    }
  }
}

TEST(Reconstruction, RandomEditsOfAForkGiveWhatTheBatchGives) {
  const auto pool = stacks::y_branch(9, 12);
  for (const Cap cap : {Cap::flat, Cap::dome, Cap::open})
    for (const bool is_smooth : {false, true})
      for (std::uint64_t seed = 1; seed <= 2; ++seed)
        play(pool, {.cap = cap, .smooth = is_smooth}, seed, edit_count(120), 1);
}

TEST(Reconstruction, RandomEditsOfCrossingPolygonsGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    play(random_pool(seed, 6, seed % 2 == 0), {}, seed, edit_count(60), 1);
}

/// Contours side by side, some with cavities, maybe all in a plate.
std::vector<Slice> many_pool(std::uint64_t seed, std::size_t count, bool in_plate) {
  std::mt19937_64 random(seed);
  const auto share = [&] { return static_cast<double>(random() % 1000) / 1000; };
  std::vector<Slice> pool;
  for (std::size_t i = 0; i < count; ++i) {
    Slice& slice = pool.emplace_back(Slice{static_cast<double>(i), {}});
    for (int k = 0; k < 9; ++k) {
      const cdt::Point centre{10.0 * (k % 3) + share(), 10.0 * (k / 3) + share()};
      slice.contours.push_back(
          stacks::circle(8 + random() % 8, 3 + 1.5 * share(), centre, share()));
      if (random() % 3 == 0) slice.contours.push_back(stacks::circle(6, 1 + share(), centre));
    }
    if (in_plate) slice.contours.push_back(stacks::square(30, {10, 10}));
  }
  return pool;
}

TEST(Reconstruction, RandomEditsOfManyContoursGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    play(many_pool(seed, 5, seed % 2 == 0), {}, seed, edit_count(100), 2);
}

TEST(Reconstruction, OneContourOfManyLeavesTheFacesOfTheOthersInTheirPlaces) {
  Reconstruction live;
  for (const Slice& slice : many_pool(5, 5, false)) live.insert(slice);
  const Surface before = live.surface();
  Contour moved = live.find(2)->contours[0];
  for (cdt::Point& p : moved.points) p.x += 0.25;
  const SurfaceChange change = live.move_contour(2, 0, moved.points);
  EXPECT_EQ(change.added.size(), 2U);
  EXPECT_LT(change.faces_removed, live.face_count() / 9);
  EXPECT_EQ(difference(live, {}), "");
  // Where nothing was reported, the same handles have the same corners.
  std::size_t same = 0;
  for (const Surface::FaceHandle f : before.faces()) {
    if (live.surface().status(f).deleted()) continue;
    std::vector<Surface::Point> old_corners;
    std::vector<Surface::Point> new_corners;
    for (const auto v : before.fv_range(f)) old_corners.push_back(before.point(v));
    for (const auto v : live.surface().fv_range(f)) new_corners.push_back(live.surface().point(v));
    if (old_corners == new_corners) ++same;
  }
  EXPECT_GE(same, before.n_faces() - change.faces_removed);
}

TEST(Reconstruction, VolumeAndCountsAreThoseOfTheSurface) {
  for (const Cap cap : {Cap::flat, Cap::dome}) {
    Reconstruction live({.cap = cap});
    for (const Slice& slice : stacks::y_branch(9, 24)) live.insert(slice);
    live.replace(2, {2, {stacks::circle(30, 1.5)}});
    const Measures measures = measure(to_mesh(live.snapshot().surface(1)));
    EXPECT_NEAR(live.volume(), measures.volume, 1e-12 * measures.volume);
    EXPECT_EQ(live.face_count(), measures.faces);
    EXPECT_EQ(live.vertex_count(), measures.vertices);
  }
}

TEST(Reconstruction, BadEditsSayWhatIsWrong) {
  using testing::HasSubstr;
  using testing::ThrowsMessage;
  Reconstruction live;
  live.insert(Slice{1, {stacks::circle(5, 1)}});
  const auto bad = Slice{2, {{{{0, 0}, {NAN, 1}, {2, INFINITY}}, ""}}};
  EXPECT_THAT([&] { live.insert(bad); }, ThrowsMessage<InputError>(testing::AllOf(
                                             HasSubstr("point 1"), HasSubstr("point 2"))));
  EXPECT_THAT([&] { live.remove(3); }, ThrowsMessage<InputError>(HasSubstr("no slice at z = 3")));
  EXPECT_THAT(
      [&] {
        live.replace(3, Slice{1, {}});
      },
      ThrowsMessage<InputError>(HasSubstr("no slice at z = 3")));
  EXPECT_THAT([&] { live.move_contour(1, 1, {}); },
              ThrowsMessage<InputError>(HasSubstr("has no contour 1")));
  EXPECT_THAT(
      [&] {
        live.insert(Slice{std::nextafter(1.0, 2.0), {}});
      },
      ThrowsMessage<InputError>(HasSubstr("nearer to the slice at z = 1 ")));
  EXPECT_THROW(Reconstruction({.simplify = 1}), std::invalid_argument);
}

std::vector<DefectKind> kinds(const std::vector<Defect>& repairs) {
  std::vector<DefectKind> all;
  for (const Defect& repair : repairs) all.push_back(repair.kind);
  return all;
}

TEST(Reconstruction, SliceAtAHeightThatIsTakenIsReportedUntilItIsGivenAnew) {
  using testing::ElementsAre;
  Reconstruction live;
  live.insert(Slice{1, {stacks::circle(5, 1)}});
  live.insert(Slice{2, {stacks::circle(5, 1)}});
  const Slice more{2, {stacks::circle(5, 1, {9, 9})}};
  EXPECT_THAT(kinds(live.insert(more).repairs), ElementsAre(DefectKind::merged_slices));
  ASSERT_THAT(kinds(live.repairs()), ElementsAre(DefectKind::merged_slices));
  EXPECT_EQ(live.repairs()[0].slice, 1U);
  EXPECT_EQ(live.find(2)->contours.size(), 2U);
  live.insert(Slice{3, {stacks::circle(5, 1)}});
  EXPECT_THAT(kinds(live.repairs()), ElementsAre(DefectKind::merged_slices));
  live.replace(2, more);
  EXPECT_TRUE(live.repairs().empty());
}

TEST(Reconstruction, EmptySliceIsReportedWhereTheShapeIsInterrupted) {
  using testing::ElementsAre;
  Reconstruction live;
  for (const double z : {1, 2}) live.insert(Slice{z, {stacks::circle(5, 1)}});
  EXPECT_TRUE(live.insert(Slice{3, {}}).repairs.empty());  // the shape ends below it
  for (const double z : {4, 5}) live.insert(Slice{z, {stacks::circle(5, 1)}});
  ASSERT_THAT(kinds(live.repairs()), ElementsAre(DefectKind::empty_slice));
  EXPECT_EQ(live.repairs()[0].slice, 2U);
  EXPECT_THAT(kinds(live.replace(2, Slice{2, {}}).repairs), ElementsAre(DefectKind::empty_slice));
  EXPECT_THAT(kinds(live.repairs()), ElementsAre(DefectKind::empty_slice, DefectKind::empty_slice));
  live.remove(1);
  EXPECT_TRUE(live.repairs().empty());
}

TEST(Reconstruction, SlicesThatAreLeftApartAreReported) {
  const stacks::Pair pair =
      stacks::random_pair(12412);  // one of few between which nothing is valid
  const Options options{.fill = pair.fill};
  Reconstruction live(options);
  live.insert(pair.slices[0]);
  const SurfaceChange change = live.insert(pair.slices[1]);
  EXPECT_THAT(kinds(change.repairs), testing::Contains(DefectKind::unlinked_slices));
  EXPECT_THAT(kinds(live.repairs()), testing::Contains(DefectKind::unlinked_slices));
  EXPECT_EQ(difference(live, options), "");
}

TEST(Reconstruction, SurfacesOfSeveralLabelsShareTheirSlices) {
  const auto labelled = [](Contour contour, const char* label) {
    contour.label = label;
    return contour;
  };
  Reconstruction one({.label = "one"});
  Reconstruction two({.label = "two"});
  for (const double z : {1, 2}) {
    const auto slice = std::make_shared<const Slice>(Slice{
        z, {labelled(stacks::circle(6, 1), "one"), labelled(stacks::square(5, {9, 9}), "two")}});
    one.insert(slice);
    two.insert(slice);
    EXPECT_EQ(one.find(z), slice.get());
    EXPECT_EQ(two.find(z), slice.get());
  }
  EXPECT_EQ(one.face_count(), 20U);
  EXPECT_EQ(two.face_count(), 12U);
  const auto bad =
      std::make_shared<const Slice>(Slice{3, {labelled({{{0, 0}, {NAN, 1}, {2, 1}}, ""}, "two")}});
  EXPECT_NO_THROW(one.insert(bad));  // it has nothing of it
  EXPECT_THROW(two.insert(bad), InputError);
}

TEST(Reconstruction, SnapshotsStayAsTheyWere) {
  Reconstruction live;
  for (const Slice& slice : stacks::sphere(6, 12)) live.insert(slice);
  const Snapshot snapshot = live.snapshot();
  const Mesh before = to_mesh(snapshot.surface(1));
  live.remove(live.slices()[2].z);
  live.replace(live.slices()[3].z, Slice{live.slices()[3].z, {stacks::square(0.3)}});
  EXPECT_EQ(to_mesh(snapshot.surface(1)), before);
  std::size_t faces = 0;
  for (std::size_t i = 0; i < snapshot.slab_count(); ++i)
    faces += snapshot.patch(i, i + 1).mesh.faces.size();
  EXPECT_EQ(faces, before.faces.size());
}

TEST(Reconstruction, RandomEditsOfMasksThatTouchGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    play(mask_pool(seed, 6, 0.5), {}, seed, edit_count(60), 1);
}

}  // namespace
}  // namespace loft
