// SPDX-License-Identifier: MIT
#include "reconstruct/shape/vertex_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace loft {
namespace {

TEST(VertexQueue, GivesTheLeastOfWhatWasPutLastForEachVertex) {
  constexpr unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::uint32_t> vertex(0, 99);
  std::uniform_int_distribution few(0, 9);  // many ranks are the same but for the place
  VertexQueue queue(100);
  std::map<std::uint32_t, VertexQueue::Rank> expected;
  const auto is_before = [](const auto& a, const auto& b) { return a.second < b.second; };
  for (int step = 0; step < 20'000; ++step) {
    const std::uint32_t v = vertex(random);
    const int action = few(random);
    if (action < 6) {
      expected[v] = {0.5 * few(random), 0.1 * few(random), {1.0 * v, 0, 0}};
      queue.put(v, expected[v]);
    } else if (action < 7) {
      expected.erase(v);
      queue.remove(v);
    } else if (!expected.empty()) {
      const auto least = std::ranges::min_element(expected, is_before);
      ASSERT_EQ(queue.pop(), least->first) << step;
      expected.erase(least);
    }
    ASSERT_EQ(queue.is_empty(), expected.empty()) << step;
  }
}

}  // namespace
}  // namespace loft
