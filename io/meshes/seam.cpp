// SPDX-License-Identifier: MIT
#include "io/meshes/seam.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "io/meshes/place_hash.h"
#include "mesh/adjacency.h"

namespace loft::io {

namespace {

using Index = std::uint32_t;

/// For each vertex, the first one at the same place.
std::vector<Index> first_at_place(std::span<const Vec3> points) {
  std::unordered_map<Vec3, Index, PlaceHash> seen;
  seen.reserve(points.size());
  std::vector<Index> result;
  result.reserve(points.size());
  for (Index i = 0; i < points.size(); ++i)
    result.push_back(seen.try_emplace(points[i], i).first->second);
  return result;
}

/// A side of a face: its ends, and the key of the line between two places it lies on.
struct Side {
  std::uint64_t line;
  Index from;
  Index to;
};

std::tuple<std::uint64_t, Index, Index> order(const Side& side) {
  return {side.line, side.from, side.to};
}

/// All sides, those on the same line in one run.
std::vector<Side> sides_by(const Mesh& mesh, std::span<const Index> place) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.faces.size());
  for (const auto& face : mesh.faces) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Index from = face[corner];
      const Index to = face[(corner + 1) % 3];
      const auto [low, high] = std::minmax(place[from], place[to]);
      sides.push_back({std::uint64_t{low} << 32 | high, from, to});
    }
  }
  std::ranges::sort(sides, {}, order);
  return sides;
}

/// The sides in a run that no other side of the run meets vertex by vertex.
std::vector<Side> borders(std::span<const Side> run) {
  const auto is_border = [run](const Side& side) {
    return !std::ranges::binary_search(run, std::tuple(side.line, side.to, side.from), {}, order);
  };
  std::vector<Side> result;
  std::ranges::copy_if(run, std::back_inserter(result), is_border);
  return result;
}

/// Joins the ends that lie at the same place, of sides that all lie on one line.
void join_ends(std::span<const Side> sides, std::span<const Index> place, DisjointSets& sets) {
  if (sides.size() < 2) return;
  const Side& first = sides.front();
  if (sides.size() == 2 && place[first.from] == place[sides[1].from]) return;  // side by side
  for (const Side& side : sides.subspan(1)) {
    const bool same_way = place[side.from] == place[first.from];
    sets.unite(first.from, same_way ? side.from : side.to);
    sets.unite(first.to, same_way ? side.to : side.from);
  }
}

Mesh renumbered(const Mesh& mesh, DisjointSets& sets) {
  std::vector<bool> used(mesh.points.size());
  for (const auto& face : mesh.faces) {
    for (const Index corner : face) used[sets.find(corner)] = true;
  }
  Mesh result;
  std::vector<Index> number(mesh.points.size());
  for (Index i = 0; i < mesh.points.size(); ++i) {
    if (!used[i]) continue;
    number[i] = static_cast<Index>(result.points.size());
    result.points.push_back(mesh.points[i]);
  }
  result.faces = mesh.faces;
  for (auto& face : result.faces) {
    for (Index& corner : face) corner = number[sets.find(corner)];
  }
  return result;
}

}  // namespace

Mesh sew_seams(const Mesh& mesh) {
  const std::vector<Index> place = first_at_place(mesh.points);
  const std::vector<Side> sides = sides_by(mesh, place);
  DisjointSets sets(mesh.points.size());
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(),
                                  [&](const Side& side) { return side.line != begin->line; });
    join_ends(borders({begin, end}), place, sets);
    begin = end;
  }
  return renumbered(mesh, sets);
}

}  // namespace loft::io
