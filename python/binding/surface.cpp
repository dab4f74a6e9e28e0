// SPDX-License-Identifier: MIT
#include "reconstruct/surface.h"

#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "python/binding/arrays.h"
#include "python/binding/job.h"
#include "python/binding/measures.h"
#include "python/binding/parts.h"

namespace loft::python {

namespace {

using Vertex = Surface::VertexHandle;
using Handle = Surface::HalfedgeHandle;

/// The mesh's own coordinates, without a copy.
py::array vertices(const SharedSurface& shared) {
  const Surface& surface = *shared.get();
  return view(surface.n_vertices() == 0 ? nullptr : surface.points()->data(),
              {static_cast<py::ssize_t>(surface.n_vertices()), 3}, shared.get());
}

py::array faces(const SharedSurface& shared) {
  const Surface& surface = *shared.get();
  std::vector<std::array<std::uint32_t, 3>> faces;
  faces.reserve(surface.n_faces());
  for (const auto face : surface.faces()) {
    std::array<std::uint32_t, 3>& corners = faces.emplace_back();
    std::size_t corner = 0;
    for (const auto vertex : face.vertices())
      corners[corner++] = static_cast<std::uint32_t>(vertex.idx());
  }
  return to_array(std::move(faces));
}

/// Of Origin::none the cast makes -1.
py::tuple origins(const SharedSurface& shared) {
  const Surface& surface = *shared.get();
  std::vector<std::uint8_t> kinds;
  std::vector<std::array<std::int32_t, 3>> places;
  for (const auto vertex : surface.vertices()) {
    const Origin& origin = surface.data(vertex).origin;
    kinds.push_back(static_cast<std::uint8_t>(origin.kind));
    places.push_back({static_cast<std::int32_t>(origin.slice),
                      static_cast<std::int32_t>(origin.contour),
                      static_cast<std::int32_t>(origin.point)});
  }
  return py::make_tuple(to_array(std::move(kinds)), to_array(std::move(places)));
}

py::tuple face_data(const SharedSurface& shared) {
  const Surface& surface = *shared.get();
  std::vector<std::uint8_t> kinds;
  std::vector<std::uint32_t> slabs;
  for (const auto face : surface.faces()) {
    kinds.push_back(static_cast<std::uint8_t>(surface.data(face).kind));
    slabs.push_back(surface.data(face).slab);
  }
  return py::make_tuple(to_array(std::move(kinds)), to_array(std::move(slabs)));
}

/// Makes a surface of its own arrays again, vertex by vertex and face by face.
class Rebuild {
 public:
  Rebuild(const Array<double>& vertices, const Array<std::uint32_t>& faces)
      : vertices_(vertices), faces_(faces) {
    require_shape(vertices, "vertices", 3);
    require_shape(faces, "faces", 3);
    if (vertices.shape(0) > most || faces.shape(0) > most / 3)
      throw InputError("faces: more than there can be");
  }

  std::shared_ptr<Surface> run() {
    pair_half_edges();
    surface_->resize(static_cast<std::size_t>(vertices_.shape(0)), edge_count_,
                     static_cast<std::size_t>(faces_.shape(0)));
    for (py::ssize_t i = 0; i < vertices_.shape(0); ++i)
      surface_->set_point(Vertex(static_cast<int>(i)),
                          {vertices_.at(i, 0), vertices_.at(i, 1), vertices_.at(i, 2)});
    for (py::ssize_t i = 0; i < faces_.shape(0); ++i) add_face(i);
    close_rims();
    return std::move(surface_);
  }

 private:
  static constexpr py::ssize_t most = std::numeric_limits<std::int32_t>::max() / 2;

  [[nodiscard]] std::uint32_t corner(py::ssize_t face, py::ssize_t i) const {
    return *faces_.data(face, i % 3);
  }
  [[nodiscard]] static std::uint64_t key(std::uint32_t from, std::uint32_t to) {
    return (std::uint64_t{from} << 32U) | to;
  }

  void pair_half_edges() {
    const auto bound = static_cast<std::uint64_t>(vertices_.shape(0));
    for (py::ssize_t face = 0; face < faces_.shape(0); ++face)
      for (py::ssize_t i = 0; i < 3; ++i) {
        const std::uint32_t from = corner(face, i);
        const std::uint32_t to = corner(face, i + 1);
        if (from >= bound || to >= bound || from == to)
          throw InputError("face " + std::to_string(face) + ": its corners are no three vertices");
        const auto mate = handles_.find(key(to, from));
        const int number =
            mate != handles_.end() ? mate->second ^ 1 : 2 * static_cast<int>(edge_count_++);
        if (!handles_.emplace(key(from, to), number).second)
          throw InputError("face " + std::to_string(face) +
                           ": another one runs along its side in the same direction");
      }
  }

  void add_face(py::ssize_t number) {
    const Surface::FaceHandle face(static_cast<int>(number));
    std::array<Handle, 3> handles;
    for (py::ssize_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corner(number, i);
      const std::uint32_t to = corner(number, i + 1);
      const Handle handle(handles_.at(key(from, to)));
      handles[static_cast<std::size_t>(i)] = handle;
      surface_->set_vertex_handle(handle, Vertex(static_cast<int>(to)));
      surface_->set_vertex_handle(surface_->opposite_halfedge_handle(handle),
                                  Vertex(static_cast<int>(from)));
      surface_->set_face_handle(handle, face);
      surface_->set_halfedge_handle(Vertex(static_cast<int>(from)), handle);
    }
    for (std::size_t i = 0; i < 3; ++i)
      surface_->set_next_halfedge_handle(handles[i], handles[(i + 1) % 3]);
    surface_->set_halfedge_handle(face, handles[2]);  // it leads to the first corner
  }

  void close_rims() {
    std::vector<Handle> rims;
    std::vector<bool> has_rim(surface_->n_vertices());
    for (const auto& [ends, number] : handles_) {
      const Handle opposite(number ^ 1);
      if (surface_->face_handle(opposite).is_valid()) continue;
      const auto from = static_cast<std::size_t>(surface_->from_vertex_handle(opposite).idx());
      if (has_rim[from])
        throw InputError("vertex " + std::to_string(from) + ": faces meet in it alone");
      has_rim[from] = true;
      surface_->set_boundary(opposite);
      surface_->set_halfedge_handle(surface_->from_vertex_handle(opposite), opposite);
      rims.push_back(opposite);
    }
    for (const Handle rim : rims)
      surface_->set_next_halfedge_handle(
          rim, surface_->halfedge_handle(surface_->to_vertex_handle(rim)));
  }

  const Array<double>& vertices_;
  const Array<std::uint32_t>& faces_;
  std::unordered_map<std::uint64_t, int> handles_;  // by their ends
  std::size_t edge_count_ = 0;
  std::shared_ptr<Surface> surface_ = std::make_shared<Surface>();
};

SharedSurface surface_of_arrays(const Array<double>& vertices, const Array<std::uint32_t>& faces,
                                const Array<std::uint8_t>& kinds,
                                const Array<std::int32_t>& origins,
                                const Array<std::uint8_t>& face_kinds,
                                const Array<std::uint32_t>& face_slabs) {
  require_shape(kinds, "kind");
  require_shape(origins, "origin", 3);
  require_shape(face_kinds, "face_kind");
  require_shape(face_slabs, "face_slab");
  std::shared_ptr<Surface> surface = Rebuild(vertices, faces).run();
  if (kinds.shape(0) != vertices.shape(0) || origins.shape(0) != vertices.shape(0) ||
      face_kinds.shape(0) != faces.shape(0) || face_slabs.shape(0) != faces.shape(0))
    throw InputError("one origin a vertex, and one kind and slab a face, are wanted");
  for (py::ssize_t i = 0; i < vertices.shape(0); ++i)
    surface->data(Vertex(static_cast<int>(i))).origin = {
        static_cast<VertexKind>(std::min<std::uint8_t>(kinds.at(i), 3)),
        static_cast<std::uint32_t>(origins.at(i, 0)), static_cast<std::uint32_t>(origins.at(i, 1)),
        static_cast<std::uint32_t>(origins.at(i, 2))};
  for (py::ssize_t i = 0; i < faces.shape(0); ++i) {
    const Surface::FaceHandle face(static_cast<int>(i));
    surface->data(face).kind = static_cast<FaceKind>(std::min<std::uint8_t>(face_kinds.at(i), 3));
    surface->data(face).slab = face_slabs.at(i);
  }
  return SharedSurface(surface);
}

py::dict measures(const SharedSurface& shared) {
  return measures_dict(
      result_of(py::none(), [surface = shared.get()](Job&) { return measure(*surface); }));
}

py::list faults(const SharedSurface& shared) {
  return finding_list(
      result_of(py::none(), [surface = shared.get()](Job&) { return check(*surface); }));
}

}  // namespace

void add_surface(py::module_& module) {
  py::class_<SharedSurface>(module, "Surface")
      .def("vertices", &vertices)
      .def("faces", &faces)
      .def("vertex_count", [](const SharedSurface& s) { return s.get()->n_vertices(); })
      .def("face_count", [](const SharedSurface& s) { return s.get()->n_faces(); })
      .def("origins", &origins)
      .def("face_data", &face_data)
      .def("measures", &measures)
      .def("check", &faults);
  module.def("surface_from_arrays", &surface_of_arrays);
}

}  // namespace loft::python
