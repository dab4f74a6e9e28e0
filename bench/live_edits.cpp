// SPDX-License-Identifier: MIT
// Times edits of a stack that is there already, through Reconstruction.
//   live_edits [SLICES [POINTS [EDITS]]]      1000 1000 1000 by default
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "cdt/triangulation.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/reconstruction.h"

namespace {

using loft::Contour;
using loft::Reconstruction;
using loft::Slice;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Memory of the process, without address space that nothing was ever written to. In bytes.
std::size_t memory_in_use() {
  malloc_trim(0);
  std::size_t all = 0;
  std::size_t resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// A closed curve that wobbles, another one in every slice and for every phase.
Contour wobbly(std::size_t points, double radius, loft::cdt::Point centre, double phase) {
  Contour contour;
  for (std::size_t i = 0; i < points; ++i) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
    const double r =
        radius * (1 + 0.12 * std::sin(3 * angle + phase) + 0.05 * std::sin(11 * angle - 2 * phase));
    contour.points.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
  }
  return contour;
}

Slice one_curve(std::size_t i, std::size_t points, double phase) {
  const double z = static_cast<double>(i);
  return {z, {wobbly(points, 50, {0, 0}, 0.1 * z + phase)}};
}

/// 50 curves, side by side, or as holes in a plate.
Slice fifty(std::size_t i, std::size_t points, bool in_plate) {
  Slice slice{static_cast<double>(i), {}};
  for (int k = 0; k < 50; ++k)
    slice.contours.push_back(wobbly(points / 50, 4, {10.0 * (k % 10), 10.0 * (k / 10)},
                                    0.1 * static_cast<double>(i) + k));
  if (in_plate) slice.contours.push_back({{{-20, -20}, {120, -20}, {120, 80}, {-20, 80}}, ""});
  return slice;
}

Contour moved(Contour contour, double by) {
  for (auto& p : contour.points) p.x += by;
  return contour;
}

/// Median and 99th percentile, in milliseconds.
double report(const char* what, std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const double median = 1e3 * times[times.size() / 2];
  std::printf("%-46s median %7.3f ms  p99 %7.3f ms  max %7.3f ms\n", what, median,
              1e3 * times[times.size() * 99 / 100], 1e3 * times.back());
  return median;
}

template <class Body>
std::vector<double> times(std::size_t count, Body body) {
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double begin = seconds();
    body(i);
    all.push_back(seconds() - begin);
  }
  return all;
}

void time_whole_slices(std::size_t slices, std::size_t points, std::size_t edits) {
  const std::size_t before = memory_in_use();
  Reconstruction live;
  const auto inserts = times(
      slices, [&](std::size_t i) { static_cast<void>(live.insert(one_curve(i, points, 0))); });
  report("insert on top", inserts);
  const auto memory = [&] {
    std::printf(
        "memory: %.0f bytes a contour vertex\n",
        static_cast<double>(memory_in_use() - before) / static_cast<double>(slices * points));
  };
  memory();
  std::mt19937_64 random(1);
  std::vector<Slice> wanted;
  for (std::size_t i = 0; i < edits; ++i)
    wanted.push_back(one_curve(random() % slices, points, 0.01 * static_cast<double>(i)));
  report("replace a slice", times(edits, [&](std::size_t i) {
           static_cast<void>(live.replace(wanted[i].z, std::move(wanted[i])));
         }));
  wanted = {};
  memory();
  const auto all = live.slices();
  const double begin = seconds();
  const auto made = loft::reconstruct(all, {.threads = 1});
  std::printf("from scratch, one thread: %.0f ms\n", 1e3 * (seconds() - begin));
}

void time_one_of_fifty(std::size_t slices, std::size_t points, std::size_t edits, bool in_plate) {
  Reconstruction live;
  for (std::size_t i = 0; i < slices; ++i)
    static_cast<void>(live.insert(fifty(i, points, in_plate)));
  std::mt19937_64 random(1);
  std::printf("%s\n", in_plate ? "50 holes in a plate" : "50 contours side by side");
  const double whole = report("  replace the slice, all moved", times(edits, [&](std::size_t i) {
                                Slice slice = *live.find(static_cast<double>(random() % slices));
                                for (auto& contour : slice.contours)
                                  contour = moved(contour, i % 2 == 0 ? 0.01 : -0.01);
                                static_cast<void>(live.replace(slice.z, std::move(slice)));
                              }));
  const double one = report(
      "  move one contour", times(edits, [&](std::size_t i) {
        const double z = static_cast<double>(random() % slices);
        const std::size_t contour = random() % 50;
        static_cast<void>(live.move_contour(
            z, contour, moved(live.find(z)->contours[contour], i % 2 == 0 ? 0.01 : -0.01).points));
      }));
  std::printf("  ratio %.2f\n", one / whole);
}

/// What it would take to keep the CDT of both slices of a slab from edit to edit, and to change it
/// there, instead of making that of the pieces that an edit touches anew.
void time_kept_overlay(std::size_t points, std::size_t edits) {
  const std::size_t before = memory_in_use();
  loft::cdt::Triangulation kept;
  const auto insert = [](loft::cdt::Triangulation& overlay, const Slice& slice) {
    std::vector<loft::cdt::ConstraintId> ids;
    for (const Contour& contour : slice.contours)
      ids.push_back(overlay.insert(contour.points, loft::cdt::closed));
    return ids;
  };
  insert(kept, one_curve(0, points, 0));
  auto changing = insert(kept, one_curve(1, points, 0))[0];
  std::puts("the overlay of a slab, kept");
  std::printf("  memory: %.0f bytes a contour vertex, of which each is in two\n",
              static_cast<double>(memory_in_use() - before) / static_cast<double>(points));
  loft::cdt::Triangulation workspace;
  report("  one curve for another: made anew", times(edits, [&](std::size_t i) {
           workspace.clear();
           insert(workspace, one_curve(0, points, 0));
           insert(workspace, one_curve(1, points, 0.01 * static_cast<double>(i)));
         }));
  report("  one curve for another: there", times(edits, [&](std::size_t i) {
           kept.remove(changing);
           changing = insert(kept, one_curve(1, points, 0.01 * static_cast<double>(i)))[0];
         }));
  const Slice lower = fifty(0, points, false);
  const Slice upper = fifty(1, points, false);
  const auto moved_seventh = [&](std::size_t i) {
    return Slice{1, {moved(upper.contours[7], 0.001 * static_cast<double>(i % 10))}};
  };
  report("  one of 50: its piece made anew", times(edits, [&](std::size_t i) {
           workspace.clear();
           insert(workspace, Slice{0, {lower.contours[7]}});
           insert(workspace, moved_seventh(i));
         }));
  kept.clear();
  insert(kept, lower);
  changing = insert(kept, upper)[7];
  report("  one of 50: there", times(edits, [&](std::size_t i) {
           kept.remove(changing);
           changing = insert(kept, moved_seventh(i))[0];
         }));
}

/// A vessel of 60 slices with 200 points, all replaced for each frame.
void time_vessel() {
  constexpr std::size_t slices = 60;
  Reconstruction live;
  const auto slice = [](std::size_t i, double phase) {
    const double z = static_cast<double>(i);
    return Slice{z, {wobbly(200, 10 + 2 * std::sin(0.2 * z + phase), {0.1 * z, 0}, phase)}};
  };
  for (std::size_t i = 0; i < slices; ++i) static_cast<void>(live.insert(slice(i, 0)));
  const double frame =
      report("a frame of the vessel, 60 x 200, all replaced", times(100, [&](std::size_t f) {
               std::vector<Slice> wanted;
               for (std::size_t i = 0; i < slices; ++i)
                 wanted.push_back(slice(i, 0.2 * static_cast<double>(f + 1)));
               static_cast<void>(live.replace(std::move(wanted)));
             }));
  std::printf("frames a second: %.0f\n", 1e3 / frame);
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, std::size_t usual) {
    return argc > i ? static_cast<std::size_t>(std::strtoul(argv[i], nullptr, 10)) : usual;
  };
  const std::size_t slices = argument(1, 1000);
  const std::size_t points = argument(2, 1000);
  const std::size_t edits = argument(3, 1000);
  std::printf("%zu slices of %zu points\n", slices, points);
  time_whole_slices(slices, points, edits);
  time_one_of_fifty(std::min<std::size_t>(slices, 100), points, edits, false);
  time_one_of_fifty(std::min<std::size_t>(slices, 100), points, edits, true);
  time_vessel();
  time_kept_overlay(points, edits);
}
