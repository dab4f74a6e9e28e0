// SPDX-License-Identifier: MIT
#include "reconstruct/shape/split_edges.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <string>
#include <vector>

#include "cdt/expansion.h"
#include "mesh/vec3.h"
#include "reconstruct/defect.h"

namespace loft {

namespace {

using Nodes = TileMesh::Nodes;
using Edge = TileMesh::Edge;
using EdgeTile = TileMesh::EdgeTile;

/// Larger results are taken for a mistake; in squares of the longest edge.
constexpr double most_area = 0x1p28;

/// Whether a middle is not rounded: then its tiles cover what the old ones did, and nothing new can
/// meet.
bool is_exact(const Vec3& middle, const Vec3& p, const Vec3& q) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto sum = cdt::two_sum(p[axis], q[axis]);
    if (sum.low != 0 || middle[axis] != sum.high / 2) return false;
  }
  return true;
}

class EdgeSplitter {
 public:
  EdgeSplitter(TileMesh& mesh, double longest)
      : mesh_(mesh), squared_longest_(longest * longest), queue_(Shorter{&mesh}) {}

  bool run() {
    for (const Edge& edge : mesh_.inner_edges()) enqueue(edge.from, edge.to);
    bool is_changed = false;
    while (!queue_.empty()) {
      const Edge edge = queue_.top();
      queue_.pop();
      mesh_.find_tiles(edge, sides_);
      if (is_longest(edge) && split(edge)) is_changed = true;
    }
    return is_changed;
  }

 private:
  struct Shorter {
    const TileMesh* mesh;
    bool operator()(const Edge& a, const Edge& b) const { return mesh->is_longer(b, a); }
  };

  void enqueue(std::uint32_t a, std::uint32_t b) {
    const Edge edge = mesh_.edge(a, b);
    if (edge.squared_length > squared_longest_) queue_.push(edge);
  }

  /// Whether no tile at the edge has a longer one. That would have been split before, if it could.
  [[nodiscard]] bool is_longest(const Edge& e) const {
    return std::ranges::all_of(sides_, [&](const EdgeTile& side) {
      return mesh_.is_longer(e, mesh_.edge(e.from, side.apex)) &&
             mesh_.is_longer(e, mesh_.edge(side.apex, e.to));
    });
  }

  /// Puts a node in the middle, and an edge from it to the apex of each tile at the edge.
  bool split(const Edge& edge) {
    const Vec3 p = mesh_.place(edge.from);
    const Vec3 q = mesh_.place(edge.to);
    const Vec3 middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
    if (middle == p || middle == q || !mesh_.is_between_slices(middle)) return false;
    const std::uint32_t node = mesh_.add_node(middle);
    halves_.clear();
    for (const EdgeTile& side : sides_) {
      for (const std::uint32_t end : {edge.from, edge.to}) {
        halves_.push_back(mesh_.tile(side.tile).nodes);
        std::ranges::replace(halves_.back(), end, node);
      }
    }
    if (!is_exact(middle, p, q) && !mesh_.meet_nothing(halves_, sides_)) {
      mesh_.remove_last_node();
      return false;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      mesh_.replace(sides_[i].tile, halves_[2 * i]);
      mesh_.add(halves_[2 * i + 1], sides_[i].tile);
    }
    enqueue(edge.from, node);
    enqueue(node, edge.to);
    for (const EdgeTile& side : sides_) enqueue(node, side.apex);
    return true;
  }

  TileMesh& mesh_;
  double squared_longest_;
  std::priority_queue<Edge, std::vector<Edge>, Shorter> queue_;
  std::vector<EdgeTile> sides_;  // the tiles at the edge at hand
  std::vector<Nodes> halves_;    // the two that each becomes
};

}  // namespace

void check_size(const TileMesh& mesh, double longest) {
  double area = 0;
  for (const Tile& tile : mesh.tiles()) {
    const auto [a, b, c] = mesh.places(tile.nodes);
    area += length(cross(minus(b, a), minus(c, a))) / 2;
  }
  if (area > most_area * longest * longest)
    throw InputError("edges that short would make more than " +
                     std::to_string(static_cast<long long>(most_area)) +
                     " triangles between two slices; choose a larger length");
}

bool split_edges(TileMesh& mesh, double longest) { return EdgeSplitter(mesh, longest).run(); }

}  // namespace loft
