// SPDX-License-Identifier: MIT
// A vessel that pulsates: all 60 slices of 200 points are replaced for each picture, the surface is
// updated in its place. Plays some seconds at 30 pictures a second, and says how long each took:
// pulsating_vessel vessel.glb [SECONDS]
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "io/surfaces.h"
#include "reconstruct/reconstruction.h"

namespace {

using Clock = std::chrono::steady_clock;

constexpr int slice_count = 60;
constexpr int point_count = 200;
constexpr int pictures_a_second = 30;

/// The cross-section at a height and a time: a wave runs along the wall.
loft::Slice slice(int i, double seconds) {
  const double z = i;
  const double radius = 8 * (1 + 0.2 * std::sin(0.25 * z - 2 * std::numbers::pi * seconds));
  const loft::cdt::Point centre{4 * std::sin(z / 15), 3 * std::cos(z / 11)};
  loft::Slice slice{z, {{}}};
  for (int k = 0; k < point_count; ++k) {
    const double angle = 2 * std::numbers::pi * k / point_count;
    const double r = radius * (1 + 0.05 * std::sin(3 * angle + z / 5));
    slice.contours[0].points.push_back(
        {centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
  }
  return slice;
}

std::vector<loft::Slice> slices(double seconds) {
  std::vector<loft::Slice> all;
  for (int i = 0; i < slice_count; ++i) all.push_back(slice(i, seconds));
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "vessel.glb";
  const int picture_count = pictures_a_second * (argc > 2 ? std::atoi(argv[2]) : 2);

  loft::Reconstruction vessel;
  for (const loft::Slice& one : slices(0)) vessel.insert(one);

  std::vector<double> milliseconds;
  const auto begin = Clock::now();
  for (int picture = 1; picture <= picture_count; ++picture) {
    const auto due = begin + std::chrono::microseconds(1'000'000LL * picture / pictures_a_second);
    std::this_thread::sleep_until(due);
    const auto start = Clock::now();
    vessel.replace(slices(static_cast<double>(picture) / pictures_a_second));
    milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::sort(milliseconds.begin(), milliseconds.end());
  std::cout << picture_count << " pictures of " << vessel.face_count() << " triangles, "
            << milliseconds[milliseconds.size() / 2] << " ms each (median), longest "
            << milliseconds.back() << " ms\n";

  const loft::Surface surface = vessel.snapshot().surface();
  loft::io::write(path, std::array{loft::io::Part{"vessel", &surface}});
  std::cout << path << ": the last picture\n";
}
