// SPDX-License-Identifier: MIT
#include "io/rounding/rounded_parts.h"

#include "io/rounding/mender.h"
#include "io/rounding/rounding_faults.h"

namespace loft::io {

namespace {

/// Faults that come from rounding are few; where there are more, this is no format for it.
std::size_t most_to_mend(const Mesh& mesh) { return 10'000 + mesh.points.size() / 50; }

Mesh rounded_mesh(const Surface& surface, const FloatFrame& frame) {
  Mesh mesh = to_mesh(surface);
  for (Vec3& point : mesh.points) point = frame.rounded(point);
  return mesh;
}

PlaceCounts counts_of(const Mesh& mesh) {
  PlaceCounts counts;
  for (const Vec3& point : mesh.points) counts.add(point);
  return counts;
}

}  // namespace

RoundedParts::RoundedParts(std::span<const Part> parts, const FloatFrame& frame, bool are_one)
    : parts_(parts.begin(), parts.end()) {
  PlaceCounts common;
  if (are_one)
    for (const Part& part : parts_)
      for (const Vec3& point : rounded_mesh(*part.surface, frame).points) common.add(point);
  for (Part& part : parts_) {
    const Mesh mesh = rounded_mesh(*part.surface, frame);
    PlaceCounts own = are_one ? PlaceCounts() : counts_of(mesh);
    PlaceCounts& counts = are_one ? common : own;
    const RoundingFaults faults = find_faults(mesh, counts);
    rounding_.faults += faults.count;
    if (faults.count == 0) continue;
    if (faults.vertices.size() > most_to_mend(mesh)) {
      rounding_.left += faults.count;
      continue;
    }
    Surface& surface = mended_.emplace_back(*part.surface);
    Mender mender(surface, mesh, frame, counts);
    mender.mend(faults.vertices);
    rounding_.moved += mender.moved();
    rounding_.collapsed += mender.collapsed();
    rounding_.left += find_faults(rounded_mesh(surface, frame), counts).count;
    part.surface = &surface;
  }
}

}  // namespace loft::io
