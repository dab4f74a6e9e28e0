// SPDX-License-Identifier: MIT
#include "reconstruct/shape/tile_mesh.h"

#include <algorithm>
#include <utility>

#include "mesh/vec3.h"

namespace loft {

namespace {

bool has(const TileMesh::Nodes& nodes, std::uint32_t node) {
  return std::ranges::find(nodes, node) != nodes.end();
}

}  // namespace

TileMesh::TileMesh(const Region& lower, const Region& upper, TileSet& tiles)
    : tiles_(tiles.tiles),
      inner_(tiles.inner),
      lower_(lower),
      upper_(upper),
      lower_count_(static_cast<std::uint32_t>(lower.points.size())),
      contour_count_(lower_count_ + static_cast<std::uint32_t>(upper.points.size())),
      first_added_(contour_count_ + static_cast<std::uint32_t>(inner_.size())) {
  index_tiles();
}

void TileMesh::index_tiles() {
  tiles_at_.assign(contour_count_ + inner_.size(), {});
  for (std::uint32_t t = 0; t < tiles_.size(); ++t)
    for (const std::uint32_t node : tiles_[t].nodes) tiles_at_[node].push_back(t);
  build_tree();
}

void TileMesh::build_tree() {
  std::vector<Corners> triangles;
  triangles.reserve(tiles_.size());
  for (const Tile& tile : tiles_) {
    const auto& [a, b, c] = tile.nodes;
    triangles.push_back(places({a == Origin::none ? b : a, b, c}));
  }
  tree_ = TriangleTree(triangles);
  for (std::uint32_t t = 0; t < tiles_.size(); ++t)
    if (is_removed(t)) tree_.remove(t);
  most_notes_ = 2 * tiles_.size();
}

TileMesh::Edge TileMesh::edge(std::uint32_t a, std::uint32_t b) const {
  Vec3 from = place(a);
  Vec3 to = place(b);
  if (to < from) {
    std::swap(a, b);
    std::swap(from, to);
  }
  return {squared_length(minus(to, from)), a, b};
}

bool TileMesh::is_longer(const Edge& a, const Edge& b) const {
  if (a.squared_length != b.squared_length) return a.squared_length > b.squared_length;
  if (a.from != b.from) return place(a.from) < place(b.from);
  return place(a.to) < place(b.to);
}

std::vector<TileMesh::Edge> TileMesh::inner_edges() const {
  std::vector<Edge> edges;
  std::vector<std::uint32_t> ends;
  for (std::uint32_t node = 0; node < node_count(); ++node) {
    ends.clear();
    for (const std::uint32_t tile : tiles_at(node))
      for (const std::uint32_t end : tiles_[tile].nodes)
        if (end > node && !in_one_slice(node, end)) ends.push_back(end);
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const std::uint32_t end : ends) edges.push_back(edge(node, end));
  }
  return edges;
}

void TileMesh::find_tiles(const Edge& edge, std::vector<EdgeTile>& found) const {
  found.clear();
  std::uint32_t a = edge.from;
  std::uint32_t b = edge.to;
  if (tiles_at(b).size() < tiles_at(a).size()) std::swap(a, b);
  for (const std::uint32_t tile : tiles_at(a)) {
    const Nodes& nodes = tiles_[tile].nodes;
    if (!has(nodes, b)) continue;
    const auto apex = std::ranges::find_if(nodes, [=](auto n) { return n != a && n != b; });
    found.push_back({tile, *apex});
  }
}

bool TileMesh::are_joined(std::uint32_t a, std::uint32_t b) const {
  return std::ranges::any_of(tiles_at(a), [&](auto tile) { return has(tiles_[tile].nodes, b); });
}

bool TileMesh::meet_nothing(std::span<const Nodes> triangles, std::span<const EdgeTile> replaced) {
  corners_.clear();
  for (const Nodes& nodes : triangles) {
    const Corners corners = places(nodes);
    if (collinear(corners[0], corners[1], corners[2])) return false;
    for (const Corners& other : corners_)
      if (triangles_meet(corners, other)) return false;
    corners_.push_back(corners);
  }
  const auto is_replaced = [=](std::uint32_t tile) {
    return std::ranges::any_of(replaced, [=](const EdgeTile& r) { return r.tile == tile; });
  };
  hull_.clear();
  for (const Corners& corners : corners_) hull_.insert(hull_.end(), corners.begin(), corners.end());
  return tree_.all_of_meeting(hull_, [&](std::uint32_t tile, const Corners& other) {
    return is_replaced(tile) || std::ranges::none_of(corners_, [&](const Corners& corners) {
             return triangles_meet(corners, other);
           });
  });
}

std::uint32_t TileMesh::add_node(const Vec3& place) {
  inner_.push_back({place, VertexKind::steiner});
  tiles_at_.emplace_back();
  return node_count() - 1;
}

void TileMesh::remove_last_node() {
  inner_.pop_back();
  tiles_at_.pop_back();
}

void TileMesh::move(std::uint32_t node, const Vec3& place) {
  inner_[node - contour_count_].place = place;
}

void TileMesh::note_move(std::uint32_t node) {
  for (const std::uint32_t tile : tiles_at(node)) note(tile);
}

/// Boxes around where a tile was do no harm until there are many.
void TileMesh::note(std::uint32_t tile) {
  if (most_notes_-- == 0)
    build_tree();
  else
    tree_.update(tile, places(tiles_[tile].nodes));
}

void TileMesh::add(const Nodes& nodes, std::uint32_t near) {
  const auto tile = static_cast<std::uint32_t>(tiles_.size());
  tiles_.push_back({nodes, tiles_[near].kind});
  for (const std::uint32_t node : nodes) tiles_at_[node].push_back(tile);
  if (most_notes_-- == 0)
    build_tree();
  else
    tree_.add(places(nodes), near);
}

void TileMesh::replace(std::uint32_t tile, const Nodes& nodes) {
  for (const std::uint32_t node : tiles_[tile].nodes) std::erase(tiles_at_[node], tile);
  tiles_[tile].nodes = nodes;
  for (const std::uint32_t node : nodes) tiles_at_[node].push_back(tile);
  note(tile);
}

void TileMesh::remove(std::uint32_t tile) {
  for (const std::uint32_t node : tiles_[tile].nodes) std::erase(tiles_at_[node], tile);
  tiles_[tile].nodes[0] = Origin::none;
  tree_.remove(tile);
}

void TileMesh::compact() {
  std::erase_if(tiles_, [](const Tile& tile) { return tile.nodes[0] == Origin::none; });
  std::vector<std::uint32_t> renumbered(node_count());
  std::uint32_t count = 0;
  for (std::uint32_t node = 0; node < node_count(); ++node) {
    if (is_added(node) && tiles_at(node).empty()) continue;
    if (node >= contour_count_) inner_[count - contour_count_] = inner_[node - contour_count_];
    renumbered[node] = count++;
  }
  inner_.resize(count - contour_count_);
  for (Tile& tile : tiles_)
    for (std::uint32_t& node : tile.nodes) node = renumbered[node];
  index_tiles();
}

}  // namespace loft
