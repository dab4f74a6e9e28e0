// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/origin.h"
#include "reconstruct/sew/surface_sink.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// A side of a face: side i of face f of a layer is `3 * f + i`, from corner i to the next.
struct HalfEdge {
  std::uint32_t layer = Origin::none;
  std::uint32_t index = Origin::none;

  [[nodiscard]] bool is_none() const { return layer == Origin::none; }
  [[nodiscard]] std::uint32_t face() const { return index / 3; }
  friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

/// The tiles of one slab, or a cap, on their way into the surface.
struct Layer {
  const Region* lower;  ///< what it stands on and what is above; of a cap one is empty
  const Region* upper;
  TileSet tiles;
  std::uint32_t slab;   ///< what its faces will say
  std::uint32_t slice;  ///< what its inner vertices will say
};

/// Sews slabs and caps together, from the lowest upwards, and takes apart what only touches:
/// at an edge with more than two faces each is joined to its neighbour
/// across the solid, vertices are doubled until each has one fan of faces, and edges that still
/// join the same two vertices get midpoints of their own.
///
/// A layer is final when the next two have been added. Those that are final can be dropped: what is
/// in memory are the layers that are not, and the vertices and faces made by sewing, which are few.
///
/// Vertices are numbered: slice by slice, with the inner vertices of a slab behind the slice below
/// it; then doubled vertices; then midpoints. Faces: layer by layer, then those that midpoints cut
/// off. Precondition: a closed, oriented boundary of a solid, or the open rim of one.
/// Cost: O(n).
class Sewing {
 public:
  /// Puts layers on top of those before, in their order. Each stands on what the one before ended
  /// with. The regions must stay until their layers are dropped.
  void add(std::vector<Layer> layers, unsigned threads);
  /// Nothing comes on top any more.
  void finish(unsigned threads);

  /// Layers from `first_layer()` up to this are final.
  [[nodiscard]] std::uint32_t final_bound() const { return final_bound_; }
  [[nodiscard]] std::uint32_t first_layer() const { return first_layer_; }
  /// Layers ever added.
  [[nodiscard]] std::uint32_t layer_bound() const {
    return first_layer_ + static_cast<std::uint32_t>(layers_.size());
  }
  /// Forgets the layers below.
  void drop_below(std::uint32_t layer);

  [[nodiscard]] const Layer& layer(std::uint32_t layer) const { return at(layer).layer; }
  /// Faces that a layer had when it was added.
  [[nodiscard]] std::uint32_t face_count(std::uint32_t layer) const { return at(layer).face_count; }
  /// With those that midpoints have cut off.
  [[nodiscard]] std::uint32_t face_count_with_cuts(std::uint32_t layer) const {
    return face_count(layer) + static_cast<std::uint32_t>(cuts_of(layer).size());
  }
  [[nodiscard]] std::uint64_t first_face(std::uint32_t layer) const { return at(layer).first_face; }
  /// Number of the first vertex of the slice that a layer stands on, and of its first inner vertex.
  [[nodiscard]] std::uint32_t first_vertex(std::uint32_t layer) const { return at(layer).lower; }
  [[nodiscard]] std::uint32_t first_inner(std::uint32_t layer) const { return at(layer).inner; }

  /// The vertices of slices and slabs, of all layers added.
  [[nodiscard]] std::uint32_t plain_vertex_count() const { return vertex_count_; }
  [[nodiscard]] std::uint64_t plain_face_count() const { return face_count_; }
  [[nodiscard]] std::span<const SurfaceVertex> doubled() const { return doubled_; }
  [[nodiscard]] std::span<const SurfaceVertex> midpoints() const { return midpoints_; }
  /// The faces that midpoints cut off, in their order: by the layer they belong to and their number
  /// there, which is face_count() or more.
  [[nodiscard]] std::span<const HalfEdge> cut_faces() const { return cut_faces_; }
  /// The places in cut_faces() of those that belong to a layer.
  [[nodiscard]] std::span<const std::uint32_t> cuts_of(std::uint32_t layer) const {
    return at(layer).cuts;
  }

  /// What sewing has added by and by, in its order.
  struct Added {
    std::uint32_t doubled = 0;
    std::uint32_t midpoints = 0;
    std::uint32_t cuts = 0;  ///< faces
  };
  /// What it had added before it came to a layer and the slice below it. All of a final layer's
  /// corners that are doubled were added with it or the layer below, all that are midpoints with it
  /// or the layer above. Precondition: the layer below is final.
  [[nodiscard]] Added added_before(std::uint32_t layer) const {
    return layer == 0 ? Added{} : added_[layer - 1];
  }

  /// The vertex number of a corner of a final layer, as in VertexNumbers.
  [[nodiscard]] std::uint32_t vertex(HalfEdge corner) const;
  /// Where a corner of a final layer is.
  [[nodiscard]] Vec3 place(HalfEdge corner) const;
  [[nodiscard]] Origin origin(HalfEdge corner) const;
  /// The node of a corner of a final layer that it had before it was doubled, if it is a point of
  /// one of the layer's slices; otherwise a number that no such point has.
  [[nodiscard]] std::uint32_t contour_node(HalfEdge corner) const;
  /// What is known of vertex numbers once all layers are final.
  [[nodiscard]] VertexNumbers numbers() const {
    return {vertex_count_, static_cast<std::uint32_t>(doubled_.size())};
  }

  /// The next half-edge around the same face.
  [[nodiscard]] static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static HalfEdge next(HalfEdge h) { return {h.layer, next(h.index)}; }
  /// The half-edge that the surface continues with on the other side, or none where it ends.
  [[nodiscard]] HalfEdge mate(HalfEdge h) const;

 private:
  /// Corners that share a vertex and whose faces are connected around it, the lowest first.
  using Fan = std::vector<HalfEdge>;
  /// An edge with more than two faces, by the numbers of its ends.
  struct Crowd {
    std::uint32_t low;
    std::uint32_t high;
    std::vector<HalfEdge> half_edges;
  };
  /// A point of the slice below a layer; of none for an inner vertex.
  struct SlicePoint {
    std::uint32_t layer = Origin::none;
    std::uint32_t point = 0;
  };
  struct State {
    Layer layer;
    std::uint32_t lower_count = 0;    // nodes of the slice below
    std::uint32_t contour_count = 0;  // and of that above
    std::uint32_t lower = 0;          // number of the first vertex of the slice below
    std::uint32_t inner = 0;          // of the first inner vertex
    std::uint32_t upper = 0;          // of the first vertex of the slice above
    std::uint32_t face_count = 0;
    std::uint64_t first_face = 0;
    std::vector<std::uint32_t> mates;      // of each half-edge, coded
    std::vector<std::uint32_t> lower_rim;  // half-edges that lie in the slice below
    std::vector<std::uint32_t> upper_rim;
    std::vector<std::uint32_t> corner_counts;  // of each node
    std::vector<std::uint32_t> first_corners;  // of each node, or none
    std::vector<Crowd> crowds;
    std::vector<std::uint32_t> cuts;  // places of its cut faces in cut_faces_
    std::vector<Fan> fans;            // those that begin here and need a vertex of their own

    [[nodiscard]] std::uint32_t node(std::uint32_t half_edge) const {
      return layer.tiles.tiles[half_edge / 3].nodes[half_edge % 3];
    }
    /// Whether both nodes are in one slice.
    [[nodiscard]] bool is_in_slice(std::uint32_t a, std::uint32_t b) const {
      return std::max(a, b) < contour_count && (a < lower_count) == (b < lower_count);
    }
  };
  /// What is found where two layers meet, to be taken over in the order of layers.
  struct Found {
    std::vector<Fan> fans;
    std::vector<Crowd> crowds;
  };

  [[nodiscard]] const State& at(std::uint32_t layer) const { return layers_[layer - first_layer_]; }
  [[nodiscard]] State& at(std::uint32_t layer) { return layers_[layer - first_layer_]; }
  [[nodiscard]] bool has(std::uint32_t layer) const {
    return layer >= first_layer_ && layer < layer_bound();
  }

  [[nodiscard]] static HalfEdge prev(HalfEdge h) { return next(next(h)); }
  [[nodiscard]] Vec3 apex(HalfEdge h) const { return place(prev(h)); }
  [[nodiscard]] SlicePoint slice_point(HalfEdge corner) const;
  void set_node(HalfEdge corner, std::uint32_t node);
  void set_mate(HalfEdge h, HalfEdge mate);
  void join(HalfEdge a, HalfEdge b);

  void number(State& state);
  void settle(std::uint32_t bound, unsigned threads);
  void separate(std::uint32_t layer);

  void pair_within(std::uint32_t layer);
  static void sort_out(State& state, std::vector<std::uint32_t>& ends);
  void pair_at(std::uint32_t layer, Found& found);
  [[nodiscard]] bool pair_contours_at(std::uint32_t layer);
  void pair_across_solid(std::vector<HalfEdge> edge, std::vector<Crowd>& crowds);

  template <class Visit>
  void for_each_in_fan(HalfEdge corner, Visit visit) const;
  void find_fans(std::uint32_t layer, Found& found) const;
  [[nodiscard]] bool is_one_fan(std::uint32_t layer, std::uint32_t node) const;
  [[nodiscard]] bool is_one_fan_at(std::uint32_t layer, std::uint32_t point) const;
  void add_fans(std::span<const HalfEdge> corners, Found& found) const;

  [[nodiscard]] HalfEdge latest(HalfEdge h) const;
  void split_double_edges(std::vector<Crowd>& crowds);
  void split_double_edges(const Crowd& crowd);
  void split_edge(HalfEdge h);
  [[nodiscard]] HalfEdge cut(HalfEdge h, std::uint32_t middle);

  std::deque<State> layers_;
  std::uint32_t first_layer_ = 0;
  std::uint32_t joined_bound_ = 0;   // layers below are joined to the one under them
  std::uint32_t settled_bound_ = 0;  // layers below have doubled vertices and cut edges
  std::uint32_t final_bound_ = 0;
  std::vector<Crowd> top_crowds_;  // in the slice above the last layer
  std::uint32_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
  std::vector<SurfaceVertex> doubled_;
  std::vector<SlicePoint> doubled_points_;  // what each of them was
  std::vector<SurfaceVertex> midpoints_;
  std::vector<HalfEdge> cut_faces_;
  std::vector<Added> added_;            // up to each layer
  std::map<HalfEdge, HalfEdge> moved_;  // half-edges that cuts gave another number
};

}  // namespace loft
