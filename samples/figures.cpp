// SPDX-License-Identifier: MIT
// Figures 1, 4 and 5 of Kallmann, Bieri and Thalmann (2003): constraints of all kinds and their
// triangulation; one that is removed; a rectangle that passes two triangles and leaves nothing
// behind: figures FOLDER
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "samples/drawing.h"

namespace {

using loft::cdt::closed;
using loft::cdt::ConstraintId;
using loft::cdt::Ends;
using loft::cdt::open;
using loft::cdt::Triangulation;
using loft::io::dark_tone;
using loft::io::full_tone;
using samples::Drawing;
using samples::fill;
using samples::ink_tone;
using samples::Point;
using samples::stroke;

using Polyline = std::vector<Point>;

std::string counts(const Triangulation& mesh) {
  return std::to_string(mesh.vertex_count()) + " vertices, " +
         std::to_string(samples::count_triangles(mesh)) + " triangles";
}

void draw_vertices(Drawing& drawing, const Triangulation& mesh) {
  drawing.dots(samples::vertices(mesh), ink_tone, 4.5);
}

void draw_kinds(const std::string& path) {
  struct Kind {
    Polyline points;
    Ends ends;
    std::size_t hue;
  };
  const std::vector<Kind> kinds{{{{10, 62}}, open, 6},
                                {{{91, 44}}, open, 6},
                                {{{14, 12}, {46, 8}, {50, 40}, {18, 44}}, closed, 7},
                                {{{36, 28}, {70, 22}, {52, 56}}, closed, 1},
                                {{{60, 66}, {90, 10}, {56, 38}, {95, 58}}, closed, 3},
                                {{{6, 30}, {26, 58}, {34, 22}, {58, 8}, {86, 28}}, open, 2}};

  Drawing drawing(path, "Constraints and their triangulation",
                  {.shown = {{2, 2}, {98, 72}}, .columns = 2});
  Triangulation mesh;
  std::vector<ConstraintId> ids;
  std::size_t point_count = 0;
  drawing.turn_to(0);
  for (const auto& [points, ends, hue] : kinds) {
    ids.push_back(mesh.insert(points, ends));
    point_count += points.size();
    if (ends == closed) {
      drawing.area({points},
                   fill(full_tone(hue)) + "fill-opacity=\"0.7\" " + stroke(dark_tone(hue), 2.2));
    } else {
      drawing.line(points, stroke(dark_tone(hue), 2.2));
    }
    drawing.dots(points, dark_tone(hue), 6);
  }
  drawing.caption(std::to_string(ids.size()) + " constraints, " + std::to_string(point_count) +
                  " points");

  drawing.turn_to(1);
  draw_free_edges(drawing, mesh, stroke(loft::io::edge_tone, 0.9));
  for (std::size_t i = 0; i < ids.size(); ++i)
    draw_constraint(drawing, mesh, ids[i], dark_tone(kinds[i].hue), 2.2);
  draw_vertices(drawing, mesh);
  drawing.caption(counts(mesh));
  drawing.finish();
  std::printf("figure 1: %s\n", counts(mesh).c_str());
}

void draw_removal(const std::string& path) {
  const Polyline leaving{{8, 14}, {30, 52}, {52, 18}, {74, 56}, {92, 30}};
  Triangulation mesh;
  const std::array<ConstraintId, 2> staying{
      mesh.insert(Polyline{{6, 40}, {40, 46}, {94, 42}}, open),
      mesh.insert(Polyline{{18, 6}, {84, 12}, {62, 64}, {24, 62}}, closed)};
  const ConstraintId id = mesh.insert(leaving, open);

  Drawing drawing(path, "A constraint is removed", {.shown = {{2, 2}, {98, 70}}, .columns = 2});
  const auto draw = [&](int panel) {
    drawing.turn_to(panel);
    draw_free_edges(drawing, mesh, stroke(loft::io::edge_tone, 0.9));
    if (mesh.is_constraint(id))
      drawing.line(leaving, stroke(dark_tone(6), 2.4) + "stroke-dasharray=\"700 500\"");
    for (const ConstraintId other : staying)
      draw_constraint(drawing, mesh, other, dark_tone(7), 2.6);
    draw_vertices(drawing, mesh);
    drawing.caption(counts(mesh));
    std::printf("figure 4: %s\n", counts(mesh).c_str());
  };
  draw(0);
  mesh.remove(id);
  draw(1);
  drawing.finish();
}

void draw_passing(const std::string& path) {
  Triangulation mesh;
  const std::array<ConstraintId, 2> triangles{
      mesh.insert(Polyline{{16, 26}, {72, 26}, {36, 56}}, closed),
      mesh.insert(Polyline{{40, 26}, {84, 26}, {66, 6}}, closed)};  // both have a piece of an edge
  const std::size_t alone = mesh.vertex_count();
  const ConstraintId rectangle =
      mesh.insert(Polyline{{3, 14}, {11, 14}, {11, 42}, {3, 42}}, closed);

  Drawing drawing(path, "A rectangle passes two triangles",
                  {.shown = {{0, 2}, {100, 60}}, .columns = 2, .rows = 2});
  for (int panel = 0; panel < 4; ++panel) {
    drawing.turn_to(panel);
    draw_free_edges(drawing, mesh, stroke(loft::io::edge_tone, 0.9));
    draw_constraint(drawing, mesh, triangles[0], dark_tone(7), 2.4);
    draw_constraint(drawing, mesh, triangles[1], dark_tone(1), 2.4);
    draw_constraint(drawing, mesh, rectangle, dark_tone(6), 2.4);
    draw_vertices(drawing, mesh);
    const std::size_t crossings = mesh.vertex_count() - alone - 4;
    drawing.caption(std::to_string(mesh.vertex_count()) + " vertices, " +
                    std::to_string(crossings) + " of them crossings");
    std::printf("figure 5: %zu vertices, %zu of them crossings\n", mesh.vertex_count(), crossings);
    for (int step = 0; step < 28; ++step) mesh.translate(rectangle, {1, 0});
  }
  drawing.finish();
}

}  // namespace

int main(int argc, char** argv) {
  return samples::run_sample(argc, argv, ".", [](const std::string& folder) {
    draw_kinds(folder + "/figure_1.svg");
    draw_removal(folder + "/figure_4.svg");
    draw_passing(folder + "/figure_5.svg");
  });
}
