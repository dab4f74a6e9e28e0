// SPDX-License-Identifier: MIT
#include "reconstruct/tile/tip_tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cdt/regions.h"
#include "reconstruct/tile/tip_sheet.h"

namespace loft {

namespace {

using cdt::Point;

class TipTiling {
 public:
  TipTiling(const Region& lower, const Region& upper, const TipSheet& sheet)
      : lower_(lower), upper_(upper), sheet_(sheet), is_upwards_(lower.has_loops()) {}

  std::optional<TileSet> run() {
    list_nodes();
    for (const auto& [a, b, c] : sheet_.triangles())
      add({nodes_[a], nodes_[b], nodes_[c]}, FaceKind::sheet);
    for (std::size_t i = 0; i < part().loop_count(); ++i) {
      const auto loop = part().loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k)
        add_wall(part().loop_starts[i] + k, loop[k], loop[(k + 1) % loop.size()]);
    }
    if (std::size_t pairs_left = any_number;
        sheet_.is_doubtful() && tiles_meet(lower_, upper_, tiles_, pairs_left))
      return {};
    return std::move(tiles_);
  }

 private:
  [[nodiscard]] const Region& part() const { return is_upwards_ ? lower_ : upper_; }
  [[nodiscard]] const Region& tips() const { return is_upwards_ ? upper_ : lower_; }
  [[nodiscard]] std::uint32_t lower_count() const {
    return static_cast<std::uint32_t>(lower_.points.size());
  }
  [[nodiscard]] std::uint32_t contour_count() const {
    return lower_count() + static_cast<std::uint32_t>(upper_.points.size());
  }
  [[nodiscard]] std::uint32_t outline_node(std::uint32_t point) const {
    return is_upwards_ ? point : lower_count() + point;
  }
  [[nodiscard]] std::uint32_t tip_node(std::uint32_t point) const {
    return is_upwards_ ? lower_count() + point : point;
  }

  void list_nodes() {
    for (const TipSheet::Vertex& v : sheet_.vertices()) {
      if (v.tip != TipSheet::none) {
        nodes_.push_back(tip_node(v.tip));
      } else if (v.outline != TipSheet::none) {
        nodes_.push_back(outline_node(v.outline));
      } else {
        nodes_.push_back(contour_count() + static_cast<std::uint32_t>(tiles_.inner.size()));
        const double share = is_upwards_ ? v.share : 1 - v.share;
        const double z = lower_.z + share * (upper_.z - lower_.z);
        tiles_.inner.push_back({{v.place.x, v.place.y, z}, VertexKind::steiner});
      }
    }
  }

  /// Corners are given as if the part were the lower one.
  void add(std::array<std::uint32_t, 3> corners, FaceKind kind) {
    if (!is_upwards_) std::swap(corners[0], corners[1]);
    tiles_.tiles.push_back({corners, kind});
  }

  /// Between an edge of the part and what the sheet has along it: as Tiling::add_wall().
  void add_wall(std::size_t loop_vertex, std::uint32_t from, std::uint32_t to) {
    const std::vector<std::uint32_t> roof = sheet_.along(loop_vertex);
    const std::uint32_t first = outline_node(from);
    const std::uint32_t last = outline_node(to);
    if (roof.size() == 2 && nodes_[roof[0]] == first && nodes_[roof[1]] == last) return;
    polygon_ = {first, last};
    flat_ = {{0, 0}, {1, 0}};
    const Point p = part().points[from];
    const Point q = part().points[to];
    const double length = std::hypot(q.x - p.x, q.y - p.y);
    for (auto v = roof.rbegin(); v != roof.rend(); ++v) {
      if (nodes_[*v] == first || nodes_[*v] == last) continue;
      const TipSheet::Vertex& vertex = sheet_.vertices()[*v];
      const double way = v == roof.rbegin() ? 1
                         : v == roof.rend() - 1
                             ? 0
                             : std::hypot(vertex.place.x - p.x, vertex.place.y - p.y) / length;
      polygon_.push_back(nodes_[*v]);
      flat_.push_back({way, vertex.tip != TipSheet::none ? 1 : vertex.share});
    }
    fill_polygon();
  }

  /// The constrained Delaunay triangulation of polygon_.
  void fill_polygon() {
    if (polygon_.size() == 3) return add({polygon_[0], polygon_[1], polygon_[2]}, FaceKind::wall);
    wall_.clear();
    const auto ring = wall_.insert(flat_, cdt::closed);
    std::vector<std::uint32_t> corner(wall_.vertex_bound(), TipSheet::none);
    const auto segments = wall_.segments(ring);
    for (std::size_t i = 0; i < segments.size(); ++i)
      corner[segments[i].from.index()] = polygon_[i];
    const auto is_inside = cdt::odd_parity(wall_);
    for (std::uint32_t t = 0; t < wall_.triangle_bound(); ++t) {
      if (!is_inside[t]) continue;
      const cdt::EdgeId e = cdt::Triangulation::edge(cdt::TriangleId(t));
      add({corner[wall_.from(e).index()], corner[wall_.to(e).index()],
           corner[wall_.apex(e).index()]},
          FaceKind::wall);
    }
  }

  const Region& lower_;
  const Region& upper_;
  const TipSheet& sheet_;
  bool is_upwards_;  // the part is the lower one
  TileSet tiles_;
  std::vector<std::uint32_t> nodes_;  // of each vertex of the sheet

  // Of the wall at hand.
  std::vector<std::uint32_t> polygon_;
  std::vector<Point> flat_;
  cdt::Triangulation wall_;
};

}  // namespace

std::optional<TipTiles> tile_tip(const Region& lower, const Region& upper, double contact) {
  const Region& part = lower.has_loops() ? lower : upper;
  const Region& tips = lower.has_loops() ? upper : lower;
  for (const double within : {contact, 0.0}) {
    const auto sheet = TipSheet::make(part, tips, within);
    if (!sheet) continue;
    if (auto tiles = TipTiling(lower, upper, *sheet).run())
      return TipTiles{std::move(*tiles), sheet->covered()};
  }
  return {};
}

}  // namespace loft
