// SPDX-License-Identifier: MIT
// Figures 7b and 7c of Kallmann, Bieri and Thalmann (2003): contours of a skull in one
// triangulation, and one slice of it: skull_slices samples/data/skull.ndjson skull_slices.svg
#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "io/stack.h"
#include "samples/drawing.h"

namespace {

using loft::Colour;
using loft::cdt::ConstraintId;
using loft::cdt::Triangulation;
using samples::Drawing;
using samples::fill;
using samples::stroke;

std::vector<ConstraintId> insert(Triangulation& mesh, const loft::Slice& slice) {
  std::vector<ConstraintId> ids;
  for (const loft::Contour& contour : slice.contours)
    ids.push_back(mesh.insert(contour.points, loft::cdt::closed));
  return ids;
}

loft::cdt::Box box_around(const std::vector<loft::Slice>& slices, double margin) {
  loft::cdt::Box box;
  for (const loft::Slice& slice : slices)
    for (const loft::Contour& contour : slice.contours)
      for (const auto& p : contour.points) box.add(p);
  return {{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}};
}

std::string counts(const std::string& what, const Triangulation& mesh) {
  return what + std::to_string(mesh.constraint_count()) + " contours, " +
         std::to_string(mesh.vertex_count()) + " vertices";
}

/// Every sixth slice: blue at the bottom, orange at the top.
void draw_all(Drawing& drawing, const std::vector<loft::Slice>& slices) {
  constexpr std::size_t stride = 6;
  Triangulation mesh;
  std::vector<std::vector<ConstraintId>> by_slice;
  for (std::size_t i = 0; i < slices.size(); i += stride)
    by_slice.push_back(insert(mesh, slices[i]));
  draw_free_edges(drawing, mesh, stroke(loft::io::edge_tone, 0.5) + "stroke-opacity=\"0.35\"");
  const std::vector<Colour> upwards{loft::io::dark_tone(7), loft::io::dark_tone(3),
                                    loft::io::dark_tone(2)};
  for (std::size_t i = 0; i < by_slice.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(by_slice.size() - 1);
    for (const ConstraintId id : by_slice[i])
      draw_constraint(drawing, mesh, id, samples::between(upwards, part), 1.3);
  }
  const std::string words = counts(std::to_string(by_slice.size()) + " slices: ", mesh);
  drawing.caption(words);
  std::printf("%s\n", words.c_str());
}

/// What is inside an odd number of contours is bone.
void draw_slice(Drawing& drawing, const loft::Slice& slice) {
  Triangulation mesh;
  const std::vector<ConstraintId> ids = insert(mesh, slice);
  std::vector<std::vector<loft::cdt::Point>> contours;
  for (const ConstraintId id : ids) contours.push_back(mesh.points(id));
  drawing.area(contours, fill(loft::io::full_tone(0)));
  draw_free_edges(drawing, mesh, stroke(loft::io::edge_tone, 0.5) + "stroke-opacity=\"0.55\"");
  for (const ConstraintId id : ids) draw_constraint(drawing, mesh, id, loft::io::dark_tone(0), 1.5);
  const std::string words = counts("one slice: ", mesh);
  drawing.caption(words);
  std::printf("%s\n", words.c_str());
}

void run(const std::string& in, const std::string& out) {
  const std::vector<loft::Slice> slices = loft::io::read_stack(in).slices;
  Drawing drawing(out, "A skull", {.shown = box_around(slices, 4), .columns = 2, .width = 720});
  drawing.turn_to(0);
  draw_all(drawing, slices);
  drawing.turn_to(1);
  draw_slice(drawing, slices[slices.size() * 2 / 5]);
  drawing.finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: skull_slices skull.ndjson skull_slices.svg\n");
    return 2;
  }
  try {
    run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
