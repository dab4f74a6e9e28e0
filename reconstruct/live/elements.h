// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reconstruct/surface.h"

namespace loft {

/// The vertices, edges and faces of a surface that is changed in its place: those that go are
/// marked as deleted, and taken again for those that come next.
class Elements {
 public:
  explicit Elements(Surface& surface) : surface_(surface) {}

  [[nodiscard]] std::size_t vertex_count() const {
    return surface_.n_vertices() - vertices_.size();
  }
  [[nodiscard]] std::size_t face_count() const { return surface_.n_faces() - faces_.size(); }
  /// Whether there may be so many faces more: handles are numbered by int.
  [[nodiscard]] bool has_room_for(std::size_t faces) const;

  /// Makes sure that so many can be taken. Arrays grow to twice their size, seldom enough for a
  /// steady pace; what is not used yet is address space without memory behind it.
  void make_room(std::size_t vertices, std::size_t edges, std::size_t faces);

  /// One that is not deleted any more. Precondition: there is room.
  [[nodiscard]] Surface::VertexHandle take_vertex();
  [[nodiscard]] Surface::EdgeHandle take_edge();
  [[nodiscard]] Surface::FaceHandle take_face();

  void give_back(Surface::VertexHandle v);
  void give_back(Surface::EdgeHandle e);
  void give_back(Surface::FaceHandle f);

  /// After garbage collection there is nothing to take again.
  void forget();

 private:
  void mark(Surface::VertexHandle v, bool is_deleted) {
    surface_.status(v).set_deleted(is_deleted);
  }
  void mark(Surface::FaceHandle f, bool is_deleted) { surface_.status(f).set_deleted(is_deleted); }
  void mark(Surface::EdgeHandle e, bool is_deleted);

  Surface& surface_;
  std::size_t vertex_room_ = 0;  // that its arrays have
  std::size_t edge_room_ = 0;
  std::size_t face_room_ = 0;
  // Elements that are deleted.
  std::vector<Surface::VertexHandle> vertices_;
  std::vector<Surface::EdgeHandle> edges_;
  std::vector<Surface::FaceHandle> faces_;
};

}  // namespace loft
