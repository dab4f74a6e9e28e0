// SPDX-License-Identifier: MIT
#include "mesh/adjacency.h"

#include <algorithm>
#include <numeric>

namespace loft {

bool runs_up(const Mesh& mesh, const EdgeSide& side) {
  return mesh.faces[side.face][side.corner] == side.low;
}

Edges::Edges(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  sides_.reserve(3 * faces.size());
  for (const std::uint32_t face : faces) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const auto [low, high] =
          std::minmax({mesh.faces[face][corner], mesh.faces[face][(corner + 1) % 3]});
      sides_.push_back({low, high, face, corner});
    }
  }
  std::ranges::sort(sides_);
  const auto is_first = [&](std::size_t i) {
    return i == 0 || sides_[i].low != sides_[i - 1].low || sides_[i].high != sides_[i - 1].high;
  };
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (is_first(i)) first_.push_back(static_cast<std::uint32_t>(i));
  }
  first_.push_back(static_cast<std::uint32_t>(sides_.size()));
}

std::span<const EdgeSide> Edges::operator[](std::size_t edge) const {
  return std::span(sides_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
}

DisjointSets::DisjointSets(std::size_t n) : parent_(n) {
  std::iota(parent_.begin(), parent_.end(), 0U);
}

std::uint32_t DisjointSets::find(std::uint32_t element) {
  while (parent_[element] != element) {
    parent_[element] = parent_[parent_[element]];
    element = parent_[element];
  }
  return element;
}

void DisjointSets::unite(std::uint32_t a, std::uint32_t b) {
  const auto [low, high] = std::minmax({find(a), find(b)});
  parent_[high] = low;
}

std::uint32_t DisjointSets::add() {
  parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
  return parent_.back();
}

std::size_t DisjointSets::count() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < parent_.size(); ++i) count += parent_[i] == i ? 1U : 0U;
  return count;
}

std::vector<std::uint32_t> proper_faces(const Mesh& mesh) {
  const auto is_proper = [&](const std::array<std::uint32_t, 3>& face) {
    const auto [a, b, c] = face;
    return std::max({a, b, c}) < mesh.points.size() && a != b && b != c && c != a;
  };
  std::vector<std::uint32_t> result;
  result.reserve(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (is_proper(mesh.faces[f])) result.push_back(f);
  }
  return result;
}

std::vector<std::uint32_t> components(const Mesh& mesh, const Edges& edges) {
  DisjointSets sets(mesh.faces.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const EdgeSide& side : edges[e]) sets.unite(edges[e].front().face, side.face);
  }
  std::vector<std::uint32_t> result(mesh.faces.size());
  for (std::uint32_t f = 0; f < result.size(); ++f) result[f] = sets.find(f);
  return result;
}

}  // namespace loft
