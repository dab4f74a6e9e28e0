// SPDX-License-Identifier: MIT
#include "reconstruct/sew/sew.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "reconstruct/defect.h"
#include "reconstruct/parallel.h"
#include "reconstruct/sew/caps.h"
#include "reconstruct/sew/sewing.h"
#include "reconstruct/sew/used_points.h"

namespace loft {

namespace {

/// So many layers are sewn at once: enough for many threads, few enough to take little memory.
constexpr std::size_t batch_size = 64;

Sewing sew_layers(std::span<const Region* const> regions, std::vector<TileSet> slabs, Cap cap,
                  unsigned threads) {
  const auto count = static_cast<std::uint32_t>(slabs.size());
  Sewing sewing;
  std::vector<Layer> batch;
  if (cap == Cap::flat) batch.push_back(bottom_cap(*regions.front()));
  for (std::uint32_t i = 0; i < count; ++i) {
    batch.push_back({regions[i], regions[i + 1], std::move(slabs[i]), i, regions[i]->slice});
    if (batch.size() == batch_size) sewing.add(std::exchange(batch, {}), threads);
  }
  if (cap == Cap::flat)
    batch.push_back(top_cap(*regions.back(), count - 1, regions[count - 1]->slice));
  sewing.add(std::move(batch), threads);
  sewing.finish(threads);
  return sewing;
}

struct Counts {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t faces = 0;
};

/// How large the surface will be, but for what sewing adds where parts touch, for caps of regions
/// with holes, and for rims: few edges and faces.
Counts plain_counts(std::span<const Region* const> regions, std::span<const TileSet> slabs,
                    Cap cap) {
  Counts counts;
  for (const Region* region : regions) counts.vertices += region->points.size();
  for (const TileSet& slab : slabs) {
    counts.vertices += slab.inner.size();
    counts.faces += slab.tiles.size();
  }
  if (cap == Cap::flat)
    for (const Region* end : {regions.front(), regions.back()})
      counts.faces += end->points.size() - std::min<std::size_t>(2, end->points.size());
  counts.edges = counts.faces * 3 / 2;
  return counts;
}

/// Fills the mesh directly: mates are known, so that nothing has to be searched for and nothing
/// can be refused. Layers are written in parallel, each thread to elements of its own.
class Assembly {
 public:
  Assembly(const Sewing& sewing, Surface& surface, unsigned threads)
      : sewing_(sewing), surface_(surface), threads_(threads), numbers_(sewing.numbers()) {}

  void run() {
    // OpenMesh's numbers are signed, and a closed mesh has as many half-edges as corners.
    if (3 * face_count() > std::numeric_limits<int>::max())
      throw Error("more triangles than fit in memory; work out of core");
    const std::vector<std::uint32_t> first_edges = number_edges();
    surface_.resize(vertex_count(), first_edges.back(), face_count());
    handles_.resize(3 * face_count());
    rims_.resize(sewing_.layer_bound() + 1);
    for_each_layer([this](std::uint32_t layer) { add_vertices(layer); });
    add_made_vertices();
    for_each_group([&](std::uint32_t group) { add_edges(group, first_edges[group]); });
    for_each_group([this](std::uint32_t group) { add_faces(group); });
    lead_from_vertices();
    close_rims();
  }

 private:
  using Handle = Surface::HalfedgeHandle;

  [[nodiscard]] std::size_t vertex_count() const {
    return sewing_.plain_vertex_count() + sewing_.doubled().size() + sewing_.midpoints().size();
  }
  [[nodiscard]] std::size_t face_count() const {
    return sewing_.plain_face_count() + sewing_.cut_faces().size();
  }

  template <class Body>
  void for_each_layer(Body body) const {
    for_each_index(sewing_.layer_bound(), threads_,
                   [&](std::size_t i, unsigned) { body(static_cast<std::uint32_t>(i)); });
  }
  /// Faces by groups: those that each layer came with, then all that were cut off.
  template <class Body>
  void for_each_group(Body body) const {
    for_each_layer(body);
    body(sewing_.layer_bound());
  }
  /// Calls visit(half-edge, its number) for a group, in the order of the numbers.
  template <class Visit>
  void for_each_half_edge(std::uint32_t group, Visit visit) const {
    if (group < sewing_.layer_bound()) {
      const auto first = static_cast<std::uint32_t>(3 * sewing_.first_face(group));
      for (std::uint32_t h = 0; h < 3 * sewing_.face_count(group); ++h)
        visit(HalfEdge{group, h}, first + h);
      return;
    }
    auto number = static_cast<std::uint32_t>(3 * sewing_.plain_face_count());
    for (const HalfEdge face : sewing_.cut_faces())
      for (std::uint32_t i = 0; i < 3; ++i)
        visit(HalfEdge{face.layer, 3 * face.index + i}, number++);
  }

  [[nodiscard]] std::uint32_t number(HalfEdge h) const {
    const std::uint32_t own = sewing_.face_count(h.layer);
    const std::uint64_t face =
        h.face() < own ? sewing_.first_face(h.layer) + h.face()
                       : sewing_.plain_face_count() + sewing_.cuts_of(h.layer)[h.face() - own];
    return static_cast<std::uint32_t>(3 * face + h.index % 3);
  }

  [[nodiscard]] Surface::VertexHandle vertex(HalfEdge corner) const {
    return Surface::VertexHandle(static_cast<int>(numbers_.final(sewing_.vertex(corner))));
  }

  /// Of two half-edges the first one makes the edge.
  [[nodiscard]] static bool makes_edge(HalfEdge h, HalfEdge mate) {
    return mate.is_none() || h < mate;
  }

  /// The first edge of each group, and their number.
  [[nodiscard]] std::vector<std::uint32_t> number_edges() const {
    std::vector<std::uint32_t> firsts(sewing_.layer_bound() + 2);
    for_each_group([&](std::uint32_t group) {
      std::uint32_t count = 0;
      for_each_half_edge(group, [&](HalfEdge h, std::uint32_t) {
        if (makes_edge(h, sewing_.mate(h))) ++count;
      });
      firsts[group + 1] = count;
    });
    for (std::size_t i = 1; i < firsts.size(); ++i) firsts[i] += firsts[i - 1];
    return firsts;
  }

  void set_vertex(std::uint32_t number, const Vec3& p, const Origin& origin) {
    const Surface::VertexHandle v(static_cast<int>(number));
    surface_.set_point(v, {p[0], p[1], p[2]});
    surface_.data(v).origin = origin;
  }

  void add_slice(const Region& region, std::uint32_t first) {
    for (std::uint32_t i = 0; i < region.points.size(); ++i)
      set_vertex(first + i, {region.points[i].x, region.points[i].y, region.z}, region.origins[i]);
  }

  /// Those of the slice below the layer and inside it; above the last layer also those there.
  void add_vertices(std::uint32_t number) {
    const Layer& layer = sewing_.layer(number);
    add_slice(*layer.lower, sewing_.first_vertex(number));
    std::uint32_t next = sewing_.first_inner(number);
    for (const InnerVertex& inner : layer.tiles.inner)
      set_vertex(next++, inner.place, {inner.kind, layer.slice, Origin::none, Origin::none});
    if (number + 1 == sewing_.layer_bound()) add_slice(*layer.upper, next);
  }

  void add_made_vertices() {
    std::uint32_t next = sewing_.plain_vertex_count();
    for (const auto vertices : {sewing_.doubled(), sewing_.midpoints()})
      for (const SurfaceVertex& vertex : vertices) set_vertex(next++, vertex.place, vertex.origin);
  }

  void add_edges(std::uint32_t group, std::uint32_t first_edge) {
    auto next = static_cast<int>(2 * first_edge);
    for_each_half_edge(group, [&](HalfEdge h, std::uint32_t number_of_h) {
      const HalfEdge mate = sewing_.mate(h);
      if (!makes_edge(h, mate)) return;
      const Handle handle(next);
      const Handle opposite(next + 1);
      next += 2;
      surface_.set_vertex_handle(handle, vertex(Sewing::next(h)));
      surface_.set_vertex_handle(opposite, vertex(h));
      handles_[number_of_h] = handle;
      if (mate.is_none()) {
        surface_.set_boundary(opposite);
        rims_[group].push_back(opposite);
      } else {
        handles_[number(mate)] = opposite;
      }
    });
  }

  void add_faces(std::uint32_t group) {
    for_each_half_edge(group, [&](HalfEdge h, std::uint32_t number_of_h) {
      const Surface::FaceHandle face(static_cast<int>(number_of_h / 3));
      const Handle handle = handles_[number_of_h];
      surface_.set_face_handle(handle, face);
      surface_.set_next_halfedge_handle(
          handle, handles_[number_of_h % 3 == 2 ? number_of_h - 2 : number_of_h + 1]);
      if (number_of_h % 3 != 0) return;
      const Layer& layer = sewing_.layer(h.layer);
      surface_.set_halfedge_handle(face, handle);
      surface_.data(face).kind = layer.tiles.tiles[h.face()].kind;
      surface_.data(face).slab = layer.slab;
    });
  }

  /// A vertex leads to the last of the half-edges from it.
  void lead_from_vertices() {
    for (const Handle handle : handles_)
      surface_.set_halfedge_handle(surface_.from_vertex_handle(handle), handle);
  }

  /// An open surface: each vertex of a rim has one half-edge of the rim leaving it.
  void close_rims() {
    for (const auto& rims : rims_)
      for (const Handle h : rims) surface_.set_halfedge_handle(surface_.from_vertex_handle(h), h);
    for (const auto& rims : rims_)
      for (const Handle h : rims)
        surface_.set_next_halfedge_handle(h,
                                          surface_.halfedge_handle(surface_.to_vertex_handle(h)));
  }

  const Sewing& sewing_;
  Surface& surface_;
  unsigned threads_;
  VertexNumbers numbers_;
  std::vector<Handle> handles_;            // of each half-edge, by its number
  std::vector<std::vector<Handle>> rims_;  // of each group
};

/// Leaves out the points of lines that no part ends in. The regions returned are to be kept.
std::vector<UsedPoints> drop_unused_points(std::vector<const Region*>& regions,
                                           std::vector<TileSet>& slabs) {
  std::vector<UsedPoints> used(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i)
    used[i] = UsedPoints(*regions[i], i > 0 ? regions[i - 1] : nullptr,
                         i > 0 ? &slabs[i - 1] : nullptr, i < slabs.size() ? &slabs[i] : nullptr);
  for (std::size_t i = 0; i < slabs.size(); ++i)
    renumber(slabs[i], *regions[i], *regions[i + 1], used[i], used[i + 1]);
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (used[i].has_lines()) regions[i] = &used[i].region();
  return used;
}

}  // namespace

Surface sew(std::span<const Region* const> all_regions, std::vector<TileSet> slabs, Cap cap,
            unsigned threads) {
  std::vector<const Region*> regions(all_regions.begin(), all_regions.end());
  const std::vector<UsedPoints> used = drop_unused_points(regions, slabs);
  Surface surface;  // filled in place: moving one would copy it
  const Counts counts = plain_counts(regions, slabs, cap);
  Sewing sewing;
  // That much new memory takes about as long as sewing: both at once.
  for_each_index(2, threads, [&](std::size_t i, unsigned) {
    if (i == 0) {
      surface.resize(counts.vertices, counts.edges, counts.faces);
    } else {
      sewing = sew_layers(regions, std::move(slabs), cap, threads);
    }
  });
  Assembly(sewing, surface, threads).run();
  return surface;
}

Surface sew(std::span<const Region> regions, std::vector<TileSet> slabs, Cap cap,
            unsigned threads) {
  std::vector<const Region*> all;
  for (const Region& region : regions) all.push_back(&region);
  return sew(all, std::move(slabs), cap, threads);
}

Surface sew(std::span<const Region> regions, std::span<const TileSet> slabs, Cap cap) {
  return sew(regions, std::vector<TileSet>(slabs.begin(), slabs.end()), cap);
}

}  // namespace loft
