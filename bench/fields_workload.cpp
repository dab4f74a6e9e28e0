// SPDX-License-Identifier: MIT
// Times loft::fields on samples of a smooth field with a cliff along a wavy line.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "bench/measure.h"
#include "fields/raster.h"

namespace loft::bench {
namespace {

using fields::Field;
using fields::Line;
using fields::LineKind;
using fields::Point;
using fields::Sample;
using fields::SampleId;
using fields::Smoothness;

constexpr const char* usage =
    "usage: fields_workload make SAMPLES DIR    writes terrain_SAMPLES.xyz, queries_100000.xy and\n"
    "                                           terrain_breakline.xyz, for others\n"
    "       fields_workload ask SAMPLES         builds, asks at 100,000 places, errors\n"
    "       fields_workload move SAMPLES        one moves, and is asked, 20,000 times\n"
    "       fields_workload raster SAMPLES      1,000 x 1,000 cells\n";

double smooth(Point p) { return std::sin(3 * p.x) * std::cos(4 * p.y) + .5 * p.x * p.y; }
double cliff(double x) { return .5 + .1 * std::sin(6 * x); }
double truth(Point p) { return smooth(p) + (p.y > cliff(p.x) ? 5 : 0); }

constexpr std::size_t query_count = 100'000;

std::vector<Point> places(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  const auto next = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Point> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = next();
    result.push_back({x, next()});
  }
  return result;
}

std::vector<Sample> samples(std::size_t count) {
  std::vector<Sample> result;
  for (const Point p : places(1, count)) result.push_back({p, truth(p)});
  return result;
}

/// The cliff, from end to end.
struct Wall {
  Wall() {
    for (int i = 0; i <= 400; ++i) {
      const double x = i / 400.0;
      points.push_back({x, cliff(x)});
      right.push_back(smooth(points.back()));
      left.push_back(right.back() + 5);
    }
  }
  [[nodiscard]] Line line() const {
    return {.points = points, .kind = LineKind::wall, .left = left, .right = right};
  }
  std::vector<Point> points;
  std::vector<double> left;
  std::vector<double> right;
};

void make(std::size_t count, const std::string& folder) {
  std::ofstream xyz(folder + "/terrain_" + std::to_string(count) + ".xyz");
  std::ofstream line(folder + "/terrain_breakline.xyz");
  std::ofstream xy(folder + "/queries_" + std::to_string(query_count) + ".xy");
  for (std::ofstream* file : {&xyz, &line, &xy}) file->precision(17);
  for (const Sample& s : samples(count))
    xyz << s.place.x << ' ' << s.place.y << ' ' << s.value << '\n';
  for (const Point p : places(2, query_count)) xy << p.x << ' ' << p.y << '\n';
  const Wall wall;
  for (std::size_t i = 0; i < wall.points.size(); ++i)
    line << wall.points[i].x << ' ' << wall.points[i].y << ' ' << wall.right[i] << '\n';
}

/// Root mean squares of the errors, away from the cliff and near it.
void print_errors(const Field& field, Smoothness smoothness) {
  double sums[2] = {0, 0};
  std::size_t counts[2] = {0, 0};
  for (const Point p : places(2, query_count)) {
    const auto value = field.value(p, smoothness);
    if (!value) continue;
    const bool is_near = std::abs(p.y - cliff(p.x)) < .02;
    sums[is_near] += (*value - truth(p)) * (*value - truth(p));
    ++counts[is_near];
  }
  std::printf(", rms %.2e, near the cliff %.2e\n",
              std::sqrt(sums[0] / static_cast<double>(counts[0])),
              std::sqrt(sums[1] / static_cast<double>(counts[1])));
}

void ask(std::size_t count) {
  const std::vector<Sample> all = samples(count);
  const std::vector<Point> queries = places(2, query_count);
  for (const bool has_wall : {false, true}) {
    double started = thread_seconds();
    Field field;
    (void)field.insert(all);
    if (has_wall) (void)field.insert(Wall().line());
    const double built = thread_seconds() - started;
    for (const Smoothness smoothness : {Smoothness::linear, Smoothness::cubic}) {
      double sum = 0;
      started = thread_seconds();
      for (const Point p : queries) sum += field.value(p, smoothness).value_or(0);
      const double first = thread_seconds() - started;
      started = thread_seconds();
      for (const Point p : queries) sum += field.value(p, smoothness).value_or(0);
      const double again = thread_seconds() - started;
      if (sum != sum) std::printf("nothing");
      std::printf("%s, %s: build %.1f ms, query %.3f us, once more %.3f us",
                  has_wall ? "wall" : "no wall",
                  smoothness == Smoothness::linear ? "linear" : "cubic", built * 1e3,
                  first * 1e6 / query_count, again * 1e6 / query_count);
      print_errors(field, smoothness);
    }
  }
}

void print(const char* what, const Durations& durations) {
  std::printf("%s: median %.1f us, p99 %.1f us\n", what, durations.microseconds(.5),
              durations.microseconds(.99));
}

void move(std::size_t count) {
  Field field;
  const std::vector<SampleId> ids = field.insert(samples(count));
  (void)field.insert(Wall().line());
  std::mt19937_64 random(3);
  Durations moves;
  Durations asks;
  double sum = 0;
  for (const Point by : places(4, 20'000)) {
    const SampleId id = ids[random() % ids.size()];
    const Point p = field.sample(id).place;
    const double spacing = 1 / std::sqrt(static_cast<double>(count));
    moves.add(seconds_of([&] {
      field.move(id, {p.x + (by.x - .5) * spacing, p.y + (by.y - .5) * spacing});
    }));
    asks.add(seconds_of([&] {
      sum += field.value(p, Smoothness::cubic).value_or(0);
      if (const auto gradient = field.gradient(p, Smoothness::cubic)) sum += gradient->x;
    }));
  }
  if (sum != sum) std::printf("nothing");
  print("one sample moves", moves);
  print("value and gradient there, smooth", asks);
}

void raster(std::size_t count) {
  Field field;
  (void)field.insert(samples(count));
  (void)field.insert(Wall().line());
  const fields::Grid grid{
      .first = {5e-4, 5e-4}, .step_x = 1e-3, .step_y = 1e-3, .columns = 1000, .rows = 1000};
  for (const Smoothness smoothness : {Smoothness::linear, Smoothness::cubic})
    for (const char* what : {"", ", once more"}) {
      double sum = 0;
      const double started = thread_seconds();
      fields::rasterize(field, grid, smoothness,
                        [&](std::size_t, std::span<const double> values) { sum += values[500]; });
      if (sum != sum) std::printf("nothing");
      std::printf("raster, %s%s: %.4f us a cell\n",
                  smoothness == Smoothness::linear ? "linear" : "cubic", what,
                  (thread_seconds() - started) * 1e6 / 1e6);
    }
}

void run(const Arguments& arguments) {
  const std::string mode = arguments.word(0);
  const auto count = arguments.number<std::size_t>(1);
  if (mode == "make") return make(count, arguments.word(2));
  if (mode == "ask") return ask(count);
  if (mode == "move") return move(count);
  if (mode == "raster") return raster(count);
  throw std::invalid_argument(usage);
}

}  // namespace
}  // namespace loft::bench

int main(int argc, char** argv) {
  try {
    loft::bench::run({argc, argv, loft::bench::usage});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
