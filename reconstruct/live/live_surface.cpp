// SPDX-License-Identifier: MIT
#include "reconstruct/live/live_surface.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace loft {

namespace {

using Handle = Surface::HalfedgeHandle;
using FaceHandle = Surface::FaceHandle;
using VertexHandle = Surface::VertexHandle;
using EdgeHandle = Surface::EdgeHandle;

}  // namespace

class LiveSurface::Splicing {
 public:
  Splicing(LiveSurface& live, Splice splice)
      : surface_(live.surface_),
        elements_(live.elements_),
        is_open_(live.is_open_),
        splice_(std::move(splice)) {}

  Spliced run() {
    sew();
    list_faces();
    find_rims();
    if (result_.needs_below || result_.needs_above) return std::move(result_);
    adopt_vertices();
    choose_faces_that_stay();
    remove_faces();
    make_room();
    make_vertices();
    make_edges();
    make_faces();
    close_boundaries();
    free_vertices();
    return std::move(result_);
  }

 private:
  /// A face that sewing has made: of a layer that comes, and where it goes.
  struct Made {
    std::uint32_t layer;
    std::uint32_t face;
    FaceHandle handle;  // where it is, if it stays; then where it was put
    bool stays = false;
  };

  // --- Sewing ---

  void sew() {
    if (splice_.layers.empty()) return;
    sewing_.add(std::move(splice_.layers), 1);
    sewing_.finish(1);
    result_.is_sewn_as_tiled = sewing_.doubled().empty() && sewing_.midpoints().empty();
    const VertexNumbers numbers = sewing_.numbers();
    vertices_.resize(numbers.final(VertexNumbers::midpoint_mark) + sewing_.midpoints().size());
  }

  [[nodiscard]] std::uint32_t layer_count() const {
    return static_cast<std::uint32_t>(splice_.last - splice_.first);
  }
  /// Layers that come, by their number among all that are sewn.
  [[nodiscard]] bool comes(std::uint32_t layer) const {
    return layer >= splice_.first && layer < splice_.last;
  }
  [[nodiscard]] std::uint32_t sewn(std::uint32_t i) const {
    return static_cast<std::uint32_t>(splice_.first) + i;
  }
  [[nodiscard]] Made& made(HalfEdge h) {
    return made_[first_made_[h.layer - splice_.first] + h.face()];
  }
  [[nodiscard]] std::uint32_t number(HalfEdge corner) const {
    return sewing_.numbers().final(sewing_.vertex(corner));
  }
  [[nodiscard]] VertexHandle& vertex(HalfEdge corner) { return vertices_[number(corner)]; }

  void list_faces() {
    for (std::uint32_t i = 0; i < layer_count(); ++i) {
      first_made_.push_back(static_cast<std::uint32_t>(made_.size()));
      const auto* present = splice_.present.empty() ? nullptr : splice_.present[i];
      for (std::uint32_t f = 0; f < sewing_.face_count_with_cuts(sewn(i)); ++f) {
        const bool is_present = present != nullptr && f < present->size();
        made_.push_back({sewn(i), f, is_present ? (*present)[f] : FaceHandle(), is_present});
      }
    }
  }

  /// Calls visit(half-edge) for those of all faces that come.
  template <class Visit>
  void for_each_half_edge(Visit visit) {
    for (const Made& face : made_)
      for (std::uint32_t k = 0; k < 3; ++k) visit(HalfEdge{face.layer, 3 * face.face + k});
  }

  // --- Rims ---

  void find_rims() {
    rim_places_ =
        RimPlaces(sewing_, static_cast<std::uint32_t>(splice_.first),
                  static_cast<std::uint32_t>(splice_.last), splice_.slices, splice_.is_partial);
    for (const std::uint32_t slice : rim_places_.irregular()) {
      if (splice_.is_partial) result_.needs_below = true;
      if (slice == 0 && splice_.has_below) result_.needs_below = true;
      if (slice == layer_count() && splice_.has_above) result_.needs_above = true;
    }
  }

  /// The half-edge that is there already for a side in a slice, with a face on its other side that
  /// does not come; invalid if there is none.
  [[nodiscard]] Handle on_rim(HalfEdge h) const {
    const RimPlace* place = rim_places_.find(h);
    const HalfEdge mate = sewing_.mate(h);
    if (place == nullptr || (!mate.is_none() && comes(mate.layer))) return Handle();
    const Handle forward = splice_.slices[place->slice].rim->edges[place->place];
    if (!forward.is_valid() || place->is_above) return forward;
    return surface_.opposite_halfedge_handle(forward);
  }

  // --- What stays ---

  /// Vertices of the outer slices are there already; then those of faces that may stay.
  void adopt_vertices() {
    for_each_half_edge([&](HalfEdge h) {
      const Handle there = on_rim(h);
      if (!there.is_valid()) return;
      adopt(h, surface_.from_vertex_handle(there));
      adopt(Sewing::next(h), surface_.to_vertex_handle(there));
    });
    for (const Made& face : made_) {
      if (!face.stays) continue;
      Handle side = surface_.halfedge_handle(face.handle);
      for (std::uint32_t k = 0; k < 3; ++k, side = surface_.next_halfedge_handle(side))
        adopt({face.layer, 3 * face.face + k}, surface_.from_vertex_handle(side));
    }
  }

  void adopt(HalfEdge corner, VertexHandle there) {
    VertexHandle& here = vertex(corner);
    if (here.is_valid()) return;
    const Vec3 place = sewing_.place(corner);
    const Surface::Point& point = surface_.point(there);
    if (point[0] != place[0] || point[1] != place[1] || point[2] != place[2]) return;
    const auto [owner, is_new] = owners_.try_emplace(there.idx(), number(corner));
    if (is_new) here = there;
  }

  /// A face stays if it has the same corners and, where its neighbour stays, too, is joined to it.
  void choose_faces_that_stay() {
    if (std::ranges::none_of(splice_.present, [](const auto* faces) { return faces != nullptr; }))
      return;
    std::unordered_map<int, std::uint32_t> numbers;  // of the faces that are there
    for (std::uint32_t i = 0; i < made_.size(); ++i)
      if (made_[i].stays) numbers.emplace(made_[i].handle.idx(), i);
    for (Made& face : made_) face.stays = face.stays && fits(face, numbers);
  }

  [[nodiscard]] bool fits(const Made& face, const std::unordered_map<int, std::uint32_t>& numbers) {
    Handle side = surface_.halfedge_handle(face.handle);
    for (std::uint32_t k = 0; k < 3; ++k, side = surface_.next_halfedge_handle(side)) {
      const HalfEdge h{face.layer, 3 * face.face + k};
      if (vertex(h) != surface_.from_vertex_handle(side)) return false;
      const HalfEdge mate = sewing_.mate(h);
      const FaceHandle beyond = surface_.face_handle(surface_.opposite_halfedge_handle(side));
      if (!mate.is_none() && comes(mate.layer) && made(mate).stays && made(mate).handle != beyond)
        return false;
      const auto there = beyond.is_valid() ? numbers.find(beyond.idx()) : numbers.end();
      if (there == numbers.end() || !made_[there->second].stays) continue;
      if (mate.is_none() || !comes(mate.layer) || &made(mate) != &made_[there->second])
        return false;
    }
    return true;
  }

  // --- What goes ---

  void add_to_bounds(const Surface::Point& p) {
    const Vec3 place{p[0], p[1], p[2]};
    if (!result_.bounds) result_.bounds = Box3{place, place};
    result_.bounds = joined(*result_.bounds, {place, place});
  }

  /// Faces go with the edges that no face is left at. Other edges have one face less; whether they
  /// get another is seen later.
  void remove_faces() {
    std::vector<FaceHandle> staying;
    for (const Made& face : made_)
      if (face.stays) staying.push_back(face.handle);
    for (const FaceHandle f : staying) surface_.status(f).set_tagged(true);
    for (const FaceHandle f : splice_.removed) {
      if (surface_.status(f).tagged()) continue;
      Handle side = surface_.halfedge_handle(f);
      for (int k = 0; k < 3; ++k, side = surface_.next_halfedge_handle(side)) {
        touched_.push_back(surface_.from_vertex_handle(side));
        add_to_bounds(surface_.point(touched_.back()));
        loose_.push_back(side);
      }
      elements_.give_back(f);
      ++result_.faces_removed;
    }
    for (const FaceHandle f : staying) surface_.status(f).set_tagged(false);
    // A half-edge of two faces that go comes twice: once from either side.
    for (const Handle h : loose_) {
      const Handle other = surface_.opposite_halfedge_handle(h);
      surface_.set_boundary(h);
      const EdgeHandle e = surface_.edge_handle(h);
      if (!surface_.is_boundary(other) || surface_.status(e).deleted()) continue;
      elements_.give_back(e);
    }
    // Edges that no face is left at are on no rim any more.
    for (const RimmedSlice& slice : splice_.slices)
      if (slice.rim != nullptr) splice_.rims.push_back(slice.rim);
    for (Rim* const rim : splice_.rims)
      for (Handle& h : rim->edges)
        if (h.is_valid() && surface_.status(surface_.edge_handle(h)).deleted()) h = Handle();
  }

  // --- What comes ---

  void make_room() {
    std::size_t faces = 0;
    std::vector<bool> is_used(vertices_.size());
    std::size_t vertices = 0;
    for (const Made& face : made_) {
      if (face.stays) continue;
      ++faces;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t v = number({face.layer, 3 * face.face + k});
        if (!vertices_[v].is_valid() && !is_used[v]) ++vertices;
        is_used[v] = true;
      }
    }
    std::size_t edges = 0;
    for_each_half_edge([&](HalfEdge h) { edges += makes_edge(h) ? 1U : 0U; });
    elements_.make_room(vertices, edges, faces);
  }

  void make_vertices() {
    for (const Made& face : made_) {
      if (face.stays) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfEdge corner{face.layer, 3 * face.face + k};
        VertexHandle& v = vertex(corner);
        if (v.is_valid()) continue;
        v = elements_.take_vertex();
        const Vec3 p = sewing_.place(corner);
        surface_.set_point(v, {p[0], p[1], p[2]});
        surface_.data(v).origin = sewing_.origin(corner);
        surface_.set_isolated(v);
        ++result_.vertices_added;
      }
    }
  }

  /// Whether a side needs an edge that is not there; of two sides the first one makes it.
  [[nodiscard]] bool makes_edge(HalfEdge h) {
    if (made(h).stays || on_rim(h).is_valid()) return false;
    const HalfEdge mate = sewing_.mate(h);
    if (mate.is_none() || !comes(mate.layer)) return true;
    return !made(mate).stays && h < mate;
  }

  [[nodiscard]] Handle& handle(HalfEdge h) {
    return handles_[3 * (first_made_[h.layer - splice_.first] + h.face()) + h.index % 3];
  }

  void make_edges() {
    handles_.resize(3 * made_.size());
    for_each_half_edge([&](HalfEdge h) {
      if (made(h).stays) return;
      const HalfEdge mate = sewing_.mate(h);
      if (const Handle there = on_rim(h); there.is_valid()) {
        handle(h) = there;
      } else if (!mate.is_none() && comes(mate.layer) && made(mate).stays) {
        Handle side = surface_.halfedge_handle(made(mate).handle);
        for (std::uint32_t k = 0; k < mate.index % 3; ++k)
          side = surface_.next_halfedge_handle(side);
        handle(h) = surface_.opposite_halfedge_handle(side);
      } else if (makes_edge(h)) {
        make_edge(h, mate);
      }
    });
    for_each_half_edge([&](HalfEdge h) {
      if (const RimPlace* place = rim_places_.find(h); place != nullptr && !made(h).stays)
        splice_.slices[place->slice].rim->edges[place->place] =
            place->is_above ? handle(h) : surface_.opposite_halfedge_handle(handle(h));
    });
    for (std::uint32_t i = 1; i < layer_count(); ++i) splice_.slices[i].rim->is_regular = true;
    for (const std::uint32_t i : rim_places_.irregular()) splice_.slices[i].rim->is_regular = false;
  }

  void make_edge(HalfEdge h, HalfEdge mate) {
    const EdgeHandle e = elements_.take_edge();
    const Handle one = surface_.halfedge_handle(e, 0);
    const Handle other = surface_.halfedge_handle(e, 1);
    surface_.set_vertex_handle(one, vertex(Sewing::next(h)));
    surface_.set_vertex_handle(other, vertex(h));
    surface_.set_boundary(other);
    handle(h) = one;
    if (!mate.is_none() && comes(mate.layer)) {
      handle(mate) = other;
    } else {
      loose_.push_back(other);
    }
  }

  void make_faces() {
    result_.faces.resize(layer_count());
    for (Made& face : made_) {
      if (!face.stays) make_face(face);
      result_.faces[face.layer - splice_.first].push_back(face.handle);
    }
  }

  void make_face(Made& face) {
    face.handle = elements_.take_face();
    const Layer& layer = sewing_.layer(face.layer);
    surface_.data(face.handle).kind = layer.tiles.tiles[face.face].kind;
    surface_.data(face.handle).slab = layer.slab;
    const HalfEdge first{face.layer, 3 * face.face};
    surface_.set_halfedge_handle(face.handle, handle(first));
    HalfEdge h = first;
    for (int k = 0; k < 3; ++k, h = Sewing::next(h)) {
      surface_.set_face_handle(handle(h), face.handle);
      surface_.set_next_halfedge_handle(handle(h), handle(Sewing::next(h)));
      surface_.set_halfedge_handle(vertex(h), handle(h));
      add_to_bounds(surface_.point(vertex(h)));
    }
    ++result_.faces_added;
  }

  // --- Afterwards ---

  /// Edges at what went or came that have one face are a boundary now. A vertex there leads to its
  /// half-edge along the boundary.
  void close_boundaries() {
    if (is_open_) touch_what_stays();
    std::vector<Handle> boundary;
    for (const Handle h : loose_) {
      if (surface_.status(surface_.edge_handle(h)).deleted()) continue;
      for (const Handle side : {h, surface_.opposite_halfedge_handle(h)}) {
        if (surface_.is_boundary(side)) {
          boundary.push_back(side);
        } else {
          lead_from_vertex(side);
        }
      }
    }
    if (is_open_) {
      for (const Made& face : made_)
        for (const std::uint32_t k : {0U, 1U, 2U})
          if (!face.stays) lead_from_vertex(handle({face.layer, 3 * face.face + k}));
    }
    for (const Handle h : boundary) surface_.set_halfedge_handle(surface_.from_vertex_handle(h), h);
    for (const Handle h : boundary) {
      surface_.set_next_halfedge_handle(h, surface_.halfedge_handle(surface_.to_vertex_handle(h)));
      const Handle before = boundary_before(h);
      surface_.set_next_halfedge_handle(before, h);
    }
  }

  /// What went may have been all that joined the faces at a vertex: where they stay, they have
  /// vertices of their own now, and boundaries there.
  void touch_what_stays() {
    for (const Made& face : made_) {
      if (!face.stays) continue;
      Handle side = surface_.halfedge_handle(face.handle);
      for (int k = 0; k < 3; ++k, side = surface_.next_halfedge_handle(side))
        loose_.push_back(side);
    }
  }

  /// From the start of a side of a face, to its boundary if it is on one.
  void lead_from_vertex(Handle side) {
    Handle h = side;
    if (is_open_) {
      do {
        h = surface_.opposite_halfedge_handle(surface_.prev_halfedge_handle(h));
      } while (h != side && !surface_.is_boundary(h));
    }
    surface_.set_halfedge_handle(surface_.from_vertex_handle(side), h);
  }

  /// The half-edge of the boundary that ends where h starts: around the faces there.
  [[nodiscard]] Handle boundary_before(Handle h) const {
    Handle in = surface_.opposite_halfedge_handle(h);
    while (!surface_.is_boundary(in))
      in = surface_.opposite_halfedge_handle(surface_.next_halfedge_handle(in));
    return in;
  }

  /// Vertices of faces that went are free if no face is left at them: then what they lead to is no
  /// half-edge of theirs any more.
  void free_vertices() {
    for (const VertexHandle v : touched_) {
      if (surface_.status(v).deleted()) continue;
      const Handle h = surface_.halfedge_handle(v);
      if (is_alive(h) && surface_.from_vertex_handle(h) == v) continue;
      surface_.set_isolated(v);
      elements_.give_back(v);
      ++result_.vertices_removed;
    }
  }

  [[nodiscard]] bool is_alive(Handle h) const {
    return h.is_valid() && !surface_.status(surface_.edge_handle(h)).deleted() &&
           (!surface_.is_boundary(h) ||
            !surface_.is_boundary(surface_.opposite_halfedge_handle(h)));
  }

  Surface& surface_;
  Elements& elements_;
  bool is_open_;
  Splice splice_;
  Spliced result_;
  Sewing sewing_;
  RimPlaces rim_places_;
  std::vector<Made> made_;  // the faces that come, layer by layer
  std::vector<std::uint32_t> first_made_;
  std::vector<VertexHandle> vertices_;             // by the number that sewing gives
  std::unordered_map<int, std::uint32_t> owners_;  // numbers of the vertices that are there
  std::vector<Handle> handles_;                    // of each half-edge that comes
  std::vector<VertexHandle> touched_;              // corners of faces that went
  std::vector<Handle> loose_;  // sides of theirs, and the far sides of new edges
};

Spliced LiveSurface::splice(Splice splice) { return Splicing(*this, std::move(splice)).run(); }

void LiveSurface::collect_garbage(std::span<std::vector<FaceHandle>* const> faces,
                                  std::span<Rim* const> rims) {
  std::vector<VertexHandle*> no_vertices;
  std::vector<Handle*> half_edges;
  std::vector<FaceHandle*> all_faces;
  for (Rim* rim : rims)
    for (Handle& h : rim->edges)
      if (h.is_valid()) half_edges.push_back(&h);
  for (std::vector<FaceHandle>* some : faces)
    for (FaceHandle& f : *some) all_faces.push_back(&f);
  surface_.garbage_collection(no_vertices, half_edges, all_faces);
  elements_.forget();
}

}  // namespace loft
