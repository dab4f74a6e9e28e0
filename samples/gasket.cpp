// SPDX-License-Identifier: MIT
// A gasket as a tree of operations: a plate less its bore, bolt holes and slots. Then one hole
// moves until it breaks the rim, and the shape follows: gasket gasket.svg
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "overlay/solid.h"
#include "samples/drawing.h"

namespace {

using loft::overlay::Affine;
using loft::overlay::NodeId;
using loft::overlay::Operation;
using loft::overlay::Point;
using loft::overlay::Ring;
using loft::overlay::Solid;
using samples::Drawing;
using samples::fill;
using samples::stroke;

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

std::vector<Ring> rings_of(const Solid& solid) {
  std::vector<Ring> rings;
  for (const auto& polygon : solid.polygons()) {
    rings.push_back(polygon.outer);
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  }
  return rings;
}

void run(const std::string& path) {
  Solid solid;
  NodeId hole;
  const NodeId outside = plate(solid);
  solid.set_root(solid.combine(Operation::subtract, {outside, cuts(solid, hole)}));
  Drawing drawing(path, "A gasket whose hole moves",
                  {.shown = {{-90, -48}, {96, 48}}, .columns = 2, .rows = 2});
  for (int i = 0; i < 4; ++i) {
    const int place = 52 + 9 * i;
    solid.set_transform(hole, at(place, 0));
    const std::size_t holes = solid.polygons().front().holes.size();
    std::printf("hole at %d: %.6f square mm, %zu holes\n", place, solid.area().to_double(), holes);
    drawing.turn_to(i);
    drawing.area(rings_of(solid),
                 fill(loft::io::full_tone(7)) + stroke(loft::io::dark_tone(7), 1.6));
    Ring moved = disc(8);
    for (Point& p : moved) p.x += place;
    drawing.area({moved}, stroke(loft::io::dark_tone(6), 2));
    drawing.caption(std::to_string(holes) + " holes, " +
                    std::to_string(std::lround(solid.area().to_double())) + " mm\u00b2");
  }
  drawing.finish();
}

}  // namespace

int main(int argc, char** argv) { return samples::run_sample(argc, argv, "gasket.svg", run); }
