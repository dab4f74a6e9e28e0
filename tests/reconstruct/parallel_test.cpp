// SPDX-License-Identifier: MIT
#include "reconstruct/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

TEST(Parallel, CallsEveryIndexOnceAndWorkersOneAtATime) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    constexpr std::size_t count = 1000;
    std::vector<int> calls(count);
    std::vector<std::atomic<int>> busy(threads);
    std::atomic<bool> is_shared = false;
    for_each_index(count, threads, [&](std::size_t i, unsigned worker) {
      if (++busy.at(worker) != 1) is_shared = true;
      ++calls[i];
      --busy.at(worker);
    });
    EXPECT_EQ(calls, std::vector<int>(count, 1));
    EXPECT_FALSE(is_shared);
  }
}

TEST(Parallel, ThrowsTheFirstFailureWhateverTheThreads) {
  for (const unsigned threads : {1U, 2U, 7U}) {
    std::atomic<std::size_t> calls = 0;
    try {
      for_each_index(100'000, threads, [&](std::size_t i, unsigned) {
        ++calls;
        if (i % 10 == 3) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_LT(calls, 100'000U);
  }
}

TEST(Parallel, DoesNothingForNothing) {
  for_each_index(0, 4, [](std::size_t, unsigned) { FAIL(); });
  EXPECT_GE(thread_count(0), 1U);
  EXPECT_EQ(thread_count(3), 3U);
}

/// All that there is to know of a surface, in the order of its elements.
struct Description {
  Mesh mesh;
  std::vector<Origin> origins;
  std::vector<std::pair<FaceKind, std::uint32_t>> faces;
  std::vector<std::pair<int, int>> half_edges;
  std::vector<std::string> repairs;

  friend bool operator==(const Description&, const Description&) = default;
};

Description description(const std::vector<Slice>& slices, const Options& options) {
  const auto [surface, repairs, slabs, volume] = reconstruct(slices, options);
  Description result{to_mesh(surface), {}, {}, {}, {}};
  for (const auto v : surface.vertices()) result.origins.push_back(surface.data(v).origin);
  for (const auto f : surface.faces())
    result.faces.emplace_back(surface.data(f).kind, surface.data(f).slab);
  for (const auto h : surface.halfedges())
    result.half_edges.emplace_back(surface.to_vertex_handle(h).idx(),
                                   surface.next_halfedge_handle(h).idx());
  for (const Defect& repair : repairs) result.repairs.push_back(describe(repair));
  return result;
}

TEST(Parallel, SurfacesAreTheSameWithAnyNumberOfThreads) {
  std::mt19937_64 random(7);
  std::vector<std::vector<Slice>> stacks{stacks::Torus::slices(30, 40), {}, {}};
  for (int i = 0; i < 90; ++i) stacks[1].push_back(stacks::random_slice(i, random, true));
  for (int i = 0; i < 8; ++i) stacks[2].push_back(stacks::random_mask(i, random, 12, 0.5));
  for (const auto& slices : stacks) {
    for (const Cap cap : {Cap::flat, Cap::dome, Cap::open}) {
      const Description one = description(slices, {.cap = cap, .threads = 1});
      for (const unsigned threads : {2U, 4U})
        EXPECT_TRUE(description(slices, {.cap = cap, .threads = threads}) == one);
    }
  }
}

TEST(Parallel, CancelsWhateverTheThreads) {
  const auto slices = stacks::sphere(40, 50);
  for (const unsigned threads : {1U, 2U, 4U}) {
    for (const Stage last : {Stage::clean, Stage::tile, Stage::sew}) {
      EXPECT_THROW((void)reconstruct(slices, {.threads = threads},
                                     [&](Stage stage, double fraction) {
                                       return stage != last || fraction < 0.5;
                                     }),
                   Cancelled);
    }
  }
}

}  // namespace
}  // namespace loft
