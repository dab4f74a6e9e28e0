// SPDX-License-Identifier: MIT
// The shortest ways through a made-up town for a point and for discs of two sizes: a wide one stays
// out of the alleys. town town.svg
#include <chrono>
#include <cmath>
#include <cstdio>
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

constexpr double width = 250;
constexpr double height = 156;
constexpr Point from{5.5, 5.5};
constexpr Point to{244, 150};

;

/// A house around a place, turned; some have a yard cut out of a corner.
Ring house(Point place, double across, double deep, double angle, bool has_yard) {
  const double x = across / 2;
  const double y = deep / 2;
  Ring ring{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  if (has_yard) ring = {{-x, -y}, {x, -y}, {x, 0}, {0.1 * x, 0}, {0.1 * x, y}, {-x, y}};
  for (Point& p : ring)
    p = {place.x + std::cos(angle) * p.x - std::sin(angle) * p.y,
         place.y + std::sin(angle) * p.x + std::cos(angle) * p.y};
  return ring;
}

/// Ten houses a row, six rows, along streets that bend; every third street is a wide one.
std::vector<Ring> houses() {
  constexpr int columns = 10;
  constexpr int rows = 6;
  Dice dice(7);
  std::vector<Ring> rings;
  for (int row = 0; row < rows; ++row) {
    const int streets_below = row / 3;
    for (int column = 0; column < columns; ++column) {
      const int streets_before = column / 3;
      const Point place{19 + 20.5 * column + 9 * streets_before + dice.between(-1.5, 1.5),
                        19 + 20.5 * row + 10 * streets_below + dice.between(-1.5, 1.5)};
      const double angle = 0.3 * std::sin(place.x / 45) + 0.25 * std::cos(place.y / 30);
      const double across = dice.between(12, 16.5);
      const double deep = dice.between(11.5, 16);
      rings.push_back(house(place, across, deep, angle, dice.between(0, 1) < 0.3));
    }
  }
  return rings;
}

const char* words(const Path& path) { return path.status == Status::found ? "long" : "(no way)"; }

void run(const std::string& out) {
  Overlay overlay;
  const LayerId frame = overlay.add_layer("frame");
  const LayerId town = overlay.add_layer("town", loft::overlay::FillRule::nonzero);
  overlay.insert(frame, Ring{{0, 0}, {width, 0}, {width, height}, {0, height}});
  for (const Ring& ring : houses()) overlay.insert(town, ring);
  const auto free = loft::overlay::Expression(frame) - town;
  FreeSpace space(overlay, free);
  space.keep_gaps();

  loft::io::PathPicture picture{.free = overlay.polygons(overlay.watch(free))};
  std::size_t hue = 0;
  for (const double radius : {5.0, 2.0, 0.0}) {
    const Query query{.from = from, .to = to, .radius = radius};
    const auto start = std::chrono::steady_clock::now();
    const Path path = shortest_path(space, query);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    std::printf("radius %g: %.9f %s, %zu pieces; %.0f us\n", radius, path.length, words(path),
                path.pieces.size(), took.count());
    picture.paths.push_back({.query = query, .path = path, .hue = hue});
    hue = hue == 0 ? 2 : 7;  // blue, green, red
  }
  loft::io::write(out, picture, 900);
}

}  // namespace

int main(int argc, char** argv) { return samples::run_sample(argc, argv, "town.svg", run); }
