// SPDX-License-Identifier: MIT
#include "reconstruct/shape/rim_vertices.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "reconstruct/shape/nearness.h"

namespace loft {

namespace {

using Vertex = Surface::VertexHandle;
using Halfedge = Surface::HalfedgeHandle;

/// The faces at the rim must be within the tolerance, too, and are measured with rounding.
constexpr double margin = 1 - 0x1p-20;

Vec3 place(const Surface& surface, Vertex v) {
  const OpenMesh::Vec3d& p = surface.point(v);
  return {p[0], p[1], p[2]};
}

/// The vertices of a rim, from its smallest place on, and that place again at the end.
struct Rim {
  std::vector<Vertex> vertices;
  std::vector<Vec3> places;
};

Rim read_rim(const Surface& surface, Halfedge start, std::vector<bool>& is_read) {
  Rim rim;
  Halfedge h = start;
  do {
    is_read[static_cast<std::size_t>(h.idx())] = true;
    rim.vertices.push_back(surface.from_vertex_handle(h));
    h = surface.next_halfedge_handle(h);
  } while (h != start);
  const auto smallest =
      std::ranges::min_element(rim.vertices, {}, [&](Vertex v) { return place(surface, v); });
  std::rotate(rim.vertices.begin(), smallest, rim.vertices.end());
  rim.vertices.push_back(rim.vertices.front());
  for (const Vertex v : rim.vertices) rim.places.push_back(place(surface, v));
  return rim;
}

/// Whether all places are near the edge from the first to the last.
bool are_near_edge(std::span<const Vec3> places, double distance) {
  return std::ranges::all_of(places, [&](const Vec3& p) {
    return squared_distance(p, places.front(), places.back()) <= distance * distance;
  });
}

/// How many of the edges from the first place on may be one; at least one.
std::size_t longest_edge(std::span<const Vec3> places, double distance) {
  const auto may_be = [&](std::size_t edges) {
    return edges < places.size() && are_near_edge(places.first(edges + 1), distance);
  };
  std::size_t good = 1;
  std::size_t bad = 2;
  while (may_be(bad)) {
    good = bad;
    bad *= 2;
  }
  while (bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    (may_be(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace

std::vector<bool> rim_vertices_to_keep(const Surface& surface, double tolerance) {
  std::vector<bool> keep(surface.n_vertices(), false);
  std::vector<bool> is_read(surface.n_halfedges(), false);
  for (const auto h : surface.halfedges()) {
    if (!surface.is_boundary(h) || is_read[static_cast<std::size_t>(h.idx())]) continue;
    const Rim rim = read_rim(surface, h, is_read);
    const std::span<const Vec3> places = rim.places;
    for (std::size_t at = 0; at + 1 < places.size();
         at += longest_edge(places.subspan(at), tolerance * margin))
      keep[static_cast<std::size_t>(rim.vertices[at].idx())] = true;
  }
  return keep;
}

}  // namespace loft
