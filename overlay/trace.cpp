// SPDX-License-Identifier: MIT
#include "overlay/trace.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "cdt/predicates.h"
#include "overlay/numbers.h"

namespace loft::overlay {

using cdt::Triangulation;
using cdt::VertexId;

namespace {

/// The walk along each border edge. Few vertices have several such edges that leave them.
class WalkOf {
 public:
  /// Of about as many edges.
  WalkOf(const Triangulation& mesh, std::size_t count)
      : mesh_(&mesh), first_(count, mesh.vertex_bound()) {
    leaving_.reserve(count);
  }

  /// `none` if there is none.
  [[nodiscard]] std::uint32_t find(EdgeId e) const {
    const std::uint32_t first = first_.find(mesh_->from(e).index());
    if (first == Numbers::none) return Numbers::none;
    return leaving_[first].edge == e ? leaving_[first].walk : others_.find(e.index());
  }

  void set(EdgeId e, std::uint32_t walk) {
    const std::size_t vertex = mesh_->from(e).index();
    if (first_.find(vertex) != Numbers::none) return others_.set(e.index(), walk);
    first_.set(vertex, static_cast<std::uint32_t>(leaving_.size()));
    leaving_.push_back({e, walk});
  }

 private:
  struct Leaving {
    EdgeId edge;
    std::uint32_t walk;
  };

  const Triangulation* mesh_;
  Numbers first_;  // by vertex: where in leaving_
  std::vector<Leaving> leaving_;
  FlatMap others_;  // by edge
};

/// Walks along the borders of regions.
class Tracer {
 public:
  /// Along as many edges as that.
  Tracer(const Regions& regions, std::size_t count)
      : regions_(&regions),
        mesh_(regions.mesh),
        walk_of_(*mesh_, count),
        place_of_(count, mesh_->vertex_bound()) {}

  /// Once around from an edge, unless that has been walked. The walk's number, or `none`.
  std::uint32_t walk(EdgeId start) {
    if (walk_of_.find(start) != Numbers::none) return Numbers::none;
    const std::uint32_t number = walk_count_++;
    path_.clear();
    EdgeId e = start;
    const std::uint32_t region = regions_->left_of(start);
    do {
      walk_of_.set(e, number);
      step(e);
      e = next(e, region);
    } while (e != start);
    finish_ring();
    return number;
  }

  /// The simple rings of the last walk. They are given away.
  [[nodiscard]] std::vector<TracedRing> take_rings() { return std::exchange(rings_, {}); }

  [[nodiscard]] bool is_counter_clockwise(const TracedRing& ring) const {
    return cdt::orient(from(ring.back()), from(ring.front()), to(ring.front())) > 0;
  }

  /// The walk that is met first from the smallest point of a walk of holes, to the left of it.
  [[nodiscard]] std::uint32_t walk_left_of(std::span<const TracedRing> holes) const {
    EdgeId e = edge_to_left(holes);
    const std::uint32_t region = regions_->left_of(e);
    while (true) {
      // Around the vertex that e leads to, through the region, either to its border or back.
      const EdgeId back = mesh_->twin(e);
      EdgeId left = back;
      for (EdgeId at = back;;) {
        if (regions_->left_of(at) != region) return walk_of_.find(mesh_->twin(at));
        if (to(at) < to(left)) left = at;
        at = mesh_->rotated(at);
        if (at == back) break;
      }
      e = left;
    }
  }

  [[nodiscard]] Point from(EdgeId e) const { return mesh_->point(mesh_->from(e)); }
  [[nodiscard]] Point to(EdgeId e) const { return mesh_->point(mesh_->to(e)); }

 private:
  /// The border edge that follows, the region between them not left.
  [[nodiscard]] EdgeId next(EdgeId e, std::uint32_t region) const {
    EdgeId result = Triangulation::next(e);
    while (regions_->right_of(result) == region) result = Triangulation::next(mesh_->twin(result));
    return result;
  }

  /// Adds an edge to the walk. Where it starts from a vertex that the walk has left before, what is
  /// between is a ring.
  void step(EdgeId e) {
    const std::size_t vertex = mesh_->from(e).index();
    if (const std::uint32_t first = place_of_.find(vertex); first != Numbers::none) cut_off(first);
    place_of_.set(vertex, static_cast<std::uint32_t>(path_.size()));
    path_.push_back(e);
  }

  void finish_ring() { cut_off(0); }

  void cut_off(std::uint32_t first) {
    for (std::size_t i = first; i < path_.size(); ++i)
      place_of_.erase(mesh_->from(path_[i]).index());
    TracedRing ring(path_.begin() + first, path_.end());
    path_.resize(first);
    const auto smallest = std::ranges::min_element(ring, {}, [&](EdgeId e) { return from(e); });
    std::rotate(ring.begin(), smallest, ring.end());
    rings_.push_back(std::move(ring));
  }

  /// From the smallest point of a walk of holes, an edge through the region to a smaller one.
  [[nodiscard]] EdgeId edge_to_left(std::span<const TracedRing> holes) const {
    const TracedRing* lowest = &holes.front();
    for (const TracedRing& ring : holes)
      if (from(ring.front()) < from(lowest->front())) lowest = &ring;
    const Point place = from(lowest->front());
    // All the walk is to the right of that point, so is all else of the border there: what is to
    // the left of it is region, in one piece.
    EdgeId e = lowest->front();
    while (place < to(e)) e = mesh_->rotated(e);
    return e;
  }

  const Regions* regions_;
  const Triangulation* mesh_;
  std::uint32_t walk_count_ = 0;
  WalkOf walk_of_;
  Numbers place_of_;  // by vertex: where in path_
  std::vector<EdgeId> path_;
  std::vector<TracedRing> rings_;
};

/// Sorts rings into polygons.
class Sorter {
 public:
  /// Of borders of as many edges as that.
  Sorter(const Regions& regions, std::size_t count) : regions_(&regions), tracer_(regions, count) {}

  std::vector<TracedPolygon> polygons(std::span<const BorderEdge> border) {
    for (const BorderEdge& edge : border)
      if (tracer_.walk(edge.edge) != Numbers::none) add_walk(tracer_.take_rings());
    settle_holes();
    for (TracedPolygon& polygon : polygons_)
      std::ranges::sort(polygon.holes,
                        [&](const auto& a, const auto& b) { return is_before(a, b); });
    std::ranges::sort(polygons_,
                      [&](const auto& a, const auto& b) { return is_before(a.outer, b.outer); });
    return std::move(polygons_);
  }

 private:
  struct Holes {
    std::uint32_t walk;
    std::vector<TracedRing> rings;
  };

  [[nodiscard]] bool is_before(const TracedRing& a, const TracedRing& b) const {
    const Point from_a = tracer_.from(a.front());
    const Point from_b = tracer_.from(b.front());
    return from_a != from_b ? from_a < from_b : tracer_.to(a.front()) < tracer_.to(b.front());
  }

  void add_walk(std::vector<TracedRing> rings) {
    const auto walk = static_cast<std::uint32_t>(polygon_of_.size());
    const auto outer = std::ranges::find_if(
        rings, [&](const TracedRing& ring) { return tracer_.is_counter_clockwise(ring); });
    if (outer == rings.end()) {
      polygon_of_.push_back(Numbers::none);
      holes_.push_back({walk, std::move(rings)});
      return;
    }
    polygon_of_.push_back(static_cast<std::uint32_t>(polygons_.size()));
    TracedPolygon polygon{
        .region = regions_->left_of(outer->front()), .outer = std::move(*outer), .holes = {}};
    rings.erase(outer);
    polygon.holes = std::move(rings);
    polygons_.push_back(std::move(polygon));
  }

  /// From left to right: what is met on the left of holes has its polygon already.
  void settle_holes() {
    const auto smallest = [&](const Holes& holes) {
      Point result = tracer_.from(holes.rings.front().front());
      for (const TracedRing& ring : holes.rings)
        result = std::min(result, tracer_.from(ring.front()));
      return result;
    };
    std::ranges::sort(holes_, {}, smallest);
    for (Holes& holes : holes_) {
      const std::uint32_t polygon = polygon_of_[tracer_.walk_left_of(holes.rings)];
      polygon_of_[holes.walk] = polygon;
      std::ranges::move(holes.rings, std::back_inserter(polygons_[polygon].holes));
    }
  }

  const Regions* regions_;
  Tracer tracer_;
  std::vector<TracedPolygon> polygons_;
  std::vector<std::uint32_t> polygon_of_;  // by walk
  std::vector<Holes> holes_;
};

/// Whether a segment runs along both edges, the second straight on from the first.
bool runs_on(const Triangulation& mesh, EdgeId before, EdgeId after) {
  const auto has_segment = [&](cdt::Passage passage) {
    return std::ranges::any_of(mesh.passages(after), [&](cdt::Passage other) {
      return other.segment() == passage.segment();
    });
  };
  // Most edges turn, which is known sooner than what runs along them.
  return cdt::orient(mesh.point(mesh.from(before)), mesh.point(mesh.from(after)),
                     mesh.point(mesh.to(after))) == 0 &&
         std::ranges::any_of(mesh.passages(before), has_segment);
}

}  // namespace

std::vector<TracedPolygon> trace(const Regions& regions, std::span<const BorderEdge> border) {
  return Sorter(regions, border.size()).polygons(border);
}

std::vector<TracedRing> trace_through(const Regions& regions, std::span<const BorderEdge> some) {
  Tracer tracer(regions, some.size());
  for (const BorderEdge& edge : some) tracer.walk(edge.edge);
  return tracer.take_rings();
}

std::vector<EdgeId> find_fences(const Triangulation& mesh, std::span<const CoverId> covers) {
  std::vector<EdgeId> fences;
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i)
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(cdt::TriangleId(i), corner);
      if (!mesh.is_constrained(e)) continue;
      const EdgeId twin = mesh.twin(e);
      if (e < twin && covers[Triangulation::triangle(twin).index()] != covers[i])
        fences.push_back(e);
    }
  return fences;
}

std::vector<BorderEdge> borders(const Regions& regions, std::span<const EdgeId> fences) {
  const Triangulation& mesh = *regions.mesh;
  std::vector<BorderEdge> result;
  for (const EdgeId e : fences)
    for (const EdgeId side : {e, mesh.twin(e)})
      if (regions.has_border(side)) result.push_back(border_edge(mesh, side));
  return result;
}

std::vector<BorderEdge> borders(const Regions& regions) {
  return borders(regions, find_fences(*regions.mesh, regions.covers));
}

Ring points_of(const Triangulation& mesh, const TracedRing& ring, bool leave_out_straight) {
  Ring points;
  points.reserve(ring.size());
  EdgeId before = ring.back();
  for (const EdgeId e : ring) {
    if (!leave_out_straight || !runs_on(mesh, before, e))
      points.push_back(mesh.point(mesh.from(e)));
    before = e;
  }
  return points;
}

Polygon points_of(const Triangulation& mesh, const TracedPolygon& polygon,
                  bool leave_out_straight) {
  Polygon result{.outer = points_of(mesh, polygon.outer, leave_out_straight), .holes = {}};
  for (const TracedRing& hole : polygon.holes)
    result.holes.push_back(points_of(mesh, hole, leave_out_straight));
  return result;
}

}  // namespace loft::overlay
