// SPDX-License-Identifier: MIT
#include "io/rounding/rounded_parts.h"

#include "io/rounding/mender.h"
#include "io/rounding/rounding_faults.h"

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

}  // namespace

RoundedParts::RoundedParts(std::span<const Part> parts, const FloatFrame& frame, bool are_one)
    : parts_(parts.begin(), parts.end()) {
  PlaceCounts common;
  if (are_one)
    for (const Part& part : parts_)
      for (const Vec3& point : rounded_mesh(to_mesh(*part.surface), frame).points)
        common.add(point);
  for (Part& part : parts_) {
    const Mesh exact = to_mesh(*part.surface);
    const Mesh mesh = rounded_mesh(exact, frame);
    PlaceCounts own = are_one ? PlaceCounts() : counts_of(mesh);
    PlaceCounts& counts = are_one ? common : own;
    const RoundingFaults faults = find_faults(mesh, exact, counts);
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
    rounding_.left += find_faults(mended, unmoved, counts).count;
    part.surface = &surface;
  }
}

}  // namespace loft::io
