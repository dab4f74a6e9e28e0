// SPDX-License-Identifier: MIT
#include "io/gltf/shading.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "mesh/vec3.h"

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

/// The normals of all faces, the faces that are wanted.
class Shading {
 public:
  explicit Shading(const Mesh& mesh)
      : mesh_(mesh), numbers_(group_count * mesh.points.size(), none) {}

  template <class KindOf, class IsWanted>
  ShadedMesh run(KindOf kind_of, IsWanted is_wanted) {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      if (is_wanted(f)) add(mesh_.faces[f], group(kind_of(f)));
    const double factor = normalising_factor(mesh_.points);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      std::array<Vec3, 3> corners{};
      std::array<NormalSum*, 3> sums{};
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = times(mesh_.points[mesh_.faces[f][i]], factor);
        const std::uint32_t number = this->number(mesh_.faces[f][i], group(kind_of(f)));
        sums[i] = number == none ? &elsewhere_ : &sums_[number];
      }
      add_face(corners, sums);
    }
    for (const NormalSum& sum : sums_) shaded_.normals.push_back(sum.unit());
    return std::move(shaded_);
  }

 private:
  static constexpr std::uint32_t none = 0xffff'ffff;

  [[nodiscard]] std::uint32_t& number(std::uint32_t point, Group of) {
    return numbers_[group_count * point + static_cast<std::size_t>(of)];
  }

  void add(const std::array<std::uint32_t, 3>& face, Group of) {
    std::array<std::uint32_t, 3>& corners = shaded_.faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& result = number(face[i], of);
      if (result == none) {
        result = static_cast<std::uint32_t>(shaded_.points.size());
        shaded_.points.push_back(mesh_.points[face[i]]);
        sums_.emplace_back().group = of;
      }
      corners[i] = result;
    }
  }

  const Mesh& mesh_;
  ShadedMesh shaded_;
  std::vector<std::uint32_t> numbers_;  // of each point in each group
  std::vector<NormalSum> sums_;
  NormalSum elsewhere_;
};

/// Gives each slab vertices of its own.
class Parting {
 public:
  explicit Parting(const ShadedMesh& together)
      : together_(together), places_(together.points.size()) {}

  /// The next slab.
  void begin() {
    begin_ = static_cast<std::uint32_t>(parted_.mesh.points.size());
    parted_.vertices.push_back(0);
    parted_.faces.push_back(0);
  }
  void add(const std::array<std::uint32_t, 3>& face) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = own(face[i]);
    parted_.mesh.faces.push_back(corners);
    ++parted_.faces.back();
  }
  [[nodiscard]] ShadedSlabs parted() && { return std::move(parted_); }

 private:
  [[nodiscard]] std::uint32_t own(std::uint32_t vertex) {
    std::uint32_t& place = places_[vertex];
    const bool is_known =
        place >= begin_ && place < parted_.mesh.points.size() && origins_[place] == vertex;
    if (is_known) return place;
    place = static_cast<std::uint32_t>(parted_.mesh.points.size());
    parted_.mesh.points.push_back(together_.points[vertex]);
    parted_.mesh.normals.push_back(together_.normals[vertex]);
    origins_.push_back(vertex);
    ++parted_.vertices.back();
    return place;
  }

  const ShadedMesh& together_;
  ShadedSlabs parted_;
  std::uint32_t begin_ = 0;             // of the slab's vertices
  std::vector<std::uint32_t> places_;   // of each vertex, in the last slab that has it
  std::vector<std::uint32_t> origins_;  // of each vertex that was made
};

}  // namespace

ShadedMesh shade(const Surface& surface) {
  const Mesh mesh = to_mesh(surface);
  return Shading(mesh).run(
      [&](std::size_t f) { return surface.data(Surface::FaceHandle(static_cast<int>(f))).kind; },
      [](std::size_t) { return true; });
}

ShadedMesh shade(const Patch& patch, std::uint32_t slab) {
  return Shading(patch.mesh)
      .run([&](std::size_t f) { return patch.kinds[f]; },
           [&](std::size_t f) { return patch.slabs[f] == slab; });
}

ShadedSlabs shade_apart(const Patch& patch, std::uint32_t first, std::uint32_t last) {
  const auto is_wanted = [&](std::size_t f) {
    return patch.slabs[f] >= first && patch.slabs[f] < last;
  };
  const ShadedMesh together =
      Shading(patch.mesh).run([&](std::size_t f) { return patch.kinds[f]; }, is_wanted);
  Parting parting(together);
  std::size_t next = 0;  // of the faces in `together`
  std::size_t f = 0;
  for (std::uint32_t slab = first; slab < last; ++slab) {
    parting.begin();
    for (; f < patch.slabs.size() && patch.slabs[f] <= slab; ++f)
      if (is_wanted(f)) parting.add(together.faces[next++]);
  }
  return std::move(parting).parted();
}

}  // namespace loft::io
