// SPDX-License-Identifier: MIT
// Figure 6 of Kallmann, Bieri and Thalmann (2003), above: one constraint is moved over many that
// overlap: moving_shapes moving_shapes.svg
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "samples/drawing.h"

namespace {

using loft::cdt::ConstraintId;
using loft::cdt::Triangulation;
using loft::io::dark_tone;
using loft::io::full_tone;
using samples::Dice;
using samples::Drawing;
using samples::fill;
using samples::Point;
using samples::star;
using samples::stroke;

constexpr int frames = 8;

using Ring = std::vector<Point>;

/// Squares side by side, which share edges, and polygons across them, two of them the same.
std::vector<Ring> shapes_that_overlap(Dice& dice) {
  std::vector<Ring> rings;
  for (const double x : {24.0, 48.0, 72.0})
    rings.push_back({{x, 26}, {x + 24, 26}, {x + 24, 50}, {x, 50}});
  for (int i = 0; i < 12; ++i) {
    const Point centre{18.0 + 7.5 * i + dice.between(-2, 2), i % 2 == 0 ? 54.0 : 22.0};
    const double radius = dice.between(9, 15);
    rings.push_back(star(centre, radius, radius, 4 + i % 5, dice.between(0, 3)));
  }
  rings.push_back(rings.back());
  return rings;
}

void run(const std::string& path) {
  Dice dice(5);
  Triangulation mesh;
  std::vector<ConstraintId> others;
  for (const Ring& ring : shapes_that_overlap(dice))
    others.push_back(mesh.insert(ring, loft::cdt::closed));
  const ConstraintId moved = mesh.insert(star({13, 60}, 10, 5, 12), loft::cdt::closed);

  Drawing drawing(path, "One constraint is moved",
                  {.shown = {{0, 0}, {120, 76}}, .columns = 4, .rows = 2, .width = 1000});
  constexpr int steps = 20;  // from picture to picture
  using Clock = std::chrono::steady_clock;
  std::chrono::duration<double, std::micro> took{};
  for (int frame = 0; frame < frames; ++frame) {
    drawing.turn_to(frame);
    for (std::size_t i = 0; i < others.size(); ++i)
      drawing.area({mesh.points(others[i])}, fill(full_tone(i % 6)) + "fill-opacity=\"0.6\"");
    drawing.area({mesh.points(moved)}, fill(full_tone(6)));
    draw_free_edges(drawing, mesh);
    for (std::size_t i = 0; i < others.size(); ++i)
      draw_constraint(drawing, mesh, others[i], dark_tone(i % 6), 1.3);
    draw_constraint(drawing, mesh, moved, dark_tone(6), 2.2);
    drawing.caption(std::to_string(mesh.vertex_count()) + " vertices");
    const auto start = Clock::now();
    for (int step = 0; step < steps; ++step)
      mesh.translate(moved, {13.5 / steps, (frame % 4 < 2 ? -20.0 : 20.0) / steps});
    took += Clock::now() - start;
  }
  drawing.finish();
  std::printf("a star of 12 corners moves over %zu shapes: %.1f us a step\n", others.size(),
              took.count() / (frames * steps));
}

}  // namespace

int main(int argc, char** argv) {
  return samples::run_sample(argc, argv, "moving_shapes.svg", run);
}
