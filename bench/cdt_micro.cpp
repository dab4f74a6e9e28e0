// SPDX-License-Identifier: MIT
// What single operations of loft::cdt cost.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::cdt {
namespace {

using Points = std::vector<Point>;
using State = benchmark::State;

/// The number after the name of a benchmark.
std::size_t size_of(const State& state) { return static_cast<std::size_t>(state.range(0)); }

void set_items(State& state, std::size_t each) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(each));
}

/// In the unit square.
Points scattered(std::size_t count, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 1);
  Points points(count);
  for (Point& p : points) {
    p.x = place(random);
    p.y = place(random);
  }
  return points;
}

Points ring(std::size_t count, Point centre, double radius) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return points;
}

std::vector<Polyline> as_polylines(const Points& points) {
  std::vector<Polyline> polylines;
  for (const Point& p : points) polylines.push_back({{&p, 1}, open});
  return polylines;
}

Triangulation of_scattered(std::size_t count) {
  const Points points = scattered(count);
  Triangulation mesh;
  mesh.insert(as_polylines(points));
  return mesh;
}

// --- Predicates ---

void orientation(State& state) {
  const Points points = scattered(1002);
  for (auto _ : state)
    for (std::size_t i = 0; i < 1000; ++i)
      benchmark::DoNotOptimize(orient(points[i], points[i + 1], points[i + 2]));
  set_items(state, 1000);
}
BENCHMARK(orientation);

/// All in one line, so that only exact arithmetic can tell.
void orientation_in_one_line(State& state) {
  Points points;
  for (int i = 0; i < 1002; ++i) points.push_back({0.1 * i, 0.1 * i});
  for (auto _ : state)
    for (std::size_t i = 0; i < 1000; ++i)
      benchmark::DoNotOptimize(orient(points[i], points[i + 1], points[i + 2]));
  set_items(state, 1000);
}
BENCHMARK(orientation_in_one_line);

void in_circle_test(State& state) {
  const Points points = scattered(1003);
  for (auto _ : state)
    for (std::size_t i = 0; i < 1000; ++i)
      benchmark::DoNotOptimize(in_circle(points[i], points[i + 1], points[i + 2], points[i + 3]));
  set_items(state, 1000);
}
BENCHMARK(in_circle_test);

/// Corners of rectangles: always on one circle.
void in_circle_perturbed_tie(State& state) {
  const Points points = scattered(1001);
  for (auto _ : state) {
    for (std::size_t i = 0; i < 1000; ++i) {
      const Point p = points[i];
      const Point q = points[i + 1];
      benchmark::DoNotOptimize(in_circle_perturbed(p, {q.x, p.y}, q, {p.x, q.y}));
    }
  }
  set_items(state, 1000);
}
BENCHMARK(in_circle_perturbed_tie);

// --- Points ---

void insert_points_in_bulk(State& state) {
  const Points points = scattered(size_of(state));
  const std::vector<Polyline> polylines = as_polylines(points);
  for (auto _ : state) {
    Triangulation mesh;
    benchmark::DoNotOptimize(mesh.insert(polylines));
  }
  set_items(state, points.size());
}
BENCHMARK(insert_points_in_bulk)->Arg(1000)->Arg(100'000)->Unit(benchmark::kMillisecond);

void insert_points_online(State& state) {
  const Points points = scattered(size_of(state));
  for (auto _ : state) {
    Triangulation mesh;
    for (const Point p : points) benchmark::DoNotOptimize(mesh.insert(p));
  }
  set_items(state, points.size());
}
BENCHMARK(insert_points_online)->Arg(1000)->Arg(100'000)->Unit(benchmark::kMillisecond);

/// Small steps, each located from where the last one was.
void locate_from_a_hint(State& state) {
  const Triangulation mesh = of_scattered(size_of(state));
  const Points path = ring(10'000, {0.5, 0.5}, 0.3);
  EdgeId hint = mesh.locate(path.front()).edge;
  for (auto _ : state)
    for (const Point p : path) hint = mesh.locate(p, hint).edge;
  benchmark::DoNotOptimize(hint);
  set_items(state, path.size());
}
BENCHMARK(locate_from_a_hint)->Arg(100'000);

void locate_scattered(State& state) {
  const Triangulation mesh = of_scattered(size_of(state));
  const Points goals = scattered(1000, 2);
  for (auto _ : state)
    for (const Point p : goals) benchmark::DoNotOptimize(mesh.locate(p));
  set_items(state, goals.size());
}
BENCHMARK(locate_scattered)->Arg(1000)->Arg(100'000)->Arg(1'000'000);

/// A point that so many triangles meet at comes and goes.
void insert_and_remove_vertex_of_degree(State& state) {
  Triangulation mesh;
  mesh.insert(ring(size_of(state), {0, 0}, 1), closed);
  for (auto _ : state) mesh.remove(mesh.insert({0.01, 0.02}));
  set_items(state, 1);
}
BENCHMARK(insert_and_remove_vertex_of_degree)->DenseRange(3, 12);

// --- Constraints ---

void insert_and_remove_ring(State& state) {
  Triangulation mesh = of_scattered(100'000);
  const Points points = ring(size_of(state), {0.5, 0.5}, 0.01);
  for (auto _ : state) mesh.remove(mesh.insert(points, closed));
  set_items(state, points.size());
}
BENCHMARK(insert_and_remove_ring)->Arg(6)->Arg(60)->Arg(600);

/// To and fro, by a step that is small (1) or large (100) against the triangles.
void translate_ring(State& state) {
  Triangulation mesh = of_scattered(100'000);
  const ConstraintId walker = mesh.insert(ring(60, {0.5, 0.5}, 0.01), closed);
  const double step = 1e-4 * static_cast<double>(state.range(0));
  for (auto _ : state) {
    mesh.translate(walker, {step, 0});
    mesh.translate(walker, {-step, 0});
  }
  set_items(state, 2 * 60);
}
BENCHMARK(translate_ring)->Arg(1)->Arg(100);

/// A segment through the middle of so many scattered points: it crosses about their root of edges.
void insert_and_remove_long_segment(State& state) {
  Triangulation mesh = of_scattered(size_of(state));
  const std::array<Point, 2> ends{Point{-0.1, 0.4971}, Point{1.1, 0.5037}};
  std::size_t pieces = 0;
  for (auto _ : state) {
    const ConstraintId id = mesh.insert(ends, open);
    pieces = mesh.pieces(id).size();
    mesh.remove(id);
  }
  state.counters["pieces"] = static_cast<double>(pieces);
}
BENCHMARK(insert_and_remove_long_segment)->Arg(100)->Arg(10'000)->Arg(1'000'000);

/// A segment across so many constrained ones: a vertex for each.
void insert_and_remove_segment_across(State& state) {
  const std::size_t lines = size_of(state);
  Triangulation mesh;
  for (std::size_t i = 0; i < lines; ++i) {
    const double x = static_cast<double>(i);
    mesh.insert(std::array{Point{x, -1.0 - 0.1 * x}, Point{x + 0.3, 1.0 + 0.07 * x}}, open);
  }
  const std::array<Point, 2> ends{Point{-1, 0.1}, Point{static_cast<double>(lines), -0.2}};
  for (auto _ : state) mesh.remove(mesh.insert(ends, open));
  set_items(state, lines);
}
BENCHMARK(insert_and_remove_segment_across)->RangeMultiplier(10)->Range(1, 1000);

}  // namespace
}  // namespace loft::cdt

BENCHMARK_MAIN();
