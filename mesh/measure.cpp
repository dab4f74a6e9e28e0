// SPDX-License-Identifier: MIT
#include "mesh/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/triangle_shape.h"
#include "mesh/vec3.h"

namespace loft {

namespace {

std::size_t count_used_vertices(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  std::vector<bool> is_used(mesh.points.size(), false);
  std::size_t count = 0;
  for (const std::uint32_t face : faces) {
    for (const std::uint32_t vertex : mesh.faces[face]) {
      if (!is_used[vertex]) ++count;
      is_used[vertex] = true;
    }
  }
  return count;
}

std::size_t count_components(const Mesh& mesh, std::span<const std::uint32_t> faces,
                             const Edges& edges) {
  const std::vector<std::uint32_t> component = components(mesh, edges);
  const auto is_first = [&](std::uint32_t face) { return component[face] == face; };
  return static_cast<std::size_t>(std::ranges::count_if(faces, is_first));
}

/// The holes of an open surface: chains of edges with one face.
std::size_t count_rims(const Mesh& mesh, const Edges& edges) {
  DisjointSets joined(mesh.points.size());
  std::vector<std::uint32_t> ends;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() != 1) continue;
    joined.unite(edges[e].front().low, edges[e].front().high);
    ends.push_back(edges[e].front().low);
  }
  for (std::uint32_t& end : ends) end = joined.find(end);
  std::ranges::sort(ends);
  return static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
}

}  // namespace

/// Euler: vertices - edges + faces = 2 components - 2 genus - rims.
int genus(const Measures& m, std::size_t rims) {
  const auto euler =
      static_cast<std::int64_t>(m.vertices + m.faces) - static_cast<std::int64_t>(m.edges);
  return static_cast<int>(
      (2 * static_cast<std::int64_t>(m.components) - euler - static_cast<std::int64_t>(rims)) / 2);
}

void FaceSum::add(const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  if (!origin_) origin_ = a;
  const Vec3 normal = cross(minus(b, a), minus(c, a));
  area_ += std::sqrt(dot(normal, normal)) / 2;
  volume_ += dot(normal, minus(a, *origin_)) / 6;
  angles_.add(triangle);
}

void FaceSum::put_into(Measures& measures) const {
  measures.area = area_;
  measures.volume = volume_;
  measures.angles = angles_.angles();
}

void AngleCount::add(const Corners& triangle) {
  const double sine = smallest_sine(triangle);
  // NaN and what overflows are no angle; sines are above 1 by rounding alone.
  const double angle = sine > 0 ? std::asin(std::min(sine, 1.0)) * 180 / std::numbers::pi : 0;
  smallest_ = std::min(smallest_, angle);
  worst_aspect_ = std::max(worst_aspect_, aspect(triangle));
  ++counts_[std::min(static_cast<std::size_t>(angle * bins_a_degree), counts_.size() - 1)];
  ++count_;
}

/// The middle of the bin that the triangle of that rank is in; no less than the smallest of all.
double AngleCount::angle_of(std::size_t rank) const {
  std::size_t bin = 0;
  for (std::size_t seen = counts_[0]; seen <= rank; seen += counts_[bin]) ++bin;
  return std::max(smallest_, (static_cast<double>(bin) + 0.5) / bins_a_degree);
}

Angles AngleCount::angles() const {
  if (count_ == 0) return {};
  return {smallest_, angle_of(count_ / 20), angle_of(count_ / 2), worst_aspect_};
}

Measures measure(const Mesh& mesh) {
  const std::vector<std::uint32_t> faces = proper_faces(mesh);
  const Edges edges(mesh, faces);
  Measures result;
  result.vertices = count_used_vertices(mesh, faces);
  result.edges = edges.size();
  result.faces = faces.size();
  result.components = count_components(mesh, faces, edges);
  result.genus = genus(result, count_rims(mesh, edges));
  FaceSum sum;
  for (const std::uint32_t face : faces) {
    const auto [a, b, c] = mesh.faces[face];
    sum.add({mesh.points[a], mesh.points[b], mesh.points[c]});
  }
  sum.put_into(result);
  return result;
}

}  // namespace loft
