// SPDX-License-Identifier: MIT
#include "mesh/nesting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "cdt/expansion.h"
#include "mesh/predicates.h"
#include "mesh/triangle_tree.h"

namespace loft {

namespace {

constexpr std::uint32_t none = 0xffff'ffff;

/// The shells without volume and depth, and the shell of each face.
struct Membership {
  std::vector<Shell> shells;
  std::vector<std::uint32_t> of_face;
};

Membership collect_shells(std::span<const std::uint32_t> component) {
  Membership result;
  result.of_face.assign(component.size(), none);
  for (std::uint32_t face = 0; face < component.size(); ++face) {
    const std::uint32_t first = component[face];
    if (first == not_in_a_shell) continue;
    if (first == face) {
      result.of_face[face] = static_cast<std::uint32_t>(result.shells.size());
      result.shells.push_back({.first_face = face});
    }
    result.of_face[face] = result.of_face[first];
  }
  return result;
}

// --- Volume ---

/// Six times the volume of the tetrahedron from a point to a face, and a bound of its magnitude.
struct Tetrahedron {
  double volume;
  double magnitude;
};

Tetrahedron tetrahedron(const Vec3& from, const Corners& face) {
  std::array<Vec3, 3> way;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) way[i][axis] = face[i][axis] - from[axis];
  }
  const auto [a, b, c] = way;
  const auto term = [](double p, double q, double r, double s, double factor) {
    return Tetrahedron{(p * q - r * s) * factor,
                       (std::abs(p * q) + std::abs(r * s)) * std::abs(factor)};
  };
  const Tetrahedron x = term(b[1], c[2], b[2], c[1], a[0]);
  const Tetrahedron y = term(b[2], c[0], b[0], c[2], a[1]);
  const Tetrahedron z = term(b[0], c[1], b[1], c[0], a[2]);
  return {x.volume + y.volume + z.volume, x.magnitude + y.magnitude + z.magnitude};
}

/// Seen from a corner of each shell, so that its place in space costs no accuracy; summed in twice
/// the precision, so that its size does not.
void measure_volumes(const Mesh& mesh, Membership& membership) {
  std::vector<double> rests(membership.shells.size());
  for (std::uint32_t face = 0; face < membership.of_face.size(); ++face) {
    const std::uint32_t s = membership.of_face[face];
    if (s == none) continue;
    Shell& shell = membership.shells[s];
    const Vec3& from = mesh.points[mesh.faces[shell.first_face][0]];
    const auto [volume, magnitude] = tetrahedron(from, corners(mesh, face));
    const auto [high, low] = cdt::two_sum(shell.volume, volume / 6);
    shell.volume = high;
    rests[s] += low;
    shell.volume_error += detail::orient3d_bound * magnitude / 6;
  }
  for (std::size_t s = 0; s < rests.size(); ++s) membership.shells[s].volume += rests[s];
}

// --- Depth ---

/// For each shell a vertex whose place no other shell has; none if all its vertices are shared.
std::vector<std::uint32_t> own_vertices(const Mesh& mesh, const Membership& membership) {
  struct Corner {
    std::uint32_t shell;
    std::uint32_t vertex;
  };
  std::vector<Corner> all;
  for (std::uint32_t face = 0; face < membership.of_face.size(); ++face) {
    const std::uint32_t shell = membership.of_face[face];
    if (shell == none) continue;
    for (const std::uint32_t vertex : mesh.faces[face]) all.push_back({shell, vertex});
  }
  std::ranges::sort(all, {}, [&](const Corner& c) -> const Vec3& { return mesh.points[c.vertex]; });

  std::vector<std::uint32_t> result(membership.shells.size(), none);
  for (auto first = all.begin(); first != all.end();) {
    const Vec3& place = mesh.points[first->vertex];
    const auto last = std::find_if(first, all.end(),
                                   [&](const Corner& c) { return mesh.points[c.vertex] != place; });
    const bool is_shared =
        std::any_of(first, last, [&](const Corner& c) { return c.shell != first->shell; });
    if (!is_shared) result[first->shell] = first->vertex;
    first = last;
  }
  return result;
}

Vec3 middle(const Corners& face) {
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis] =
        face[0][axis] + (face[1][axis] - face[0][axis]) / 3 + (face[2][axis] - face[0][axis]) / 3;
  }
  return result;
}

/// orient(u, v, p) for a p that was moved by an infinitesimal along x, and by one that is
/// infinitesimal even to that along y. 0 only where u is v.
int orient_beside(cdt::Point u, cdt::Point v, cdt::Point p) {
  const int side = cdt::orient(u, v, p);
  if (side != 0) return side;
  if (u.y != v.y) return u.y > v.y ? 1 : -1;
  return (u.x < v.x ? 1 : 0) - (v.x < u.x ? 1 : 0);
}

/// Whether the face is above a place that is not on it: whether the line upwards from beside the
/// place (see orient_beside; so it never touches an edge) goes through the face.
bool is_above(const Corners& face, const Vec3& place) {
  const auto seen_from_above = [](const Vec3& p) { return cdt::Point{p[0], p[1]}; };
  const auto side = [&](const Vec3& u, const Vec3& v) {
    return orient_beside(seen_from_above(u), seen_from_above(v), seen_from_above(place));
  };
  const int turn = side(face[0], face[1]);
  if (turn == 0 || side(face[1], face[2]) != turn || side(face[2], face[0]) != turn) return false;
  return orient3d(face[0], face[1], face[2], place) == -turn;
}

TriangleTree tree_of(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  std::vector<Corners> triangles;
  triangles.reserve(faces.size());
  for (const std::uint32_t face : faces) triangles.push_back(corners(mesh, face));
  return TriangleTree(triangles);
}

/// How many shells other than `self` have the place inside: an odd number of faces above it.
std::uint32_t depth(const Membership& membership, std::uint32_t self, const Vec3& place, double top,
                    std::span<const std::uint32_t> faces, const TriangleTree& tree) {
  std::vector<std::uint32_t> crossed;
  const std::array<Vec3, 2> line{place, Vec3{place[0], place[1], top}};
  (void)tree.all_of_meeting(line, [&](std::uint32_t i, const Corners& face) {
    const std::uint32_t shell = membership.of_face[faces[i]];
    if (shell != none && shell != self && is_above(face, place)) crossed.push_back(shell);
    return true;
  });
  std::ranges::sort(crossed);
  std::uint32_t result = 0;
  for (auto first = crossed.begin(); first != crossed.end();) {
    const auto last = std::upper_bound(first, crossed.end(), *first);
    result += static_cast<std::uint32_t>((last - first) % 2);
    first = last;
  }
  return result;
}

}  // namespace

std::vector<Shell> shells(const Mesh& mesh, std::span<const std::uint32_t> component,
                          std::span<const std::uint32_t> faces) {
  Membership membership = collect_shells(component);
  measure_volumes(mesh, membership);
  if (membership.shells.size() < 2) return membership.shells;
  const std::vector<std::uint32_t> own = own_vertices(mesh, membership);
  const TriangleTree tree = tree_of(mesh, faces);
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : mesh.points) top = std::max(top, p[2]);
  for (std::uint32_t s = 0; s < own.size(); ++s) {
    Shell& shell = membership.shells[s];
    const Vec3 place =
        own[s] != none ? mesh.points[own[s]] : middle(corners(mesh, shell.first_face));
    shell.depth = depth(membership, s, place, top, faces, tree);
  }
  return membership.shells;
}

}  // namespace loft
