// SPDX-License-Identifier: MIT
// Times loft::overlay on workload files: whole operations, rings out and areas included, and edits.
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "bench/measure.h"
#include "bench/workload.h"
#include "overlay/coverage.h"
#include "overlay/cut.h"
#include "overlay/overlay.h"

namespace loft::bench {
namespace {

using overlay::Expression;
using overlay::LayerId;
using overlay::Overlay;
using overlay::ResultId;
using overlay::RingId;
using overlay::Shape;

constexpr const char* usage =
    "usage: overlay_workload union FILE [REPS]            of all rings, nonzero\n"
    "       overlay_workload and A B [REPS]               one operation of two layers\n"
    "       overlay_workload four A B [REPS]              or, and, minus, xor from one overlay\n"
    "       overlay_workload move FILE RING STEPS DX DY   one ring to and fro, the union follows\n"
    "       overlay_workload any FILE STEPS DX DY         each ring in turn by one step\n"
    "       overlay_workload map RINGS NAMES [REPS]       owners, overlaps, gaps, borders once "
    "each\n"
    "       overlay_workload drag RINGS NAMES RING STEPS DX DY   one ring to and fro; what two "
    "claim\n"
    "       overlay_workload points RINGS NAMES POINTS    who covers each\n"
    "       overlay_workload lines RINGS NAMES LINES      in pieces with owners, in and out "
    "again\n";

void add_shapes(std::vector<Shape>& shapes, LayerId layer, const Workload& workload) {
  for (const Outline& outline : workload) shapes.push_back({layer, outline.points, outline.ends});
}

/// Rings in layers of their own kind, inserted at once.
std::vector<RingId> fill(Overlay& overlay, std::span<const Workload> layers) {
  std::vector<Shape> shapes;
  for (const Workload& workload : layers)
    add_shapes(shapes,
               overlay.add_layer(std::to_string(overlay.layer_count()), overlay::FillRule::nonzero),
               workload);
  return overlay.insert(shapes);
}

struct Counts {
  std::size_t rings = 0;
  std::size_t points = 0;
};

Counts counts_of(const overlay::MultiPolygon& polygons) {
  Counts counts;
  for (const overlay::Polygon& polygon : polygons) {
    counts.rings += 1 + polygon.holes.size();
    counts.points += polygon.outer.size();
    for (const overlay::Ring& hole : polygon.holes) counts.points += hole.size();
  }
  return counts;
}

/// Builds from nothing, with all results, again and again.
void time_results(std::span<const Workload> layers, std::span<const Expression> results,
                  int repetitions) {
  Durations durations;
  Counts counts;
  double area = 0;
  for (int i = 0; i < repetitions; ++i)
    durations.add(seconds_of([&] {
      Overlay overlay;
      fill(overlay, layers);
      for (const Expression& what : results) {
        const ResultId result = overlay.watch(what);
        counts = counts_of(overlay.polygons(result));
        area = overlay.area(result).to_double();
      }
    }));
  std::printf("median=%.3f ms area=%.17g rings=%zu points=%zu\n", 1e3 * durations.quantile(0.5),
              area, counts.rings, counts.points);
}

void time_union(const Arguments& arguments) {
  const std::vector<Workload> layers{read_workload(arguments.word(1))};
  const std::vector<Expression> results{LayerId(0)};
  time_results(layers, results, arguments.number_or(2, 5));
}

void time_two(const Arguments& arguments, std::span<const Expression> results) {
  const std::vector<Workload> layers{read_workload(arguments.word(1)),
                                     read_workload(arguments.word(2))};
  time_results(layers, results, arguments.number_or(3, 3));
}

/// Times edits: translate(step) moves a ring.
template <class Translate>
void time_edits(Overlay& overlay, ResultId result, int steps, Translate translate) {
  Durations edits;
  Durations with_rings;
  std::size_t come = 0;
  for (int step = 0; step < steps; ++step) {
    const double edit = seconds_of([&] { translate(step); });
    const double rings = seconds_of([&] { (void)overlay.changed_rings(result); });
    edits.add(edit);
    with_rings.add(edit + rings);
    come += overlay.change(result).come.size();
  }
  std::printf(
      "edit median=%.1f p99=%.1f us, with changed rings median=%.1f p99=%.1f us, pieces=%.1f\n",
      edits.microseconds(0.5), edits.microseconds(0.99), with_rings.microseconds(0.5),
      with_rings.microseconds(0.99), static_cast<double>(come) / steps);
}

void time_moves(const Arguments& arguments, bool is_any) {
  const std::vector<Workload> layers{read_workload(arguments.word(1))};
  Overlay overlay;
  const std::vector<RingId> rings = fill(overlay, layers);
  const ResultId result = overlay.watch(LayerId(0));
  const std::size_t first = is_any ? 2 : 3;
  const auto steps = arguments.number<int>(first);
  const cdt::Point by{arguments.number<double>(first + 1), arguments.number<double>(first + 2)};
  time_edits(overlay, result, steps, [&](int step) {
    if (is_any) {
      overlay.translate(rings[static_cast<std::size_t>(step) * 7919 % rings.size()], by);
    } else {
      const double sign = step % 100 < 50 ? 1 : -1;
      overlay.translate(rings.at(arguments.number<std::size_t>(2)), {sign * by.x, sign * by.y});
    }
  });
}

/// A map: rings, and for each the name of what it belongs to.
struct Map {
  Workload rings;
  std::vector<std::string> names;

  explicit Map(const Arguments& arguments) : rings(read_workload(arguments.word(1))) {
    std::ifstream file(arguments.word(2));
    for (std::string name; std::getline(file, name);) names.push_back(name);
    if (names.size() != rings.size()) throw std::runtime_error("not a name a ring");
  }

  std::vector<RingId> insert_into(Overlay& overlay) const {
    std::map<std::string, LayerId> layers;
    std::vector<Shape> shapes;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const auto [at, is_new] = layers.try_emplace(names[i]);
      if (is_new) at->second = overlay.add_layer(names[i]);
      shapes.push_back({at->second, rings[i].points, rings[i].ends});
    }
    return overlay.insert(shapes);
  }
};

/// The ring is a layer of its own. Its moves, and what more than one layer claims then, with its
/// area.
void time_drags(const Arguments& arguments) {
  Map map(arguments);
  const auto which = arguments.number<std::size_t>(3);
  map.names.at(which) += " (dragged)";
  Overlay overlay;
  const RingId ring = map.insert_into(overlay)[which];
  std::vector<Expression> all;
  for (std::uint32_t l = 0; l < overlay.layer_count(); ++l) all.emplace_back(LayerId(l));
  const ResultId twice = overlay.watch(overlay::at_least(2, all));
  const cdt::Point by{arguments.number<double>(5), arguments.number<double>(6)};
  Durations edits;
  double sum = 0;
  for (int step = 0; step < arguments.number<int>(4); ++step) {
    const double sign = step % 100 < 50 ? 1 : -1;
    edits.add(seconds_of([&] {
      overlay.translate(ring, {sign * by.x, sign * by.y});
      sum += overlay.area(twice).to_double();
    }));
  }
  std::printf("median=%.1f p99=%.1f us, %zu points, sum of areas %.9f\n", edits.microseconds(0.5),
              edits.microseconds(0.99), map.rings[which].points.size(), sum);
}

void time_map(const Arguments& arguments) {
  const Map map(arguments);
  Durations built;
  Durations checked;
  Durations cut;
  Durations all;
  std::size_t overlaps = 0;
  std::size_t gaps = 0;
  std::size_t arcs = 0;
  for (int i = 0; i < arguments.number_or(3, 3); ++i) {
    Overlay overlay;
    const double build = seconds_of([&] { map.insert_into(overlay); });
    const double check = seconds_of([&] {
      const overlay::CoverageFaults faults = check_coverage(overlay);
      overlaps = faults.overlaps.size();
      gaps = faults.gaps.size();
    });
    const double arc = seconds_of([&] { arcs = overlay::arcs(overlay).arcs.size(); });
    built.add(build);
    checked.add(check);
    cut.add(arc);
    all.add(build + check + arc);
  }
  std::printf(
      "median=%.1f ms: owners %.1f, overlaps (%zu) and gaps (%zu) %.1f, borders (%zu arcs) %.1f\n",
      1e3 * all.quantile(0.5), 1e3 * built.quantile(0.5), overlaps, gaps,
      1e3 * checked.quantile(0.5), arcs, 1e3 * cut.quantile(0.5));
}

void time_points(const Arguments& arguments) {
  Overlay overlay;
  Map(arguments).insert_into(overlay);
  std::vector<cdt::Point> points;
  std::ifstream file(arguments.word(3));
  for (cdt::Point p; file >> p.x >> p.y;) points.push_back(p);
  std::size_t inside = 0;
  const double seconds = seconds_of([&] {
    for (const cdt::Point p : points) inside += overlay.cover(p).inside.empty() ? 0 : 1;
  });
  std::printf("median=%.1f ms, %zu of %zu inside\n", 1e3 * seconds, inside, points.size());
}

void time_lines(const Arguments& arguments) {
  Overlay overlay;
  Map(arguments).insert_into(overlay);
  const Workload lines = read_workload(arguments.word(3));
  std::size_t count = 0;
  const LayerId layer = overlay.add_layer("lines");
  std::vector<Shape> shapes;
  add_shapes(shapes, layer, lines);
  const double in = seconds_of([&] {
    for (const RingId line : overlay.insert(shapes)) count += pieces(overlay, line).size();
  });
  const double out = seconds_of([&] { overlay.clear(layer); });
  std::printf("median=%.1f ms in, %.1f out, %zu pieces\n", 1e3 * in, 1e3 * out, count);
}

void run(const Arguments& arguments) {
  const std::string mode = arguments.word(0);
  const Expression a = LayerId(0);
  const Expression b = LayerId(1);
  if (mode == "union") return time_union(arguments);
  if (mode == "and") return time_two(arguments, std::vector{a & b});
  if (mode == "four") return time_two(arguments, std::vector{a | b, a & b, a - b, a ^ b});
  if (mode == "move") return time_moves(arguments, false);
  if (mode == "any") return time_moves(arguments, true);
  if (mode == "map") return time_map(arguments);
  if (mode == "drag") return time_drags(arguments);
  if (mode == "points") return time_points(arguments);
  if (mode == "lines") return time_lines(arguments);
  throw std::invalid_argument(usage);
}

}  // namespace
}  // namespace loft::bench

int main(int argc, char** argv) {
  try {
    loft::bench::run({argc, argv, loft::bench::usage});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
