// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruction.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "tests/reconstruct/edit_script.h"
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

TEST(Reconstruction, RandomEditsOfMasksThatTouchGiveWhatTheBatchGives) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    play(mask_pool(seed, 6, 0.5), {}, seed, edit_count(60), 1);
}

}  // namespace
}  // namespace loft
