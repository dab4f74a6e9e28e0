// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <vector>

#include "paths/clearance.h"
#include "paths/shortest.h"
#include "paths/visible.h"
#include "tests/overlay/boxes.h"

namespace loft::paths {
namespace {

/// What some queries of all kinds come to.
struct Answers {
  std::vector<Path> paths;
  std::vector<double> widths;
  std::vector<bool> sights;

  friend bool operator==(const Answers&, const Answers&) = default;
};

[[nodiscard]] Answers ask(const FreeSpace& space, unsigned seed) {
  std::mt19937 random(seed);
  const auto place = [&] {
    std::uniform_real_distribution<> coordinate(0, 100);
    const double x = coordinate(random);
    return Point{x, coordinate(random)};
  };
  Answers answers;
  Workspace workspace;
  for (int i = 0; i < 60; ++i) {
    const Point from = place();
    const Point to = place();
    for (const double radius : {0.0, 1.0}) {
      Path path;
      workspace.find(space, {from, to, radius}, path);
      answers.paths.push_back(path);
    }
    answers.widths.push_back(widest(space, from, to));
    answers.sights.push_back(sees(space, from, to));
  }
  return answers;
}

TEST(FreeSpace, AnswersSeveralThreadsAtOnce) {
  overlay::Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId boxes = overlay.add_layer("boxes", overlay::FillRule::nonzero);
  overlay.insert(room, overlay::box(0, 0, 100, 100));
  std::mt19937 random(4);
  std::uniform_real_distribution<> coordinate(0, 96);
  for (int i = 0; i < 40; ++i) {
    const double x = coordinate(random);
    const double y = coordinate(random);
    overlay.insert(boxes, overlay::box(x, y, x + 3, y + 4));
  }
  FreeSpace space(overlay, overlay::Expression(room) - boxes);
  space.keep_gaps();
  constexpr unsigned threads = 4;
  std::vector<Answers> answers(threads);
  {
    std::vector<std::jthread> askers;
    for (unsigned i = 0; i < threads; ++i)
      askers.emplace_back([&, i] { answers[i] = ask(space, i); });
  }
  for (unsigned i = 0; i < threads; ++i) EXPECT_EQ(answers[i], ask(space, i));
}

}  // namespace
}  // namespace loft::paths
