// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mesh/check.h"
#include "mesh/measure.h"
#include "tests/cases.h"
#include "tests/reconstruct/live/change_watch.h"
#include "tests/reconstruct/live/edit_script.h"
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
  return wanted == nullptr ? cases(usual) : std::strtoul(wanted, nullptr, 10);
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
        play(pool, {.cap = cap, .smooth = is_smooth}, seed, edit_count(60), 1);
}

TEST(Reconstruction, RandomEditsOfBentSlabsGiveWhatTheBatchGives) {
  for (const std::optional<double> tolerance : {std::optional<double>(), {0.02}})
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
      play(random_pool(seed, 5, false), {.smooth = true, .smooth_tolerance = tolerance}, seed,
           edit_count(20), 1);
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

/// Coarse plates, turned, some with a fine hole and a part in it; small holes and parts about.
std::vector<Slice> slanted_pool(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  const auto share = [&] { return static_cast<double>(random() % 1000) / 1000; };
  const double turn = share();
  std::vector<Slice> pool;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = static_cast<double>(i);
    Slice& slice = pool.emplace_back(Slice{z, {stacks::circle(4, 12 + 0.1 * z, {}, turn)}});
    if (seed % 3 != 0) slice.contours.push_back(stacks::circle(100, 6 + 0.1 * z));
    if (seed % 3 == 1) slice.contours.push_back(stacks::circle(3, 3 + 0.1 * z, {}, turn));
    for (std::size_t k = random() % 4; k > 0; --k)
      slice.contours.push_back(stacks::circle(5 + random() % 6, 0.3 + 0.4 * share(),
                                              {18 * share() - 9, 18 * share() - 9}, share()));
  }
  return pool;
}

TEST(Reconstruction, RandomEditsOfSlantedPlatesGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    play(slanted_pool(seed, 6), {}, seed, edit_count(80), 1);
}

/// Adds a contour to a slice of six that are the same.
void expect_addition_as_batch(const std::vector<Contour>& contours, Contour added) {
  Reconstruction live;
  for (const double z : {0, 1, 2, 3, 4, 5}) live.insert(Slice{z, contours});
  Slice slice{3, contours};
  slice.contours.push_back(std::move(added));
  live.replace(3, slice);
  EXPECT_EQ(difference(live, {}), "");
  Surface compact = live.snapshot().surface(1);
  EXPECT_EQ(solids::faults(compact), "");
}

TEST(Reconstruction, APartInAHoleIsNotTakenForAHole) {
  expect_addition_as_batch({stacks::circle(4, 10), stacks::circle(96, 6)},
                           stacks::circle(8, 0.5, {1, 1}));
}

TEST(Reconstruction, AHoleBesideASlantedPartIsAHole) {
  Contour fine;
  for (int i = 0; i < 60; ++i) fine.points.push_back({11, 1 + i / 6.0});
  for (int i = 0; i < 60; ++i) fine.points.push_back({11 - i / 6.0, 11});
  for (int i = 0; i < 60; ++i) fine.points.push_back({1 + i / 6.0, 11 - i / 6.0});
  expect_addition_as_batch({{{{0, 0}, {10, 0}, {0, 10}}, ""}, fine},
                           stacks::circle(8, 0.4, {9, 9}));
}

TEST(Reconstruction, OpenEndsWhereContoursTouchAreTakenApart) {
  const auto pair = [](double z, double half) {
    return Slice{z, {stacks::square(half, {-1, -1}), stacks::square(half, {1, 1})}};
  };
  const Options options{.cap = Cap::open};
  for (const bool is_emptied : {false, true}) {
    Reconstruction live(options);
    live.insert(Slice{0, {stacks::square(3)}});
    for (const Slice& slice : {pair(1, 1), pair(2, 0.5), pair(3, 0.5)}) live.insert(slice);
    if (is_emptied) {
      live.replace(0, Slice{0, {}});
    } else {
      live.remove(0);
    }
    EXPECT_EQ(broken(live.surface()), "");
    EXPECT_EQ(difference(live, options), "");
  }
}

TEST(Reconstruction, ARimBesideTwoFacesOfAnotherPartIsTakenApartFromThem) {
  const Options options{.fill = Fill::nonzero, .cap = Cap::open};
  Reconstruction live(options);
  live.insert(Slice{0.16,
                    {{{{0.7, 0.4}, {0.1, 1.2}, {0.3, 0.1}}, ""},
                     {{{0.36274509803921534, 0.14705882352941188}, {0.2, 0.1}, {1.3, 0.9}}, ""},
                     {{{0.3, 0.1}, {0.4, 0.1}, {0.3, 0.2}}, ""}}});
  live.insert(Slice{0.24, {{{{0.2, 0.1}, {0.3, 0.1}, {0.3, 0.2}}, ""}}});
  EXPECT_EQ(broken(live.surface()), "");
  EXPECT_EQ(difference(live, options), "");
  for (const Finding& finding : check(to_mesh(live.snapshot().surface(1))))
    EXPECT_EQ(finding.fault, Fault::boundary_edge);
}

TEST(Reconstruction, RandomEditsOfOpenSurfacesThatTouchGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    play(mask_pool(seed, 5, 0.5), {.cap = Cap::open}, seed, edit_count(60), 1);
    play(random_pool(seed, 5, seed % 2 == 0), {.cap = Cap::open}, seed, edit_count(60), 1);
  }
}

TEST(Reconstruction, RandomEditsOfFairContoursGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    play(random_pool(seed, 5, seed % 2 == 0), {.fair = 0.3}, seed, edit_count(20), 4);
    play(mask_pool(seed, 4, 0.5), {.fair = 0.4, .smooth = true}, seed, edit_count(16), 5);
  }
}

TEST(Reconstruction, RandomEditsOfTurnedMasksGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    std::vector<Slice> pool = mask_pool(seed, 5, 0.4);
    const double angle = 0.3 * static_cast<double>(seed);
    for (Slice& slice : pool)
      for (Contour& contour : slice.contours)
        for (cdt::Point& p : contour.points)
          p = {p.x * std::cos(angle) - p.y * std::sin(angle),
               p.x * std::sin(angle) + p.y * std::cos(angle)};
    play(pool, {}, seed, edit_count(40), 1);
  }
}

TEST(Reconstruction, AContourThatComesWithinRoundingOfAnotherSliceTouchesItAsInTheBatch) {
  const Contour other = stacks::square(2, {9, 0});
  for (const double gap : {0.0, 1e-15, 1e-13, -1e-13, 1e-9}) {
    Reconstruction live;
    for (const double z : {0, 1, 2}) live.insert(Slice{z, {stacks::square(2), other}});
    live.insert(Slice{3, {other}});
    live.replace(3, Slice{3, {other, stacks::square(1, {3 + gap, 0})}});
    EXPECT_EQ(difference(live, {}), "") << gap;
    Surface compact = live.snapshot().surface(1);
    EXPECT_EQ(solids::faults(compact), "") << gap;
  }
}

TEST(Reconstruction, SlabsThatAreSewnAnewAreNamed) {
  const auto pair = [](double z) {
    return Slice{z, {stacks::square(1, {-1, -1}), stacks::square(1, {1, 1})}};
  };
  Reconstruction live;
  for (const double z : {0, 1, 2, 3, 4, 5}) live.insert(pair(z));
  const auto slabs = live.slabs();
  const edits::ChangeWatch watch(live);
  const SurfaceChange change = live.replace(3, Slice{3, {stacks::square(3)}});
  EXPECT_EQ(watch.lie(live, change), "");
  EXPECT_THAT(change.resewn, testing::ElementsAre(slabs[1].id, slabs[4].id));
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
  EXPECT_THAT([&] { live.remove(3); },
              ThrowsMessage<InputError>(HasSubstr("z = 3; the nearest is at z = 1")));
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

  const Slice worse{1, {{{{0, 0}, {NAN, 1}, {2, 3}}, ""}}};  // numbered as it comes
  EXPECT_THAT([&] { live.insert(worse); },
              ThrowsMessage<InputError>(HasSubstr("slice 0 (z = 1) contour 0 point 1")));
  EXPECT_THAT([&] { live.replace(1, worse); },
              ThrowsMessage<InputError>(HasSubstr("slice 0 (z = 1) contour 0 point 1")));
}

TEST(Reconstruction, NoSliceIsAtAHeightThatIsNoNumber) {
  Reconstruction live;
  for (const double z : {0, 1, 2}) live.insert(Slice{z, {stacks::square(1)}});
  const Slice slice{1.5, {stacks::square(2)}};
  EXPECT_EQ(live.find(NAN), nullptr);
  EXPECT_THROW(live.remove(NAN), InputError);
  EXPECT_THROW(live.replace(NAN, slice), InputError);
  EXPECT_THROW(live.replace(1, Slice{NAN, slice.contours}), InputError);
  EXPECT_THROW(live.replace({Slice{NAN, slice.contours}, Slice{1, slice.contours}}), InputError);
  EXPECT_THROW(live.move_contour(NAN, 0, slice.contours[0].points), InputError);
  EXPECT_THROW(live.insert(Slice{NAN, slice.contours}), InputError);
  EXPECT_EQ(live.slice_count(), 3U);
  EXPECT_EQ(difference(live, {}), "");
}

TEST(Reconstruction, ARefusedSliceTakesNoNumber) {
  const Options options{.max_edge = 0.01};
  Reconstruction live(options);
  live.insert(Slice{0, {stacks::square(0.01)}});
  EXPECT_THROW(live.insert(Slice{1, {stacks::square(1e6)}}), InputError);
  live.insert(Slice{0.01, {stacks::square(0.01)}});
  std::uint32_t last = 0;
  for (const auto v : live.surface().vertices())
    last = std::max(last, live.surface().data(v).origin.slice);
  EXPECT_EQ(last, 1U);
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
  live.move_contour(2, 1, stacks::circle(5, 1, {9, 8}).points);
  EXPECT_THAT(kinds(live.repairs()), ElementsAre(DefectKind::merged_slices));
  live.replace(2, more);
  EXPECT_TRUE(live.repairs().empty());
}

TEST(Reconstruction, EmptySliceIsReportedWhereTheShapeIsInterrupted) {
  using testing::ElementsAre;
  Reconstruction live;
  for (const double z : {1, 2}) live.insert(Slice{z, {stacks::circle(5, 1)}});
  EXPECT_TRUE(live.insert(Slice{3, {}}).repairs.empty());  // the shape ends below it
  EXPECT_THAT(kinds(live.insert(Slice{4, {stacks::circle(5, 1)}}).repairs),
              ElementsAre(DefectKind::empty_slice));
  live.insert(Slice{5, {stacks::circle(5, 1)}});
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
