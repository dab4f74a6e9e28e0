// SPDX-License-Identifier: MIT
// Times loft::cdt on a workload file, with the modes, arguments and columns of the CGAL harness it
// is compared with (see README.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/arguments.h"
#include "bench/measure.h"
#include "bench/verify.h"
#include "bench/workload.h"
#include "cdt/check.h"
#include "cdt/triangulation.h"

namespace loft::bench {
namespace {

using cdt::ConstraintId;
using cdt::Point;
using cdt::Triangulation;

constexpr const char* usage =
    "usage: cdt_workload build FILE [REPS]                  polyline by polyline\n"
    "       cdt_workload batch FILE [REPS]                  all at once\n"
    "       cdt_workload check FILE                         build, then verify\n"
    "       cdt_workload move FILE ID STEPS DX DY [CLEANUP] remove and insert displaced\n"
    "       cdt_workload step FILE ID STEPS DX DY           translate against remove and insert\n"
    "       cdt_workload all FILE [CLEANUP]                 remove and reinsert each, shuffled\n"
    "       cdt_workload poly6 FILE STEPS [CLEANUP]         hexagons come and go\n"
    "CLEANUP is ignored: removal always leaves what would be there without the constraint.\n";

ConstraintId insert(Triangulation& mesh, const Outline& outline) {
  return mesh.insert(outline.points, outline.ends);
}

std::vector<ConstraintId> build_online(Triangulation& mesh, const Workload& workload) {
  std::vector<ConstraintId> ids;
  ids.reserve(workload.size());
  for (const Outline& outline : workload) ids.push_back(insert(mesh, outline));
  return ids;
}

std::vector<ConstraintId> build_batch(Triangulation& mesh, const Workload& workload) {
  return mesh.insert(views(workload));
}

std::size_t finite_triangle_count(const Triangulation& mesh) {
  std::size_t infinite = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_bound(); ++t)
    if (mesh.is_triangle(cdt::TriangleId(t)) && mesh.is_infinite(cdt::TriangleId(t))) ++infinite;
  return mesh.triangle_count() - infinite;
}

/// Verifies, and compares with a mesh of the same constraints that has never seen an edit.
void print_verdict(const Triangulation& mesh, const Workload& workload) {
  const PlainMesh edited = plain(mesh);
  verify(edited, workload).print();
  Triangulation fresh;
  build_online(fresh, workload);
  const Sameness same = compare(edited, plain(fresh));
  std::printf("fresh same_vertices=%d same_triangles=%d same_constrained=%d snaps=%zu of %zu\n",
              same.vertices, same.triangles, same.constrained, mesh.snaps().size(),
              fresh.snaps().size());
}

template <class Build>
void time_builds(const Arguments& arguments, Build build) {
  const Workload workload = read_workload(arguments.word(1));
  const long loaded = memory_kilobytes("VmRSS:");
  const int repetitions = arguments.number_or(2, 5);
  Durations durations;
  long peak = 0;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  for (int i = 0; i < repetitions; ++i) {
    Triangulation mesh;
    durations.add(seconds_of([&] { build(mesh, workload); }));
    if (i == 0) peak = memory_kilobytes("VmHWM:");
    vertices = mesh.vertex_count();
    triangles = finite_triangle_count(mesh);
  }
  const double median = durations.quantile(0.5);
  std::printf("%s %s: in=%zu nv=%zu nt=%zu median=%.1f ms min=%.1f us/v=%.3f mem=%.1f MB\n",
              arguments.word(0).c_str(), arguments.word(1).c_str(), point_count(workload), vertices,
              triangles, 1e3 * median, 1e3 * durations.quantile(0),
              1e6 * median / static_cast<double>(std::max<std::size_t>(vertices, 1)),
              static_cast<double>(peak - loaded) / 1024);
}

void check_build(const Arguments& arguments) {
  const Workload workload = read_workload(arguments.word(1));
  Triangulation mesh;
  build_online(mesh, workload);
  verify(plain(mesh), workload).print();
  std::printf("loft findings=%zu snaps=%zu\n", check(mesh).size(), mesh.snaps().size());
}

void time_moves(const Arguments& arguments) {
  const Workload workload = read_workload(arguments.word(1));
  const auto chosen = arguments.number<std::size_t>(2);
  const auto steps = arguments.number<int>(3);
  const Point by{arguments.number<double>(4), arguments.number<double>(5)};
  const Outline& outline = workload.at(chosen);
  Triangulation mesh;
  ConstraintId id = build_online(mesh, workload)[chosen];
  const std::size_t vertices = mesh.vertex_count();
  Durations removals;
  Durations insertions;
  for (int step = 1; step <= steps; ++step) {
    const int times = step < steps ? step : 0;  // home at the end
    const Outline moved = displaced(outline, {times * by.x, times * by.y});
    removals.add(seconds_of([&] { mesh.remove(id); }));
    insertions.add(seconds_of([&] { id = insert(mesh, moved); }));
  }
  std::printf(
      "move %s id=%zu (%zu v) cleanup=%d: remove med=%.1f us p99=%.1f  insert med=%.1f us "
      "p99=%.1f  nv %zu->%zu simplified=0\n",
      arguments.word(1).c_str(), chosen, outline.points.size(), arguments.number_or(6, 2),
      removals.microseconds(0.5), removals.microseconds(0.99), insertions.microseconds(0.5),
      insertions.microseconds(0.99), vertices, mesh.vertex_count());
  print_verdict(mesh, workload);
}

void time_translations(const Arguments& arguments) {
  const Workload workload = read_workload(arguments.word(1));
  const auto chosen = arguments.number<std::size_t>(2);
  const auto steps = arguments.number<int>(3);
  const Point by{arguments.number<double>(4), arguments.number<double>(5)};
  Outline outline = workload.at(chosen);
  Triangulation one;
  const ConstraintId in_one = build_online(one, workload)[chosen];
  Triangulation other = one;
  ConstraintId in_other = in_one;
  Durations translations;
  Durations replacements;
  for (int step = 0; step < steps; ++step) {
    translations.add(seconds_of([&] { one.translate(in_one, by); }));
    outline = displaced(outline, by);
    replacements.add(seconds_of([&] {
      other.remove(in_other);
      in_other = insert(other, outline);
    }));
  }
  const Sameness same = compare(plain(one), plain(other));
  const double translation = translations.microseconds(0.5);
  const double replacement = replacements.microseconds(0.5);
  std::printf(
      "step %s id=%zu (%zu v): translate med=%.1f us p99=%.1f  remove+insert med=%.1f us "
      "p99=%.1f  ratio=%.3f same_triangles=%d same_constrained=%d snaps=%zu\n",
      arguments.word(1).c_str(), chosen, outline.points.size(), translation,
      translations.microseconds(0.99), replacement, replacements.microseconds(0.99),
      translation / replacement, same.triangles, same.constrained, one.snaps().size());
}

void time_all(const Arguments& arguments) {
  const Workload workload = read_workload(arguments.word(1));
  Triangulation mesh;
  std::vector<ConstraintId> ids = build_online(mesh, workload);
  const std::size_t vertices = mesh.vertex_count();
  std::vector<int> order(workload.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(42));
  double removing = 0;
  double inserting = 0;
  for (const int i : order) {
    const auto chosen = static_cast<std::size_t>(i);
    removing += seconds_of([&] { mesh.remove(ids[chosen]); });
    inserting += seconds_of([&] { ids[chosen] = insert(mesh, workload[chosen]); });
  }
  const auto points = static_cast<double>(point_count(workload));
  std::printf(
      "all %s cleanup=%d: remove %.1f ms (%.2f us/v) insert %.1f ms (%.2f us/v) nv %zu->%zu "
      "simplified=0\n",
      arguments.word(1).c_str(), arguments.number_or(2, 2), 1e3 * removing, 1e6 * removing / points,
      1e3 * inserting, 1e6 * inserting / points, vertices, mesh.vertex_count());
  print_verdict(mesh, workload);
}

Outline hexagon(Point centre, double radius, double turn) {
  Outline outline;
  outline.ends = cdt::closed;
  for (int corner = 0; corner < 6; ++corner) {
    const double angle = corner * std::numbers::pi / 3 + turn;
    outline.points.push_back(
        {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return outline;
}

void time_hexagons(const Arguments& arguments) {
  const Workload workload = read_workload(arguments.word(1));
  const auto steps = arguments.number<int>(2);
  Triangulation mesh;
  build_batch(mesh, workload);
  const std::size_t vertices = mesh.vertex_count();
  const double radius = 3 / std::sqrt(static_cast<double>(vertices));
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(0.05, 0.95);
  Durations insertions;
  Durations removals;
  for (int step = 0; step < steps; ++step) {
    const double x = place(random);
    const Outline outline = hexagon({x, place(random)}, radius, step);
    ConstraintId id;
    insertions.add(seconds_of([&] { id = insert(mesh, outline); }));
    removals.add(seconds_of([&] { mesh.remove(id); }));
  }
  std::printf(
      "poly6 %s nv=%zu cleanup=%d: insert med=%.1f us p99=%.1f remove med=%.1f us p99=%.1f nv "
      "after=%zu\n",
      arguments.word(1).c_str(), vertices, arguments.number_or(3, 2), insertions.microseconds(0.5),
      insertions.microseconds(0.99), removals.microseconds(0.5), removals.microseconds(0.99),
      mesh.vertex_count());
}

void run(const Arguments& arguments) {
  const std::string mode = arguments.word(0);
  if (mode == "build") return time_builds(arguments, build_online);
  if (mode == "batch") return time_builds(arguments, build_batch);
  if (mode == "check") return check_build(arguments);
  if (mode == "move") return time_moves(arguments);
  if (mode == "step") return time_translations(arguments);
  if (mode == "all") return time_all(arguments);
  if (mode == "poly6") return time_hexagons(arguments);
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
