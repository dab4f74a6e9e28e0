// SPDX-License-Identifier: MIT
// Forty agents go each its shortest way among thirty polygons, from side to side: agents agents.svg
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "io/scenes.h"
#include "overlay/overlay.h"
#include "paths/shortest.h"
#include "samples/drawing.h"

namespace {

using loft::overlay::LayerId;
using loft::overlay::Overlay;
using loft::overlay::Point;
using loft::overlay::Ring;
using loft::paths::FreeSpace;
using loft::paths::Path;
using loft::paths::Query;
using loft::paths::Status;
using samples::Dice;

constexpr double width = 160;
constexpr double height = 100;

;

/// Corners on an ellipse, in the order of their angles: convex.
Ring convex_polygon(Dice& dice) {
  const Point centre{dice.between(14, width - 14), dice.between(8, height - 8)};
  const double across = dice.between(5, 11);
  const double deep = dice.between(4, 9);
  const double turn = dice.between(0, std::numbers::pi);
  std::vector<double> angles(static_cast<std::size_t>(dice.between(4, 9)));
  for (double& angle : angles) angle = dice.between(0, 2 * std::numbers::pi);
  std::ranges::sort(angles);
  Ring ring;
  for (const double angle : angles) {
    const double x = across * std::cos(angle);
    const double y = deep * std::sin(angle);
    ring.push_back({centre.x + std::cos(turn) * x - std::sin(turn) * y,
                    centre.y + std::sin(turn) * x + std::cos(turn) * y});
  }
  return ring;
}

/// From left to right and from right to left, in turn.
std::vector<Query> agents(Dice& dice) {
  std::vector<Query> queries;
  for (int i = 0; i < 40; ++i) {
    const Point left{dice.between(1, 4), 2 + 2.4 * i};
    const Point right{width - dice.between(1, 4), dice.between(2, height - 2)};
    queries.push_back(i % 2 == 0 ? Query{.from = left, .to = right}
                                 : Query{.from = right, .to = left});
  }
  return queries;
}

void run(const std::string& out) {
  Dice dice(4);
  Overlay overlay;
  const LayerId frame = overlay.add_layer("frame");
  const LayerId polygons = overlay.add_layer("polygons", loft::overlay::FillRule::nonzero);
  overlay.insert(frame, Ring{{0, 0}, {width, 0}, {width, height}, {0, height}});
  for (int i = 0; i < 30; ++i) overlay.insert(polygons, convex_polygon(dice));
  const auto free = loft::overlay::Expression(frame) - polygons;
  const FreeSpace space(overlay, free);

  loft::io::PathPicture picture{.free = overlay.polygons(overlay.watch(free))};
  loft::paths::Workspace workspace;
  std::chrono::duration<double, std::micro> took{};
  double length = 0;
  std::size_t count = 0;
  for (const Query& query : agents(dice)) {
    Path path;
    const auto start = std::chrono::steady_clock::now();
    workspace.find(space, query, path);
    took += std::chrono::steady_clock::now() - start;
    if (path.status == Status::found) {
      ++count;
      length += path.length;
    }
    picture.paths.push_back({.query = query, .path = path, .hue = picture.paths.size()});
  }
  std::printf("%zu of 40 agents have a way; together %.9f long; %.1f us each\n", count, length,
              took.count() / 40);
  loft::io::write(out, picture, 900);
}

}  // namespace

int main(int argc, char** argv) { return samples::run_sample(argc, argv, "agents.svg", run); }
