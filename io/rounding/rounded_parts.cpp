// SPDX-License-Identifier: MIT
#include "io/rounding/rounded_parts.h"

#include <functional>
#include <numeric>

#include "io/rounding/mender.h"
#include "io/rounding/rounding_faults.h"
#include "reconstruct/parallel.h"

namespace loft::io {

namespace {

/// Faults that come from rounding are few; where there are more, and where the last place is not
/// small against all of it, this is no format for it.
bool is_mendable(const Mesh& mesh, const RoundingFaults& faults) {
  if (faults.vertices.size() > 10'000 + mesh.points.size() / 50) return false;
  Box3 box = no_box;
  for (const Vec3& point : mesh.points) box = extended(box, point);
  return !is_coarse(box, 0x1p-10);
}

Mesh rounded_mesh(Mesh mesh, const FloatFrame& frame) {
  for (Vec3& point : mesh.points) point = frame.rounded(point);
  return mesh;
}

PlaceCounts counts_of(const Mesh& mesh) {
  PlaceCounts counts;
  for (const Vec3& point : mesh.points) counts.add(point);
  return counts;
}

/// A surface as it is and as it is rounded.
struct Rounded {
  Rounded(const Surface& surface, const FloatFrame& frame)
      : exact(to_mesh(surface)), mesh(rounded_mesh(exact, frame)) {}
  Mesh exact;
  Mesh mesh;
};

/// The parts that have faults, each by itself.
std::vector<std::size_t> faulty_parts(std::span<const Part> parts, const FloatFrame& frame,
                                      const Runner& run) {
  std::vector<char> is_faulty(parts.size());
  const Runner run_inside = parts.size() > 1 ? Runner(run_in_turn) : run;
  run(parts.size(), [&](std::size_t i) {
    const Rounded rounded(*parts[i].surface, frame);
    const PlaceCounts counts = counts_of(rounded.mesh);
    is_faulty[i] = find_faults(rounded.mesh, rounded.exact, counts, run_inside).count > 0 ? 1 : 0;
  });
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (is_faulty[i] != 0) result.push_back(i);
  return result;
}

std::vector<std::size_t> all_parts(std::span<const Part> parts) {
  std::vector<std::size_t> result(parts.size());
  std::iota(result.begin(), result.end(), 0);
  return result;
}

}  // namespace

RoundedParts::RoundedParts(std::span<const Part> parts, const FloatFrame& frame, bool are_one,
                           unsigned threads)
    : parts_(parts.begin(), parts.end()) {
  const Runner run = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
    for_each_index(count, threads, [&](std::size_t i, unsigned) { task(i); });
  };
  PlaceCounts common;
  if (are_one)
    for (const Part& part : parts_)
      for (const Vec3& point : rounded_mesh(to_mesh(*part.surface), frame).points)
        common.add(point);
  // Those that are one are mended in turn, as each changes what is beside the next.
  for (const std::size_t i : are_one ? all_parts(parts_) : faulty_parts(parts_, frame, run)) {
    Part& part = parts_[i];
    const auto [exact, mesh] = Rounded(*part.surface, frame);
    PlaceCounts own = are_one ? PlaceCounts() : counts_of(mesh);
    PlaceCounts& counts = are_one ? common : own;
    const RoundingFaults faults = find_faults(mesh, exact, counts, run);
    rounding_.faults += faults.count;
    if (faults.count == 0) continue;
    if (!is_mendable(mesh, faults)) {
      rounding_.left += faults.count;
      continue;
    }
    Surface& surface = mended_.emplace_back(*part.surface);
    Mender mender(surface, mesh, frame, counts);
    mender.mend(faults.vertices);
    rounding_.moved += mender.moved();
    rounding_.collapsed += mender.collapsed();
    const Mesh unmoved = mender.unmoved();
    surface.garbage_collection();
    const Mesh mended = rounded_mesh(to_mesh(surface), frame);
    rounding_.left += find_faults(mended, unmoved, counts, run).count;
    part.surface = &surface;
  }
}

}  // namespace loft::io
