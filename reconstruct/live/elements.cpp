// SPDX-License-Identifier: MIT
#include "reconstruct/live/elements.h"

#include <algorithm>
#include <limits>

namespace loft {

namespace {

template <class Some>
std::size_t missing(std::size_t needed, const std::vector<Some>& there) {
  return needed - std::min(needed, there.size());
}

std::size_t enlarged(std::size_t& room, std::size_t needed) {
  if (needed > room) room = 2 * needed;
  return room;
}

template <class Some>
Some take(std::vector<Some>& free) {
  const Some one = free.back();
  free.pop_back();
  return one;
}

/// The lowest is taken first.
template <class Some>
void add_new(std::vector<Some>& free, std::size_t before, std::size_t now) {
  for (std::size_t i = now; i-- > before;) free.emplace_back(static_cast<int>(i));
}

}  // namespace

bool Elements::has_room_for(std::size_t faces) const {
  // OpenMesh's numbers are signed. A face has three edges, at worst its own.
  constexpr std::size_t most = std::numeric_limits<int>::max();
  return faces < most / 6 && surface_.n_halfedges() + 6 * faces < most;
}

void Elements::make_room(std::size_t vertices, std::size_t edges, std::size_t faces) {
  const std::size_t v_before = surface_.n_vertices();
  const std::size_t e_before = surface_.n_edges();
  const std::size_t f_before = surface_.n_faces();
  const std::size_t v = v_before + missing(vertices, vertices_);
  const std::size_t e = e_before + missing(edges, edges_);
  const std::size_t f = f_before + missing(faces, faces_);
  surface_.reserve(enlarged(vertex_room_, v), enlarged(edge_room_, e), enlarged(face_room_, f));
  surface_.resize(v, e, f);
  add_new(vertices_, v_before, v);
  add_new(edges_, e_before, e);
  add_new(faces_, f_before, f);
}

Surface::VertexHandle Elements::take_vertex() {
  const Surface::VertexHandle v = take(vertices_);
  mark(v, false);
  return v;
}

Surface::EdgeHandle Elements::take_edge() {
  const Surface::EdgeHandle e = take(edges_);
  mark(e, false);
  return e;
}

Surface::FaceHandle Elements::take_face() {
  const Surface::FaceHandle f = take(faces_);
  mark(f, false);
  return f;
}

void Elements::give_back(Surface::VertexHandle v) {
  mark(v, true);
  vertices_.push_back(v);
}

void Elements::give_back(Surface::EdgeHandle e) {
  mark(e, true);
  edges_.push_back(e);
}

void Elements::give_back(Surface::FaceHandle f) {
  mark(f, true);
  faces_.push_back(f);
}

void Elements::forget() {
  vertices_.clear();
  edges_.clear();
  faces_.clear();
}

void Elements::mark(Surface::EdgeHandle e, bool is_deleted) {
  surface_.status(e).set_deleted(is_deleted);
  for (const unsigned i : {0U, 1U})
    surface_.status(surface_.halfedge_handle(e, i)).set_deleted(is_deleted);
}

}  // namespace loft
