// SPDX-License-Identifier: MIT
#include "overlay/coverage.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "cdt/each_once.h"
#include "overlay/components.h"
#include "overlay/distance.h"
#include "overlay/inscribed.h"
#include "overlay/layer_traces.h"
#include "overlay/trace.h"

namespace loft::overlay {

using cdt::TriangleId;
using cdt::Triangulation;

namespace {

/// Every triangle's layers.
class Claims {
 public:
  explicit Claims(const Overlay& overlay) : overlay_(&overlay), covers_(overlay.covers()) {}

  [[nodiscard]] std::span<const LayerId> of(TriangleId t) const {
    return overlay_->layers(covers_[t.index()]);
  }
  [[nodiscard]] std::span<const LayerId> beyond(EdgeId e) const {
    return of(Triangulation::triangle(overlay_->triangulation().twin(e)));
  }

 private:
  const Overlay* overlay_;
  std::span<const CoverId> covers_;
};

/// Where not just one layer is: overlaps by who claims them, and gaps; each joined part a
/// component. What is joined to infinity is no gap.
class FaultyPlaces {
 public:
  explicit FaultyPlaces(const Overlay& overlay)
      : mesh_(&overlay.triangulation()),
        covers_(overlay.covers()),
        parts_(
            *mesh_, [&](TriangleId t) { return overlay.layers(covers_[t.index()]).size() != 1; },
            [&](EdgeId e) { return cover_left_of(e) != cover_left_of(mesh_->twin(e)); }) {
    if (mesh_->triangle_count() != 0)
      outside_ = parts_[Triangulation::triangle(mesh_->edge(Triangulation::infinite))];
  }

  /// Their outlines. Sorted.
  [[nodiscard]] std::vector<TracedPolygon> outlines() const {
    std::vector<std::uint32_t> region_of(parts_.count() + 1);
    std::iota(region_of.begin(), region_of.end(), 0U);
    region_of[outside_] = 0;
    Regions regions = parts_.regions();
    regions.region_of = region_of;
    return trace(regions, borders(regions));
  }

  [[nodiscard]] std::uint32_t count() const { return parts_.count(); }
  /// 0 where it is none, or outside of the map.
  [[nodiscard]] std::uint32_t at(TriangleId t) const {
    const std::uint32_t part = parts_[t];
    return part == outside_ ? 0 : part;
  }

 private:
  [[nodiscard]] CoverId cover_left_of(EdgeId e) const {
    return covers_[Triangulation::triangle(e).index()];
  }

  const Triangulation* mesh_;
  std::span<const CoverId> covers_;
  Components parts_;
  std::uint32_t outside_ = 0;
};

/// Calls visit(edge) for the edges of a polygon's rings, in order.
template <class Visit>
void for_each_edge(const TracedPolygon& polygon, Visit visit) {
  for (const EdgeId e : polygon.outer) visit(e);
  for (const TracedRing& hole : polygon.holes)
    for (const EdgeId e : hole) visit(e);
}

/// The layers beyond a polygon's border.
std::vector<LayerId> layers_around(const Claims& claims, const TracedPolygon& polygon) {
  std::vector<LayerId> result;
  for_each_edge(polygon, [&](EdgeId e) {
    const auto there = claims.beyond(e);
    result.insert(result.end(), there.begin(), there.end());
  });
  cdt::keep_each_once(result);
  return result;
}

}  // namespace

CoverageFaults check_coverage(const Overlay& overlay) {
  const Claims claims(overlay);
  CoverageFaults faults;
  for (const TracedPolygon& traced : FaultyPlaces(overlay).outlines()) {
    const auto claimants = claims.of(Triangulation::triangle(traced.outer.front()));
    CoverageFault fault;
    fault.polygon = points_of(overlay.triangulation(), traced, true);
    fault.area = area(fault.polygon);
    fault.width = inscribed_diameter(fault.polygon, width_precision);
    const bool is_gap = claimants.empty();
    fault.layers = is_gap ? layers_around(claims, traced)
                          : std::vector<LayerId>(claimants.begin(), claimants.end());
    (is_gap ? faults.gaps : faults.overlaps).push_back(std::move(fault));
  }
  return faults;
}

namespace {

/// Gives every faulty place to one layer.
class Cleaner {
 public:
  Cleaner(const Overlay& overlay, const CleanOptions& options)
      : overlay_(&overlay),
        mesh_(&overlay.triangulation()),
        claims_(overlay),
        options_(&options),
        places_(overlay),
        heirs_(places_.count() + 1) {}

  /// Overlaps first, so that gaps between them find owners around.
  std::vector<MultiPolygon> cleaned() {
    const std::vector<TracedPolygon> outlines = places_.outlines();
    for (const bool are_gaps : {false, true})
      for (const TracedPolygon& outline : outlines)
        if (is_gap(outline) == are_gaps) heirs_[outline.region] = heir_of(outline);
    return polygons_by_owner();
  }

 private:
  [[nodiscard]] bool is_gap(const TracedPolygon& outline) const {
    return claims_.of(Triangulation::triangle(outline.outer.front())).empty();
  }

  /// Who owns a triangle, as far as that has been settled.
  [[nodiscard]] LayerId owner(TriangleId t) const {
    if (const std::uint32_t place = places_.at(t); place != 0) return heirs_[place];
    const auto claimants = claims_.of(t);
    return claimants.size() == 1 ? claimants.front() : LayerId::none();
  }

  [[nodiscard]] LayerId heir_of(const TracedPolygon& outline) const {
    if (!is_gap(outline)) {
      const auto claimants = claims_.of(Triangulation::triangle(outline.outer.front()));
      const LayerId heir = best_around(outline, claimants);
      return heir.is_none() ? claimants.front() : heir;
    }
    const Polygon polygon = points_of(*mesh_, outline, true);
    if (inscribed_diameter(polygon, width_precision) >= options_->gap_width) return {};
    return best_around(outline, {});
  }

  /// Who is beyond the border, of some, or of all if these are none; none if no one is.
  [[nodiscard]] LayerId best_around(const TracedPolygon& outline,
                                    std::span<const LayerId> some) const {
    std::map<LayerId, double> lengths;
    for_each_edge(outline, [&](EdgeId e) {
      const LayerId beyond = owner(Triangulation::triangle(mesh_->twin(e)));
      if (beyond.is_none()) return;
      if (!some.empty() && !std::ranges::binary_search(some, beyond)) return;
      lengths[beyond] += distance(mesh_->point(mesh_->from(e)), mesh_->point(mesh_->to(e)));
    });
    if (lengths.empty()) return {};
    if (options_->heir == Heir::first) return lengths.begin()->first;
    return std::ranges::max_element(lengths, {}, [](const auto& one) { return one.second; })->first;
  }

  [[nodiscard]] std::vector<MultiPolygon> polygons_by_owner() const {
    std::vector<CoverId> marks(mesh_->triangle_bound(), CoverId(0));
    for (std::uint32_t i = 0; i < marks.size(); ++i) {
      if (!mesh_->is_triangle(TriangleId(i))) continue;
      const LayerId one = owner(TriangleId(i));
      if (!one.is_none()) marks[i] = CoverId(one.index() + 1);
    }
    std::vector<std::uint32_t> region_of(overlay_->layer_count() + 1);
    std::iota(region_of.begin(), region_of.end(), 0U);
    const Regions regions{.mesh = mesh_, .covers = marks, .region_of = region_of};
    std::vector<MultiPolygon> result(overlay_->layer_count());
    for (const TracedPolygon& traced : trace(regions, borders(regions)))
      result[traced.region - 1].push_back(points_of(*mesh_, traced, false));
    return result;
  }

  const Overlay* overlay_;
  const Triangulation* mesh_;
  Claims claims_;
  const CleanOptions* options_;
  FaultyPlaces places_;
  std::vector<LayerId> heirs_;  // by place
};

}  // namespace

std::vector<MultiPolygon> clean_coverage(const Overlay& overlay, const CleanOptions& options) {
  return Cleaner(overlay, options).cleaned();
}

namespace {

/// Whether one layer is on the left of an edge and another on its right, and neither on both sides.
bool divides(const Claims& claims, EdgeId e, LayerId left, LayerId right) {
  const auto here = claims.of(Triangulation::triangle(e));
  const auto there = claims.beyond(e);
  const auto has = [](std::span<const LayerId> layers, LayerId layer) {
    return std::ranges::binary_search(layers, layer);
  };
  return has(here, left) && !has(there, left) && has(there, right) && !has(here, right);
}

/// The stretches of a ring whose edges are wanted, each as points; one that is wanted all around
/// ends where it begins.
template <class IsWanted>
void append_stretches(const Triangulation& mesh, TracedRing ring, IsWanted is_wanted,
                      std::vector<std::vector<Point>>& stretches) {
  const auto first_not = std::ranges::find_if_not(ring, is_wanted);
  if (first_not != ring.end()) std::rotate(ring.begin(), first_not, ring.end());
  bool goes_on = false;
  for (const EdgeId e : ring) {
    const bool wanted = is_wanted(e);
    if (wanted && !goes_on) stretches.push_back({mesh.point(mesh.from(e))});
    if (wanted) stretches.back().push_back(mesh.point(mesh.to(e)));
    goes_on = wanted;
  }
}

}  // namespace

SharedBorder shared_border(const Overlay& overlay, LayerId a, LayerId b) {
  const Claims claims(overlay);
  const Triangulation& mesh = overlay.triangulation();
  SharedBorder border;
  for (const TracedPolygon& polygon : layer_traces(overlay, a)) {
    const auto is_shared = [&](EdgeId e) { return divides(claims, e, a, b); };
    append_stretches(mesh, polygon.outer, is_shared, border.lines);
    for (const TracedRing& hole : polygon.holes)
      append_stretches(mesh, hole, is_shared, border.lines);
  }
  for (const auto& line : border.lines)
    for (std::size_t i = 1; i < line.size(); ++i) border.length += distance(line[i - 1], line[i]);
  return border;
}

std::vector<Neighbour> neighbours(const Overlay& overlay, LayerId layer) {
  const Claims claims(overlay);
  const Triangulation& mesh = overlay.triangulation();
  std::map<LayerId, double> lengths;
  for (const TracedPolygon& polygon : layer_traces(overlay, layer))
    for_each_edge(polygon, [&](EdgeId e) {
      for (const LayerId other : claims.beyond(e))
        if (divides(claims, e, layer, other))
          lengths[other] += distance(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
    });
  std::vector<Neighbour> result;
  for (const auto& [other, length] : lengths) result.push_back({other, length});
  return result;
}

}  // namespace loft::overlay
