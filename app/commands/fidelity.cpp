// SPDX-License-Identifier: MIT
#include "app/commands/fidelity.h"

#include <algorithm>
#include <array>
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
    for (const auto& [label, mesh, colour] : meshes) {
      std::ranges::copy_if(mesh.points, std::back_inserter(places_), is_finite);
    }
    sort_unique(places_);
    for (const auto& [label, mesh, colour] : meshes) add_edges(mesh);
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

/// The vertices of a mesh near places in slices, by height first.
class NearPlaces {
 public:
  /// `slack`: how much heights may differ.
  NearPlaces(std::span<const io::LabelledMesh> meshes, double distance, double slack)
      : distance_(distance), slack_(slack) {
    for (const auto& [label, mesh, colour] : meshes)
      std::ranges::copy_if(mesh.points, std::back_inserter(places_), is_finite);
    std::ranges::sort(places_, {}, by_height);
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  }

  [[nodiscard]] std::vector<Vec3> of(const Vec3& place) const {
    std::vector<Vec3> near;
    auto next = std::ranges::lower_bound(
        places_, std::array{place[2] - slack_, place[0] - distance_, place[1] - distance_}, {},
        by_height);
    for (; next != places_.end() && (*next)[2] <= place[2] + slack_; ++next) {
      if (slack_ == 0 && (*next)[0] > place[0] + distance_) break;
      if (std::hypot((*next)[0] - place[0], (*next)[1] - place[1], (*next)[2] - place[2]) <=
          (1 + rounding) * distance_)
        near.push_back(*next);
    }
    return near;
  }

 private:
  static constexpr double rounding = 1e-9;  ///< of coordinates, in distances

  static std::array<double, 3> by_height(const Vec3& place) {
    return {place[2], place[0], place[1]};
  }

  std::vector<Vec3> places_;
  double distance_;
  double slack_;
};

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

Fidelity compare(const Stack& whole, std::span<const io::LabelledMesh> meshes, double within) {
  const std::vector<Slice>& stack = whole.slices;
  const PlacesAndEdges mesh(meshes);
  std::optional<NearPlaces> near;
  if (within > 0) near.emplace(meshes, within, whole.frame ? within : 0);
  const auto is_there = [&](const Vec3& place) {
    return near ? !near->of(place).empty() : mesh.find(place).has_value();
  };
  const auto is_joined = [&](const Vec3& a, const Vec3& b) {
    if (!near) return has_contour_edge(mesh, a, b);
    const std::vector<Vec3> to = near->of(b);
    return std::ranges::any_of(near->of(a), [&](const Vec3& from) {
      return std::ranges::any_of(
          to, [&](const Vec3& other) { return has_contour_edge(mesh, from, other); });
    });
  };
  Fidelity result;
  const auto note = [&](bool is_found, std::size_t& count, std::size_t& missing, auto... where) {
    ++count;
    if (is_found) return;
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
        note(is_there(here), result.vertices, result.missing_vertices, s, z, c, p);
        if (points[p] == points[next]) continue;
        note(is_joined(here, in_world(next)), result.edges, result.missing_edges, s, z, c, p);
      }
    }
  }
  return result;
}

}  // namespace loft::app
