// SPDX-License-Identifier: MIT
#include "app/commands/fidelity.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "app/report.h"
#include "cdt/predicates.h"
#include "reconstruct/world.h"

namespace loft::app {

namespace {

using Index = std::uint32_t;

bool is_finite(const Vec3& place) {
  return std::ranges::all_of(place, [](double x) { return std::isfinite(x); });
}

/// The places of all vertices, sorted, and the edges between them, sorted.
class PlacesAndEdges {
 public:
  explicit PlacesAndEdges(std::span<const io::LabelledMesh> meshes) {
    for (const auto& [label, mesh] : meshes) {
      std::ranges::copy_if(mesh.points, std::back_inserter(places_), is_finite);
    }
    sort_unique(places_);
    for (const auto& [label, mesh] : meshes) add_edges(mesh);
    sort_unique(edges_);
  }

  [[nodiscard]] std::optional<Index> find(const Vec3& place) const {
    const auto found = std::ranges::lower_bound(places_, place);
    if (found == places_.end() || *found != place) return std::nullopt;
    return static_cast<Index>(found - places_.begin());
  }

  [[nodiscard]] bool has_edge(const Vec3& a, const Vec3& b) const {
    const auto from = find(a);
    const auto to = find(b);
    return from && to && std::ranges::binary_search(edges_, edge(*from, *to));
  }

 private:
  using Edge = std::pair<Index, Index>;  // the smaller first

  static Edge edge(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

  template <class Element>
  static void sort_unique(std::vector<Element>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  void add_edges(const Mesh& mesh) {
    std::vector<std::optional<Index>> number;
    number.reserve(mesh.points.size());
    for (const Vec3& point : mesh.points) number.push_back(find(point));
    for (const auto& face : mesh.faces) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto from = number[face[corner]];
        const auto to = number[face[(corner + 1) % 3]];
        if (from && to) edges_.push_back(edge(*from, *to));
      }
    }
  }

  std::vector<Vec3> places_;
  std::vector<Edge> edges_;
};

bool has_contour_edge(const PlacesAndEdges& mesh, const Vec3& a, const Vec3& b) {
  if (mesh.has_edge(a, b)) return true;
  const Vec3 middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  return mesh.has_edge(a, middle) && mesh.has_edge(middle, b);
}

/// Whether a contour encloses nothing because its points are all in one line (exact).
bool is_flat(std::span<const cdt::Point> points) {
  const auto other = std::ranges::find_if(points, [&](cdt::Point p) { return p != points[0]; });
  return std::all_of(other, points.end(),
                     [&](cdt::Point p) { return cdt::orient(points[0], *other, p) == 0; });
}

std::string place(std::size_t slice, double z, std::size_t contour, std::size_t point) {
  return "slice " + std::to_string(slice) + " (z = " + rounded(z) + ") contour " +
         std::to_string(contour) + " point " + std::to_string(point);
}

}  // namespace

Fidelity compare(const Stack& whole, std::span<const io::LabelledMesh> meshes) {
  const std::vector<Slice>& stack = whole.slices;
  const PlacesAndEdges mesh(meshes);
  Fidelity result;
  const auto note = [&](bool is_there, std::size_t& count, std::size_t& missing, auto... where) {
    ++count;
    if (is_there) return;
    ++missing;
    if (!result.first_missing) result.first_missing = place(where...);
  };
  for (std::size_t s = 0; s < stack.size(); ++s) {
    const double z = stack[s].z;
    for (std::size_t c = 0; c < stack[s].contours.size(); ++c) {
      const std::vector<cdt::Point>& points = stack[s].contours[c].points;
      if (is_flat(points)) continue;
      for (std::size_t p = 0; p < points.size(); ++p) {
        const auto next = static_cast<std::uint32_t>((p + 1) % points.size());
        const auto in_world = [&](std::uint32_t point) {
          return world_place(whole, {points[point].x, points[point].y, z},
                             {VertexKind::contour, static_cast<std::uint32_t>(s),
                              static_cast<std::uint32_t>(c), point});
        };
        const Vec3 here = in_world(static_cast<std::uint32_t>(p));
        const bool is_there = mesh.find(here).has_value();
        note(is_there, result.vertices, result.missing_vertices, s, z, c, p);
        if (points[p] == points[next]) continue;
        const bool is_joined = has_contour_edge(mesh, here, in_world(next));
        note(is_joined, result.edges, result.missing_edges, s, z, c, p);
      }
    }
  }
  return result;
}

}  // namespace loft::app
