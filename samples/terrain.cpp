// SPDX-License-Identifier: MIT
// A valley with a river and a wall, from samples: without lines, with lines, and smooth. Then a
// road moves over it, and its profile with it: terrain FOLDER
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "fields/field.h"
#include "fields/profile.h"
#include "samples/drawing.h"

namespace {

using loft::Colour;
using loft::fields::Field;
using loft::fields::LineKind;
using loft::fields::ProfilePoint;
using loft::fields::Smoothness;
using samples::Dice;
using samples::Drawing;
using samples::Point;
using samples::stroke;

constexpr double width = 160;
constexpr double height = 100;
constexpr double highest = 58;
constexpr double step_at_wall = 14;

// The land as it is; samples know it in places only.

double river_at(double x) { return 44 + 13 * std::sin(x / 26); }
double wall_at(double x) { return 79 + 5 * std::sin(1 + x / 24); }

double land(Point p, bool is_above_wall) {
  const double bed = 22 - 0.1 * p.x;
  const double bank = 24 * (1 - std::exp(-std::abs(p.y - river_at(p.x)) / 20));
  return bed + bank + 2 * std::sin(p.x / 15) * std::sin(p.y / 11) +
         (is_above_wall ? step_at_wall : 0);
}
double land(Point p) { return land(p, p.y > wall_at(p.x)); }

Field with_samples() {
  Field field;
  Dice dice(3);
  constexpr int columns = 13;
  constexpr int rows = 9;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const auto jitter = [&](int k, int last) {
        return k == 0 || k == last ? 0 : dice.between(-0.35, 0.35);
      };
      const Point p{width * (i + jitter(i, columns - 1)) / (columns - 1),
                    height * (j + jitter(j, rows - 1)) / (rows - 1)};
      field.insert({p, land(p)});
    }
  return field;
}

std::vector<Point> course(double (*y_at)(double)) {
  std::vector<Point> points;
  for (double x = 0; x <= width; x += 5) points.push_back({x, y_at(x)});
  return points;
}

/// The river is a crease with the height of its bed, the wall has a height on each side.
void insert_lines(Field& field) {
  std::vector<double> bed;
  for (const Point p : course(river_at)) bed.push_back(land(p));
  field.insert({.points = course(river_at), .kind = LineKind::feature, .values = bed});
  std::vector<double> above;
  std::vector<double> below;
  for (const Point p : course(wall_at)) {
    above.push_back(land(p, true));
    below.push_back(land(p, false));
  }
  field.insert({.points = course(wall_at), .kind = LineKind::wall, .left = above, .right = below});
}

constexpr int bands = 29;  // of two metres

std::vector<Colour> colours() {
  const std::vector<Colour> stops{{0x2f, 0x6b, 0x6e},
                                  {0x6f, 0xa2, 0x7b},
                                  {0xd3, 0xcb, 0x8a},
                                  {0xc9, 0x9a, 0x6b},
                                  {0xf4, 0xec, 0xe4}};
  std::vector<Colour> result;
  for (int i = 0; i < bands; ++i) result.push_back(samples::between(stops, i / (bands - 1.0)));
  return result;
}

template <class Height>
void draw_cells(Drawing& drawing, Height height_at) {
  drawing.cells(colours(), 0.4, [&](Point p) {
    return std::clamp(static_cast<int>(height_at(p) / highest * bands), 0, bands - 1);
  });
}

void draw_field(Drawing& drawing, const Field& field, Smoothness smoothness) {
  draw_cells(drawing, [&](Point p) { return *field.value(p, smoothness); });
}

/// By how much the surface is off from the land, root mean square.
double error_of(const Field& field, Smoothness smoothness) {
  double sum = 0;
  int count = 0;
  for (double x = 0.5; x < width; ++x)
    for (double y = 0.5; y < height; ++y, ++count) {
      const double error = *field.value({x, y}, smoothness) - land({x, y});
      sum += error * error;
    }
  return std::sqrt(sum / count);
}

std::string text_of(double metres) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", metres);
  return text.data();
}

void draw_lines(Drawing& drawing) {
  drawing.line(course(river_at), stroke({0x1f, 0x4e, 0x79}, 2));
  drawing.line(course(wall_at), stroke(samples::ink_tone, 2.6));
}

std::vector<Point> places(const Field& field) {
  std::vector<Point> result;
  for (std::uint32_t id = 0; id < field.id_bound(); ++id)
    if (const loft::fields::SampleId sample(id); field.is_sample(sample))
      result.push_back(field.sample(sample).place);
  return result;
}

/// The land as it is, from samples alone, with its lines, and these bent.
void draw_surfaces(const std::string& path) {
  Drawing drawing(path, "A valley from samples",
                  {.shown = {{0, 0}, {width, height}}, .columns = 2, .rows = 2});
  Field field = with_samples();
  draw_cells(drawing, [](Point p) { return land(p); });
  draw_lines(drawing);
  drawing.dots(places(field), samples::ink_tone, 4);
  drawing.caption("the land, and where it is measured");

  const auto draw = [&](int panel, const std::string& what, Smoothness smoothness) {
    drawing.turn_to(panel);
    draw_field(drawing, field, smoothness);
    if (smoothness == Smoothness::linear) draw_free_edges(drawing, field.mesh());
    const std::string words = what + ": off by " + text_of(error_of(field, smoothness)) + " m";
    drawing.caption(words);
    std::printf("%s\n", words.c_str());
  };
  draw(1, "samples alone", Smoothness::linear);
  insert_lines(field);
  draw(2, "with river and wall", Smoothness::linear);
  draw_lines(drawing);
  draw(3, "the same, cubic", Smoothness::cubic);
  draw_lines(drawing);
  drawing.finish();
}

/// From one end to the other, in so many pieces that a surface that is bent looks so.
std::vector<Point> road_from(double x) {
  constexpr int pieces = 60;
  std::vector<Point> road;
  for (int i = 0; i <= pieces; ++i) road.push_back({x + 32.0 * i / pieces, 3 + 94.0 * i / pieces});
  return road;
}

/// Heights over the way along it, as large as a panel.
std::vector<Point> curve(const std::vector<ProfilePoint>& profile) {
  std::vector<Point> points;
  for (const ProfilePoint& p : profile) {
    const double x = p.distance / profile.back().distance * width;
    points.push_back({x, *p.before / highest * height});
    points.push_back({x, *p.after / highest * height});  // where it crosses the wall, another one
  }
  return points;
}

/// A road is planned, here and there: what goes up and down along it.
void draw_road(const std::string& path) {
  Drawing drawing(path, "A road and its profile",
                  {.shown = {{0, 0}, {width, height}}, .columns = 2});
  Field field = with_samples();
  insert_lines(field);
  draw_field(drawing, field, Smoothness::cubic);
  draw_lines(drawing);
  drawing.caption("a road is moved over the valley");
  drawing.turn_to(1);
  for (double level = 10; level < highest; level += 10) {
    const double y = level / highest * height;
    drawing.line({{0, y}, {width, y}}, stroke({0xdd, 0xdf, 0xe2}, 1));
  }
  drawing.caption("the heights along it; a line every 10 m");
  double x = 14;
  for (const std::size_t hue : {6U, 3U, 7U, 2U}) {
    const std::vector<Point> road = road_from(x);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<ProfilePoint> along = profile(field, road, Smoothness::cubic);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    const auto [up, down] = climb(along);
    std::printf("a road from (%g, 3): %.2f m up, %.2f m down; %.0f us\n", x, up, down,
                took.count());
    const Colour tone = loft::io::dark_tone(hue);
    drawing.turn_to(0);
    drawing.line(road, stroke({0xff, 0xff, 0xff}, 4.5));
    drawing.line(road, stroke(tone, 2.6));
    drawing.turn_to(1);
    drawing.line(curve(along), stroke(tone, 2));
    x += 33;
  }
  drawing.finish();
}

}  // namespace

int main(int argc, char** argv) {
  return samples::run_sample(argc, argv, ".", [](const std::string& folder) {
    draw_surfaces(folder + "/terrain.svg");
    draw_road(folder + "/road.svg");
  });
}
