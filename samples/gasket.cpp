// SPDX-License-Identifier: MIT
// A gasket as a tree of operations: a plate less its bore, bolt holes and slots. Then one hole
// moves until it breaks the rim, and the shape follows: gasket gasket.svg
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "io/maps.h"
#include "overlay/solid.h"

namespace {

using loft::overlay::Affine;
using loft::overlay::NodeId;
using loft::overlay::Operation;
using loft::overlay::Point;
using loft::overlay::Ring;
using loft::overlay::Solid;

Ring disc(double radius, int corners = 96) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

Ring box(double width, double height) {
  const double x = width / 2;
  const double y = height / 2;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

Affine at(double x, double y) { return {.x0 = x, .y0 = y}; }

Affine turned(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {.xx = c, .xy = -s, .yx = s, .yy = c};
}

NodeId place(Solid& solid, Ring ring, const Affine& where) {
  const NodeId shape = solid.shape({std::move(ring)});
  solid.set_transform(shape, where);
  return shape;
}

/// Two discs joined by a box.
NodeId slot(Solid& solid, double length, double width) {
  return solid.combine(Operation::unite, {place(solid, box(length, width), {}),
                                          place(solid, disc(width / 2), at(-length / 2, 0)),
                                          place(solid, disc(width / 2), at(length / 2, 0))});
}

/// The plate: a box with a round end each side, and ears for the bolts.
NodeId plate(Solid& solid) {
  return solid.combine(Operation::unite,
                       {place(solid, box(100, 60), {}), place(solid, disc(30), at(-50, 0)),
                        place(solid, disc(30), at(50, 0)), place(solid, disc(12), at(-40, 28)),
                        place(solid, disc(12), at(40, 28)), place(solid, disc(12), at(-40, -28)),
                        place(solid, disc(12), at(40, -28))});
}

/// What is cut out of it. `moved` is the hole that will move.
NodeId cuts(Solid& solid, NodeId& moved) {
  std::vector<NodeId> all{place(solid, disc(20), {}), moved = place(solid, disc(8), at(52, 0))};
  for (const double x : {-40.0, 40.0})
    for (const double y : {-28.0, 28.0}) all.push_back(place(solid, disc(5), at(x, y)));
  for (const double angle : {-0.9, 0.0, 0.9}) {
    const NodeId one = slot(solid, 8, 5);
    solid.set_transform(one, at(-50, 0) * turned(std::numbers::pi / 2 + angle) * at(0, 18));
    all.push_back(one);
  }
  return solid.combine(Operation::unite, std::move(all));
}

/// A picture of the gasket beside those before.
loft::io::Feature picture(const Solid& solid, int number) {
  const int column = number % 2;
  const int row = number / 2;
  const double x = 190.0 * column;
  const double y = -110.0 * row;
  loft::io::Feature feature{.polygons = solid.polygons(),
                            .properties = "{\"name\":\"" + std::to_string(number) + "\"}"};
  const auto shift = [&](Ring& ring) {
    for (Point& p : ring) p = {p.x + x, p.y + y};
  };
  for (auto& polygon : feature.polygons) {
    shift(polygon.outer);
    std::ranges::for_each(polygon.holes, shift);
  }
  return feature;
}

void run(const std::string& path) {
  Solid solid;
  NodeId hole;
  const NodeId outside = plate(solid);
  solid.set_root(solid.combine(Operation::subtract, {outside, cuts(solid, hole)}));
  loft::io::Map map;
  for (int i = 0; i < 4; ++i) {
    solid.set_transform(hole, at(52 + 9 * i, 0));
    const auto polygons = solid.polygons();
    std::printf("hole at %d: %.6f square mm, %zu holes\n", 52 + 9 * i, solid.area().to_double(),
                polygons.front().holes.size());
    map.features.push_back(picture(solid, i));
  }
  loft::io::write(path, map, {.width = 900});
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : "gasket.svg");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
