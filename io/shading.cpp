// SPDX-License-Identifier: MIT
#include "io/shading.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "reconstruct/vec3.h"

namespace loft::io {

namespace {

Vec3 times(const Vec3& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }
Vec3 plus(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// What meets smoothly: the sides, the lower end, the upper end.
enum class Group : std::uint8_t { sides, bottom, top };
constexpr std::size_t group_count = 3;

Group group(FaceKind kind) {
  if (kind == FaceKind::bottom_cap) return Group::bottom;
  return kind == FaceKind::top_cap ? Group::top : Group::sides;
}

/// The sum of the normals around a vertex, and the widest of them.
struct NormalSum {
  Vec3 sum{};
  double weight = 0;
  Vec3 widest{};
  double widest_weight = 0;
  Group group = Group::sides;

  void add(const Vec3& normal, double angle) {
    sum = plus(sum, times(normal, angle));
    weight += angle;
    if (angle <= widest_weight) return;
    widest = normal;
    widest_weight = angle;
  }

  [[nodiscard]] Vec3 unit() const {
    constexpr double cancelled = 1e-6;  // of the weight: what is left then is rounding error
    const double size = length(sum);
    if (size > cancelled * weight) return times(sum, 1 / size);
    if (widest_weight > 0) return widest;
    return {0, 0, group == Group::bottom ? -1.0 : 1.0};
  }
};

/// A factor that brings the surface to a size near 1, so that no product vanishes or overflows.
double normalising_factor(const std::vector<Vec3>& points) {
  double extent = 0;
  for (const Vec3& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent = std::max(extent, std::abs(point[axis] - points.front()[axis]));
    }
  }
  return extent > 0 ? 1 / extent : 1;
}

/// Adds a face's normal at its three corners.
void add_face(const std::array<Vec3, 3>& corners, const std::array<NormalSum*, 3>& sums) {
  const std::array sides{minus(corners[1], corners[0]), minus(corners[2], corners[1]),
                         minus(corners[0], corners[2])};
  const Vec3 normal = cross(sides[0], sides[1]);
  const double size = length(normal);
  if (!(size > 0)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    // The angle between the side that leaves the corner and the reverse of the one that enters it.
    const double angle = std::atan2(size, -dot(sides[i], sides[(i + 2) % 3]));
    sums[i]->add(times(normal, 1 / size), angle);
  }
}

}  // namespace

ShadedMesh shade(const Surface& surface) {
  constexpr std::uint32_t none = 0xffff'ffff;
  const Mesh mesh = to_mesh(surface);
  ShadedMesh shaded;
  std::vector<NormalSum> sums;
  std::vector<std::uint32_t> number(group_count * mesh.points.size(), none);
  const auto vertex = [&](std::uint32_t index, Group of) {
    std::uint32_t& result = number[group_count * index + static_cast<std::size_t>(of)];
    if (result != none) return result;
    result = static_cast<std::uint32_t>(shaded.points.size());
    shaded.points.push_back(mesh.points[index]);
    sums.emplace_back().group = of;
    return result;
  };

  for (const auto face : surface.faces()) {
    const Group of = group(surface.data(face).kind);
    const auto& [a, b, c] = mesh.faces[static_cast<std::size_t>(face.idx())];
    shaded.faces.push_back({vertex(a, of), vertex(b, of), vertex(c, of)});
  }
  const double factor = normalising_factor(shaded.points);
  for (const auto& [a, b, c] : shaded.faces) {
    const auto place = [&](std::uint32_t i) { return times(shaded.points[i], factor); };
    add_face({place(a), place(b), place(c)}, {&sums[a], &sums[b], &sums[c]});
  }
  for (const NormalSum& sum : sums) shaded.normals.push_back(sum.unit());
  return shaded;
}

}  // namespace loft::io
