// SPDX-License-Identifier: MIT
#include "io/meshes.h"

#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mesh/admitted.h"
#include "mesh/check.h"
#include "mesh/measure.h"
#include "mesh/sections.h"
#include "python/binding/arrays.h"
#include "python/binding/job.h"
#include "python/binding/measures.h"
#include "python/binding/parts.h"

namespace loft::python {

namespace {

Mesh mesh_of(const Array<double>& vertices, const Array<std::uint32_t>& faces) {
  require_shape(vertices, "vertices", 3);
  require_shape(faces, "faces", 3);
  Mesh mesh;
  for (py::ssize_t i = 0; i < vertices.shape(0); ++i)
    mesh.points.push_back({*vertices.data(i, 0), *vertices.data(i, 1), *vertices.data(i, 2)});
  for (py::ssize_t i = 0; i < faces.shape(0); ++i)
    mesh.faces.push_back({*faces.data(i, 0), *faces.data(i, 1), *faces.data(i, 2)});
  return mesh;
}

/// Throws InputError unless faces name vertices and coordinates are finite.
void require_whole(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    for (const std::uint32_t corner : mesh.faces[i])
      if (corner >= mesh.points.size())
        throw InputError("face " + std::to_string(i) + ": there is no vertex " +
                         std::to_string(corner));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (const double coordinate : mesh.points[i])
      if (!admitted::mesh.admits(coordinate))
        throw InputError("vertex " + std::to_string(i) + ": a coordinate is out of range");
}

py::list read_meshes(const std::string& path) {
  std::vector<io::LabelledMesh> meshes =
      result_of(py::none(), [path](Job&) { return io::read_meshes(path); });
  py::list list;
  for (io::LabelledMesh& part : meshes)
    list.append(py::make_tuple(part.label, to_array(std::move(part.mesh.points)),
                               to_array(std::move(part.mesh.faces))));
  return list;
}

py::list check_mesh(const Array<double>& vertices, const Array<std::uint32_t>& faces) {
  return finding_list(
      result_of(py::none(), [mesh = mesh_of(vertices, faces)](Job&) { return check(mesh); }));
}

py::dict measure_mesh(const Array<double>& vertices, const Array<std::uint32_t>& faces) {
  Mesh mesh = mesh_of(vertices, faces);
  require_whole(mesh);
  return measures_dict(
      result_of(py::none(), [mesh = std::move(mesh)](Job&) { return measure(mesh); }));
}

std::vector<double> heights_of(const Array<double>& given) {
  require_shape(given, "heights");
  std::vector<double> heights;
  for (py::ssize_t i = 0; i < given.shape(0); ++i) {
    if (!admitted::slice.admits(given.at(i))) throw InputError("heights: one is out of range");
    heights.push_back(given.at(i));
  }
  return heights;
}

/// (z, outlines, number of open lines) of each height.
py::list cut(const Array<double>& vertices, const Array<std::uint32_t>& faces,
             const Array<double>& heights) {
  Mesh mesh = mesh_of(vertices, faces);
  require_whole(mesh);
  const std::vector<Section> made = result_of(
      py::none(),
      [mesh = std::move(mesh), at = heights_of(heights)](Job&) { return sections(mesh, at); });
  py::list list;
  for (const Section& section : made) {
    py::list outlines;
    for (const auto& outline : section.outlines) {
      std::vector<std::array<double, 2>> points;
      for (const cdt::Point& p : outline) points.push_back({p.x, p.y});
      outlines.append(to_array(std::move(points)));
    }
    list.append(py::make_tuple(section.z, outlines, section.open));
  }
  return list;
}

}  // namespace

py::dict measures_dict(const Measures& measures) {
  using namespace py::literals;
  return py::dict(
      "vertices"_a = measures.vertices, "edges"_a = measures.edges, "faces"_a = measures.faces,
      "components"_a = measures.components, "genus"_a = measures.genus, "area"_a = measures.area,
      "volume"_a = measures.volume, "smallest_angle"_a = measures.angles.smallest,
      "fifth_percentile_angle"_a = measures.angles.fifth_percentile,
      "median_angle"_a = measures.angles.median, "worst_aspect"_a = measures.angles.worst_aspect);
}

py::list finding_list(std::span<const Finding> findings) {
  py::list list;
  for (const Finding& finding : findings)
    list.append(py::make_tuple(name(finding.fault), finding.faces, finding.vertices));
  return list;
}

void add_meshes(py::module_& module) {
  module.def("read_meshes", &read_meshes);
  module.def("check", &check_mesh);
  module.def("measure", &measure_mesh);
  module.def("sections", &cut);
}

}  // namespace loft::python
