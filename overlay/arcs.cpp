// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <utility>

#include "overlay/coverage.h"
#include "overlay/layer_traces.h"
#include "overlay/trace.h"

namespace loft::overlay {

using cdt::Triangulation;

namespace {

/// Cuts the rings of all layers into arcs, which neighbours share.
class ArcMaker {
 public:
  explicit ArcMaker(const Overlay& overlay)
      : overlay_(&overlay), mesh_(&overlay.triangulation()), numbers_(mesh_->edge_bound(), none) {
    count_borders();
    for (std::uint32_t l = 0; l < overlay.layer_count(); ++l) make_layer(LayerId(l));
  }

  [[nodiscard]] Topology finished() { return std::move(topology_); }

 private:
  static constexpr Topology::ArcNumber none = std::numeric_limits<Topology::ArcNumber>::min();

  [[nodiscard]] bool is_border(EdgeId e) const {
    const auto covers = overlay_->covers();
    return mesh_->is_constrained(e) && covers[Triangulation::triangle(e).index()] !=
                                           covers[Triangulation::triangle(mesh_->twin(e)).index()];
  }

  void count_borders() {
    degree_.assign(mesh_->vertex_bound(), 0);
    for (std::uint32_t i = 0; i < mesh_->edge_bound(); ++i)
      if (is_border(EdgeId(i))) ++degree_[mesh_->from(EdgeId(i)).index()];
  }

  /// Whether arcs end at the vertex that an edge starts from.
  [[nodiscard]] bool is_end(EdgeId e) const { return degree_[mesh_->from(e).index()] != 2; }

  void make_layer(LayerId layer) {
    auto& polygons = topology_.layers.emplace_back();
    for (const TracedPolygon& traced : layer_traces(*overlay_, layer)) {
      auto& rings = polygons.emplace_back();
      rings.push_back(arcs_of(traced.outer));
      for (const TracedRing& hole : traced.holes) rings.push_back(arcs_of(hole));
    }
  }

  Topology::ArcRing arcs_of(TracedRing ring) {
    if (const auto end = std::ranges::find_if(ring, [&](EdgeId e) { return is_end(e); });
        end != ring.end())
      std::rotate(ring.begin(), end, ring.end());
    Topology::ArcRing result;
    for (std::size_t first = 0; first < ring.size();) {
      std::size_t last = first + 1;
      while (last < ring.size() && !is_end(ring[last])) ++last;
      result.push_back(arc_of(std::span(ring).subspan(first, last - first)));
      first = last;
    }
    return result;
  }

  /// The arc of some edges: known from the other side, or from a layer that has the same, or new.
  Topology::ArcNumber arc_of(std::span<const EdgeId> edges) {
    if (const auto known = numbers_[edges.front().index()]; known != none) return known;
    const auto number = static_cast<Topology::ArcNumber>(topology_.arcs.size());
    auto& points = topology_.arcs.emplace_back();
    points.push_back(mesh_->point(mesh_->from(edges.front())));
    for (const EdgeId e : edges) {
      points.push_back(mesh_->point(mesh_->to(e)));
      numbers_[e.index()] = number;
      numbers_[mesh_->twin(e).index()] = ~number;
    }
    return number;
  }

  const Overlay* overlay_;
  const Triangulation* mesh_;
  std::vector<Topology::ArcNumber> numbers_;  // by edge
  std::vector<std::uint32_t> degree_;         // by vertex: border edges there
  Topology topology_;
};

}  // namespace

Topology arcs(const Overlay& overlay) { return ArcMaker(overlay).finished(); }

MultiPolygon polygons(const Topology& topology, LayerId layer) {
  MultiPolygon result;
  for (const auto& rings : topology.layers[layer.index()]) {
    Polygon& polygon = result.emplace_back();
    for (const Topology::ArcRing& numbers : rings) {
      Ring ring;
      for (const Topology::ArcNumber number : numbers) {
        std::vector<Point> points =
            topology.arcs[static_cast<std::size_t>(number < 0 ? ~number : number)];
        if (number < 0) std::ranges::reverse(points);
        ring.insert(ring.end(), points.begin(), points.end() - 1);
      }
      std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
      if (polygon.outer.empty())
        polygon.outer = std::move(ring);
      else
        polygon.holes.push_back(std::move(ring));
    }
  }
  return result;
}

}  // namespace loft::overlay
