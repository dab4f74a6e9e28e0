// SPDX-License-Identifier: MIT
#include "reconstruct/shape/refine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "mesh/triangle_shape.h"
#include "mesh/vec3.h"
#include "reconstruct/shape/split_edges.h"
#include "reconstruct/shape/tile_mesh.h"

namespace loft {

namespace {

using Nodes = TileMesh::Nodes;
using Edge = TileMesh::Edge;
using EdgeTile = TileMesh::EdgeTile;

/// Edges longer than that, in target lengths, are split, shorter ones collapsed: what comes of it
/// is then nearer to the target (Botsch and Kobbelt, 2004).
constexpr double most_of_target = 4.0 / 3;
constexpr double least_of_target = 4.0 / 5;

/// The most that a triangle may turn, in radians: 10 degrees. With 15 the surface moved by twice as
/// much, for angles that were hardly better; with 5 they were worse.
constexpr double most_turn_of_faces = 0.175;

/// A collapse may leave no worse angle than it finds, or than this sine: 20 degrees.
constexpr double good_sine = 0.34;

/// Each step makes room for others: that often all are tried. After five rounds little changes.
constexpr int most_passes = 5;

/// Brings edges near a length, by one round of steps or more.
class Evening {
 public:
  /// `turn`: the most that a triangle may turn, in radians.
  Evening(TileMesh& mesh, double length, double turn)
      : mesh_(mesh),
        length_(length),
        most_(most_of_target * length),
        squared_most_(most_ * most_),
        least_cosine_(std::cos(turn)) {}

  /// Whether anything but places has changed.
  bool run() {
    const bool is_split = split_edges(mesh_, most_);
    const bool is_collapsed = collapse_edges();
    const bool is_flipped = flip_edges();
    relax_nodes();
    return is_split || is_collapsed || is_flipped;
  }

 private:
  // --- What triangles in the place of others must be like ---

  [[nodiscard]] double worst_sine(std::span<const Nodes> triangles) const {
    double worst = 1;
    for (const Nodes& nodes : triangles)
      worst = std::min(worst, smallest_sine(mesh_.places(nodes)));
    return worst;
  }

  /// From corners in a fixed order: not even rounding depends on the numbers.
  [[nodiscard]] Vec3 normal(const Nodes& nodes) const {
    Corners corners = mesh_.places(nodes);
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    const auto& [a, b, c] = corners;
    return cross(minus(b, a), minus(c, a));
  }

  [[nodiscard]] bool are_alike(const Vec3& a, const Vec3& b) const {
    return dot(a, b) >= least_cosine_ * std::sqrt(squared_length(a) * squared_length(b));
  }

  // --- Collapses ---

  /// Collapses short edges, shortest first, into one end where the other is an added node.
  bool collapse_edges() {
    std::vector<Edge> edges = mesh_.inner_edges();
    const double squared_least = std::pow(least_of_target * length_, 2);
    std::erase_if(edges, [=](const Edge& e) { return e.squared_length >= squared_least; });
    std::ranges::sort(edges,
                      [this](const Edge& a, const Edge& b) { return mesh_.is_longer(b, a); });
    bool is_changed = false;
    for (const Edge& edge : edges)
      if (collapse(edge.from, edge.to) || collapse(edge.to, edge.from)) is_changed = true;
    if (is_changed) mesh_.compact();
    return is_changed;
  }

  /// Moves an added node into a neighbour: the two tiles at the edge between them vanish.
  bool collapse(std::uint32_t node, std::uint32_t target) {
    if (!find_fan(node) || !may_join(target) || !make_triangles(node, target)) return false;
    if (worst_sine(triangles_) < std::min(worst_sine(old_triangles_), good_sine) ||
        !mesh_.meet_nothing(triangles_, sides_))
      return false;
    std::size_t next = 0;
    for (const EdgeTile& side : sides_) {
      if (has(mesh_.tile(side.tile).nodes, target))
        mesh_.remove(side.tile);
      else
        mesh_.replace(side.tile, triangles_[next++]);
    }
    return true;
  }

  /// Finds the tiles at an added node and, in order, the nodes around it; whether they are one
  /// closed fan.
  bool find_fan(std::uint32_t node) {
    sides_.clear();
    link_.clear();
    if (!mesh_.is_added(node)) return false;
    const auto tiles = mesh_.tiles_at(node);
    if (tiles.size() < 3) return false;
    const auto across = [&](std::uint32_t tile) {  // the edge opposite to the node
      const Nodes& n = mesh_.tile(tile).nodes;
      const unsigned i = n[0] == node ? 0 : n[1] == node ? 1 : 2;
      return std::pair{n[(i + 1) % 3], n[(i + 2) % 3]};
    };
    std::uint32_t next = across(tiles.front()).first;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const auto found =
          std::ranges::find_if(tiles, [&](auto tile) { return across(tile).first == next; });
      if (found == tiles.end() || std::ranges::find(link_, next) != link_.end()) return false;
      link_.push_back(next);
      next = across(*found).second;
      sides_.push_back({*found, next});
    }
    if (next != link_.front()) return false;
    start_at_smallest();
    return true;
  }

  /// Sums over the fan are rounded in one order, whatever the numbers.
  void start_at_smallest() {
    const auto place = [this](std::uint32_t node) { return mesh_.place(node); };
    const auto turn = std::ranges::min_element(link_, {}, place) - link_.begin();
    std::rotate(link_.begin(), link_.begin() + turn, link_.end());
    std::rotate(sides_.begin(), sides_.begin() + turn, sides_.end());
  }

  /// Whether a node of the link can be joined with all others in it: by edges that are new (the
  /// link condition), not too long, and not in a slice plane.
  [[nodiscard]] bool may_join(std::uint32_t target) const {
    const std::size_t n = link_.size();
    const auto at = static_cast<std::size_t>(std::ranges::find(link_, target) - link_.begin());
    if (at == n || n == 3) return false;
    for (std::size_t i = 2; i + 1 < n; ++i) {
      const std::uint32_t other = link_[(at + i) % n];
      if (mesh_.in_one_slice(target, other) || mesh_.are_joined(target, other) ||
          mesh_.edge(target, other).squared_length > squared_most_)
        return false;
    }
    return true;
  }

  /// The triangles at the node, and those that come of them when it moves into a neighbour. Whether
  /// none turns too far.
  bool make_triangles(std::uint32_t node, std::uint32_t target) {
    old_triangles_.clear();
    triangles_.clear();
    for (const EdgeTile& side : sides_) {
      Nodes nodes = mesh_.tile(side.tile).nodes;
      old_triangles_.push_back(nodes);
      if (has(nodes, target)) continue;
      const Vec3 old_normal = normal(nodes);
      std::ranges::replace(nodes, node, target);
      if (!are_alike(old_normal, normal(nodes))) return false;
      triangles_.push_back(nodes);
    }
    return true;
  }

  [[nodiscard]] static bool has(const Nodes& nodes, std::uint32_t node) {
    return std::ranges::find(nodes, node) != nodes.end();
  }

  // --- Flips ---

  /// Flips edges for better angles until none is left to flip, longest first. Each flip makes the
  /// smallest angle of two triangles larger, so this ends.
  bool flip_edges() {
    doubtful_ = mesh_.inner_edges();
    std::ranges::sort(doubtful_,
                      [this](const Edge& a, const Edge& b) { return mesh_.is_longer(b, a); });
    bool is_changed = false;
    while (!doubtful_.empty()) {
      const Edge edge = doubtful_.back();
      doubtful_.pop_back();
      if (flip(edge)) is_changed = true;
    }
    return is_changed;
  }

  /// Puts the other diagonal of two tiles in the place of an edge.
  bool flip(const Edge& e) {
    mesh_.find_tiles(e, sides_);
    if (sides_.size() != 2 || mesh_.tile(sides_[0].tile).kind != mesh_.tile(sides_[1].tile).kind)
      return false;
    if (!runs_along(sides_[0].tile, e)) std::swap(sides_[0], sides_[1]);
    const std::uint32_t left = sides_[0].apex;
    const std::uint32_t right = sides_[1].apex;
    if (left == right || mesh_.in_one_slice(left, right)) return false;
    const double squared = mesh_.edge(left, right).squared_length;
    if (squared > squared_most_ && squared >= e.squared_length) return false;
    old_triangles_ = {{e.from, e.to, left}, {e.to, e.from, right}};
    triangles_ = {{left, right, e.to}, {right, left, e.from}};
    if (!(worst_sine(triangles_) > worst_sine(old_triangles_)) || !is_flat() ||
        mesh_.are_joined(left, right) || !mesh_.meet_nothing(triangles_, sides_))
      return false;
    for (std::size_t i = 0; i < 2; ++i) mesh_.replace(sides_[i].tile, triangles_[i]);
    for (const std::uint32_t end : {e.from, e.to})
      for (const std::uint32_t apex : {left, right})
        if (!mesh_.in_one_slice(end, apex)) doubtful_.push_back(mesh_.edge(end, apex));
    return true;
  }

  /// Whether a tile at an edge runs from its start to its end.
  [[nodiscard]] bool runs_along(std::uint32_t tile, const Edge& e) const {
    const Nodes& nodes = mesh_.tile(tile).nodes;
    const auto from = static_cast<std::size_t>(std::ranges::find(nodes, e.from) - nodes.begin());
    return nodes[(from + 1) % 3] == e.to;
  }

  /// Whether the two triangles, before and after, nearly lie in one plane.
  [[nodiscard]] bool is_flat() const {
    const std::array normals{normal(old_triangles_[0]), normal(old_triangles_[1]),
                             normal(triangles_[0]), normal(triangles_[1])};
    for (std::size_t i = 0; i < normals.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!are_alike(normals[i], normals[j])) return false;
    return true;
  }

  // --- Moves ---

  /// Moves each added node to the middle of its neighbours, along the surface, where that makes the
  /// smallest angle at it larger and no edge too long.
  void relax_nodes() {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t node = 0; node < mesh_.node_count(); ++node)
      if (mesh_.is_added(node)) nodes.push_back(node);
    std::ranges::sort(nodes, {}, [this](std::uint32_t node) { return mesh_.place(node); });
    for (const std::uint32_t node : nodes) relax(node);
  }

  void relax(std::uint32_t node) {
    if (!find_fan(node)) return;
    triangles_.clear();
    normals_.clear();
    for (const EdgeTile& side : sides_) {
      triangles_.push_back(mesh_.tile(side.tile).nodes);
      normals_.push_back(normal(triangles_.back()));
    }
    const double old_sine = worst_sine(triangles_);
    const Vec3 old_place = mesh_.place(node);
    const Vec3 new_place = middle_of_link(old_place);
    if (!mesh_.is_between_slices(new_place) || !keeps_lengths(old_place, new_place)) return;
    mesh_.move(node, new_place);
    if (worst_sine(triangles_) > old_sine && keeps_normals() &&
        mesh_.meet_nothing(triangles_, sides_))
      mesh_.note_move(node);
    else
      mesh_.move(node, old_place);
  }

  /// The middle of the nodes around a place, in the plane through it across the mean normal.
  [[nodiscard]] Vec3 middle_of_link(const Vec3& from) const {
    Vec3 way{};
    for (const std::uint32_t other : link_)
      for (std::size_t axis = 0; axis < 3; ++axis)
        way[axis] += (mesh_.place(other)[axis] - from[axis]) / static_cast<double>(link_.size());
    Vec3 mean{};
    for (const Vec3& n : normals_)
      for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += n[axis];
    const double share = dot(way, mean) / squared_length(mean);
    return {from[0] + way[0] - share * mean[0], from[1] + way[1] - share * mean[1],
            from[2] + way[2] - share * mean[2]};
  }

  /// Whether no edge to the nodes around gets longer than allowed, or than it was.
  [[nodiscard]] bool keeps_lengths(const Vec3& from, const Vec3& to) const {
    return std::ranges::all_of(link_, [&](std::uint32_t other) {
      const double squared = squared_length(minus(mesh_.place(other), to));
      return squared <= squared_most_ || squared <= squared_length(minus(mesh_.place(other), from));
    });
  }

  /// Whether none of the triangles has turned too far from its normal before.
  [[nodiscard]] bool keeps_normals() const {
    for (std::size_t i = 0; i < normals_.size(); ++i)
      if (!are_alike(normals_[i], normal(triangles_[i]))) return false;
    return true;
  }

  TileMesh& mesh_;
  double length_;
  double most_;  // length of an edge
  double squared_most_;
  double least_cosine_;
  std::vector<Edge> doubtful_;  // edges that may be flipped, the next one last

  // Of the edge or node at hand.
  std::vector<EdgeTile> sides_;       // the tiles at it
  std::vector<std::uint32_t> link_;   // the nodes around it
  std::vector<Nodes> old_triangles_;  // what the tiles are
  std::vector<Nodes> triangles_;      // what they would become
  std::vector<Vec3> normals_;         // of the tiles before a move
};

double longest_inner_edge(const TileMesh& mesh) {
  double squared = 0;
  for (const Edge& edge : mesh.inner_edges()) squared = std::max(squared, edge.squared_length);
  return std::sqrt(squared);
}

}  // namespace

TileSet split_long_edges(const Region& lower, const Region& upper, TileSet tiles, double max_edge) {
  assert(max_edge > 0);
  TileMesh mesh(lower, upper, tiles);
  check_size(mesh, max_edge);
  split_edges(mesh, max_edge);
  return tiles;
}

/// From coarse to fine: long thin tiles have to become few and wide before they are cut across, or
/// the rows of vertices would be too dense to be thinned out later. What is done to twice the
/// length may turn triangles by half the angle only, as it moves the surface by as much.
TileSet even_out_edges(const Region& lower, const Region& upper, TileSet tiles,
                       double target_edge) {
  assert(target_edge > 0);
  TileMesh mesh(lower, upper, tiles);
  check_size(mesh, target_edge);
  double scale = 1;
  for (const double longest = longest_inner_edge(mesh); 2 * scale * target_edge < longest;)
    scale *= 2;
  for (; scale > 1; scale /= 2)
    Evening(mesh, scale * target_edge, most_turn_of_faces / scale).run();
  Evening last(mesh, target_edge, most_turn_of_faces);
  for (int round = 0; round < most_passes && last.run(); ++round) {
  }
  return tiles;
}

TileSet refine(const Region& lower, const Region& upper, TileSet tiles, const Options& options) {
  if (options.max_edge) return split_long_edges(lower, upper, std::move(tiles), *options.max_edge);
  if (options.target_edge)
    return even_out_edges(lower, upper, std::move(tiles), *options.target_edge);
  return tiles;
}

}  // namespace loft
