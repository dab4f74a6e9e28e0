// SPDX-License-Identifier: MIT
// People by age and education, and two criteria that classify them: lines that are moved. Shades go
// by the sum of both coordinates, colours by who fulfils what; who changes class is marked:
// classes classes.svg
#include "fields/classes.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "fields/field.h"
#include "samples/drawing.h"

namespace {

using loft::Colour;
using loft::fields::Classes;
using loft::fields::Field;
using loft::fields::PointId;
using loft::fields::SeparatorId;
using loft::fields::Sign;
using samples::Dice;
using samples::Drawing;
using samples::Point;
using samples::stroke;

constexpr int people_count = 400;
constexpr int shades = 10;
constexpr loft::cdt::Box shown{{18, 0}, {82, 40}};

std::vector<Point> people() {
  Dice dice(11);
  std::vector<Point> points{shown.low, {shown.high.x, 0}, shown.high, {18, shown.high.y}};
  while (points.size() < people_count) {
    const double age = dice.between(18, 82);
    const double level = 0.28 * (82 - age) + dice.between(0, 11) + dice.between(0, 13);
    if (level < shown.high.y) points.push_back({age, level});
  }
  return points;
}

/// Nobody, the first, the second, both are fulfilled.
std::size_t class_of(std::span<const Sign> signs) {
  std::size_t result = 0;
  for (std::size_t i = 0; i < signs.size(); ++i)
    if (signs[i] == Sign::left) result += std::size_t{1} << i;
  return result;
}

constexpr std::array<std::size_t, 4> hues{5, 1, 7, 3};

/// For each class its shades, from pale to full.
std::vector<Colour> colours() {
  std::vector<Colour> result;
  for (const std::size_t hue : hues)
    for (int i = 0; i < shades; ++i)
      result.push_back(samples::between(
          {{0xfd, 0xfd, 0xfb},
           loft::io::full_tone(hue),
           samples::between({loft::io::full_tone(hue), loft::io::dark_tone(hue)}, 0.5)},
          i / (shades - 1.0)));
  return result;
}

/// The sum of both coordinates, from 0 to 1, interpolated over the triangulation.
Field sums(const std::vector<Point>& points) {
  Field field;
  std::vector<loft::fields::Sample> all;
  for (const Point p : points)
    all.push_back({p, (p.x - shown.low.x + p.y) / (shown.high.x - shown.low.x + shown.high.y)});
  field.insert(all);
  return field;
}

void draw(Drawing& drawing, const Classes& classes, const Field& field) {
  drawing.cells(colours(), 0.16, [&](Point p) {
    const auto value = field.value(p);
    if (!value) return -1;
    const int shade = std::clamp(static_cast<int>(*value * shades), 0, shades - 1);
    return static_cast<int>(class_of(classes.signs(p))) * shades + shade;
  });
  draw_free_edges(drawing, field.mesh(),
                  stroke(loft::io::edge_tone, 0.5) + "stroke-opacity=\"0.3\"");
  for (std::uint32_t i = 0; i < classes.point_bound(); ++i)
    drawing.dots({classes.point(PointId(i))},
                 loft::io::dark_tone(hues[class_of(classes.signs(PointId(i)))]), 4);
  for (const SeparatorId id : classes.separators()) {
    const auto points = classes.separator(id).points();
    drawing.line({points.begin(), points.end()}, stroke(samples::ink_tone, 2.2));
  }
}

void mark_changed(Drawing& drawing, const Classes& classes) {
  for (const PointId id : classes.changed()) {
    drawing.dots({classes.point(id)}, {0x20, 0x20, 0x20}, 9);
    drawing.dots({classes.point(id)}, {0xff, 0xff, 0xff}, 6.5);
    drawing.dots({classes.point(id)}, loft::io::dark_tone(hues[class_of(classes.signs(id))]), 4);
  }
}

void run(const std::string& out) {
  const std::vector<Point> points = people();
  const Field field = sums(points);
  Classes classes;
  classes.insert(points);
  Drawing drawing(out, "People by age and education", {.shown = shown, .columns = 2, .rows = 2});
  drawing.turn_to(0);
  draw(drawing, classes, field);
  drawing.caption("people by age and education");

  // What is left of a line fulfils it: above the first, which goes to the right, and on the right
  // of the second, which goes down.
  const std::vector<Point> qualified{{18, 15}, {40, 17}, {60, 22}, {82, 24}};
  const std::vector<Point> interested{{52, 40}, {46, 24}, {40, 12}, {38, 0}};
  const SeparatorId first = classes.insert_separator(qualified);
  const SeparatorId second = classes.insert_separator(interested);
  drawing.turn_to(1);
  draw(drawing, classes, field);
  drawing.caption("two criteria make four classes");

  const auto move = [&](int panel, SeparatorId id, Point by, const std::string& what) {
    const auto start = std::chrono::steady_clock::now();
    classes.translate(id, by);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    drawing.turn_to(panel);
    draw(drawing, classes, field);
    mark_changed(drawing, classes);
    const std::string words = what + ": " + std::to_string(classes.changed().size()) + " of " +
                              std::to_string(classes.point_count()) + " change class";
    drawing.caption(words);
    std::printf("%s; %.0f us\n", words.c_str(), took.count());
  };
  move(2, first, {0, -3.5}, "one criterion moves");
  move(3, second, {7, 0}, "then the other");
  drawing.finish();
}

}  // namespace

int main(int argc, char** argv) { return samples::run_sample(argc, argv, "classes.svg", run); }
