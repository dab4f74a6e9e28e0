// SPDX-License-Identifier: MIT
#include "cdt/triangulation.h"

#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cdt/check.h"
#include "cdt/persist.h"
#include "cdt/queries.h"
#include "cdt/regions.h"
#include "python/binding/arrays.h"
#include "python/binding/in_turn.h"
#include "python/binding/job.h"
#include "python/binding/parts.h"

namespace loft::python {

namespace {

/// Vertices and finite triangles, counted without gaps, in the order of their ids.
struct Numbering {
  std::vector<std::array<double, 2>> points;
  std::vector<std::uint32_t> vertex_ids;
  std::vector<std::uint32_t> vertex_numbers;  ///< by id
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> triangle_ids;
  std::vector<std::int64_t> triangle_numbers;  ///< by id; -1: infinite, or none
};

using NumberingPointer = std::shared_ptr<const Numbering>;

Numbering numbering_of(const cdt::Triangulation& mesh) {
  Numbering made;
  made.vertex_numbers.resize(mesh.vertex_bound());
  for (std::uint32_t id = 0; id < mesh.vertex_bound(); ++id) {
    const cdt::VertexId v(id);
    if (!mesh.is_vertex(v)) continue;
    made.vertex_numbers[id] = static_cast<std::uint32_t>(made.points.size());
    made.points.push_back({mesh.point(v).x, mesh.point(v).y});
    made.vertex_ids.push_back(id);
  }
  made.triangle_numbers.assign(mesh.triangle_bound(), -1);
  for (std::uint32_t id = 0; id < mesh.triangle_bound(); ++id) {
    const cdt::TriangleId t(id);
    if (!mesh.is_triangle(t) || mesh.is_infinite(t)) continue;
    made.triangle_numbers[id] = static_cast<std::int64_t>(made.triangles.size());
    std::array<std::uint32_t, 3>& corners = made.triangles.emplace_back();
    for (unsigned i = 0; i < 3; ++i)
      corners[i] = made.vertex_numbers[mesh.from(cdt::Triangulation::edge(t, i)).index()];
    made.triangle_ids.push_back(id);
  }
  return made;
}

/// A triangulation, and its arrays as long as they are those of its present state.
struct Plane {
  cdt::Triangulation mesh;
  NumberingPointer numbering{};

  const NumberingPointer& numbered() {
    if (!numbering) numbering = std::make_shared<const Numbering>(numbering_of(mesh));
    return numbering;
  }

  /// work(mesh); what has no room for it is empty afterwards.
  template <class Work>
  auto edit(Work work) {
    numbering.reset();
    try {
      return work(mesh);
    } catch (const std::length_error&) {
      mesh.clear();
      throw;
    } catch (const std::bad_alloc&) {
      mesh.clear();
      throw;
    }
  }
};

using SharedPlane = InTurn<Plane>;
using PlanePointer = std::shared_ptr<SharedPlane>;

PlanePointer shared_plane(cdt::Triangulation mesh) {
  return std::make_shared<SharedPlane>(std::in_place, std::move(mesh));
}

/// work(plane): at once where it has to do with few points, else so that Ctrl-C is heard. `work`
/// owns what it uses.
template <class Work>
auto use_plane(const PlanePointer& plane, std::size_t points, Work work) {
  constexpr std::size_t few = 256;
  if (points <= few) return plane->use(std::move(work));
  return result_of(py::none(),
                   [plane, work = std::move(work)](Job&) { return plane->use_in_job(work); });
}

std::vector<cdt::Point> points_of(const Array<double>& array, const char* what = "points") {
  require_shape(array, what, 2);
  std::vector<cdt::Point> points;
  points.reserve(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    points.push_back({*array.data(i, 0), *array.data(i, 1)});
  return points;
}

py::array point_array(const std::vector<cdt::Point>& points) {
  std::vector<std::array<double, 2>> rows;
  rows.reserve(points.size());
  for (const cdt::Point p : points) rows.push_back({p.x, p.y});
  return to_array(std::move(rows));
}

template <class IdType>
std::vector<std::uint32_t> numbers_of(const std::vector<IdType>& ids) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(ids.size());
  for (const IdType id : ids) numbers.push_back(id.index());
  return numbers;
}

void require_constraint(const cdt::Triangulation& mesh, cdt::ConstraintId id) {
  if (!mesh.is_constraint(id))
    throw InputError("there is no constraint " + std::to_string(id.index()));
}

void require_places(const std::vector<cdt::Point>& points) {
  for (const cdt::Point p : points)
    if (!cdt::Triangulation::is_usable(p))
      throw InputError("coordinates must be 0 or between 1e-50 and 1e75 in magnitude, and finite");
}

// --- Edits ---

std::uint32_t insert_line(const PlanePointer& plane, const Array<double>& array, bool is_closed) {
  const std::vector<cdt::Point> points = points_of(array);
  return use_plane(plane, points.size(), [points, is_closed](Plane& there) {
    return there.edit([&](cdt::Triangulation& mesh) {
      return mesh.insert(points, is_closed ? cdt::closed : cdt::open).index();
    });
  });
}

/// Lines one behind the other: where each begins in the points, and whether it is closed.
class Lines {
 public:
  Lines(const Array<double>& points, const Array<std::int64_t>& offsets,
        const Array<std::uint8_t>& are_closed)
      : points_(points_of(points)) {
    require_shape(offsets, "offsets");
    require_shape(are_closed, "closed");
    if (offsets.shape(0) != are_closed.shape(0) + 1)
      throw InputError("offsets: one for each line, and one more, are wanted");
    const auto bound = static_cast<std::int64_t>(points_.size());
    for (py::ssize_t i = 0; i < are_closed.shape(0); ++i) {
      if (offsets.at(i) < 0 || offsets.at(i + 1) < offsets.at(i) || offsets.at(i + 1) > bound)
        throw InputError("offsets: they must not fall, nor lead beyond the points");
      begins_.push_back(static_cast<std::size_t>(offsets.at(i)));
      ends_.push_back(static_cast<std::size_t>(offsets.at(i + 1)));
      are_closed_.push_back(are_closed.at(i) != 0);
    }
  }

  [[nodiscard]] std::size_t point_count() const { return points_.size(); }

  [[nodiscard]] std::vector<cdt::Polyline> polylines() const {
    std::vector<cdt::Polyline> lines;
    for (std::size_t i = 0; i < begins_.size(); ++i)
      lines.push_back({std::span(points_).subspan(begins_[i], ends_[i] - begins_[i]),
                       are_closed_[i] ? cdt::closed : cdt::open});
    return lines;
  }

 private:
  std::vector<cdt::Point> points_;
  std::vector<std::size_t> begins_;
  std::vector<std::size_t> ends_;
  std::vector<bool> are_closed_;
};

std::vector<std::uint32_t> insert_lines(const PlanePointer& plane, const Array<double>& points,
                                        const Array<std::int64_t>& offsets,
                                        const Array<std::uint8_t>& are_closed) {
  const Lines lines(points, offsets, are_closed);
  return use_plane(plane, lines.point_count(), [lines](Plane& there) {
    return there.edit(
        [&](cdt::Triangulation& mesh) { return numbers_of(mesh.insert(lines.polylines())); });
  });
}

std::uint32_t insert_vertex(const PlanePointer& plane, double x, double y) {
  return plane->use([=](Plane& there) {
    return there.edit([&](cdt::Triangulation& mesh) {
      return mesh.insert(cdt::Point{x, y}).index();
    });
  });
}

void move_line(const PlanePointer& plane, std::uint32_t id, const Array<double>& array) {
  const std::vector<cdt::Point> points = points_of(array);
  use_plane(plane, points.size(), [id, points](Plane& there) {
    return there.edit([&](cdt::Triangulation& mesh) {
      mesh.move(cdt::ConstraintId(id), points);
      return true;
    });
  });
}

/// 0 where there is none.
std::size_t line_size(const PlanePointer& plane, std::uint32_t id) {
  return plane->use([=](Plane& there) {
    const cdt::ConstraintId line(id);
    return there.mesh.is_constraint(line) ? there.mesh.segments(line).size() : 0;
  });
}

void translate_line(const PlanePointer& plane, std::uint32_t id, double x, double y) {
  use_plane(plane, line_size(plane, id), [=](Plane& there) {
    return there.edit([&](cdt::Triangulation& mesh) {
      mesh.translate(cdt::ConstraintId(id), cdt::Point{x, y});
      return true;
    });
  });
}

void remove_line(const PlanePointer& plane, std::uint32_t id) {
  use_plane(plane, line_size(plane, id), [=](Plane& there) {
    return there.edit([&](cdt::Triangulation& mesh) {
      mesh.remove(cdt::ConstraintId(id));
      return true;
    });
  });
}

void remove_vertex(const PlanePointer& plane, std::uint32_t id) {
  plane->use([=](Plane& there) {
    return there.edit([&](cdt::Triangulation& mesh) { mesh.remove(cdt::VertexId(id)); });
  });
}

void clear_plane(const PlanePointer& plane) {
  plane->use([](Plane& there) { there.edit([](cdt::Triangulation& mesh) { mesh.clear(); }); });
}

// --- Arrays ---

NumberingPointer numbered(const PlanePointer& plane) {
  return plane->use([](Plane& there) { return there.numbered(); });
}

py::array place_view(const NumberingPointer& made) {
  return view(made->points.empty() ? nullptr : made->points.front().data(),
              {static_cast<py::ssize_t>(made->points.size()), 2}, made);
}

py::array corner_view(const NumberingPointer& made) {
  return view(made->triangles.empty() ? nullptr : made->triangles.front().data(),
              {static_cast<py::ssize_t>(made->triangles.size()), 3}, made);
}

/// Places, corners, ids of vertices, ids of triangles; views of what never changes.
py::tuple plane_arrays(const PlanePointer& plane) {
  const NumberingPointer made = numbered(plane);
  return py::make_tuple(
      place_view(made), corner_view(made),
      view(made->vertex_ids.data(), {static_cast<py::ssize_t>(made->vertex_ids.size())}, made),
      view(made->triangle_ids.data(), {static_cast<py::ssize_t>(made->triangle_ids.size())}, made));
}

struct ConstrainedEdges {
  std::vector<std::array<std::uint32_t, 2>> ends;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::uint32_t> constraints;
};

ConstrainedEdges constrained_edges(Plane& there) {
  const cdt::Triangulation& mesh = there.mesh;
  const std::vector<std::uint32_t>& numbers = there.numbered()->vertex_numbers;
  ConstrainedEdges edges;
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const cdt::EdgeId e(i);
    if (!mesh.is_triangle(cdt::Triangulation::triangle(e)) || !mesh.is_constrained(e)) continue;
    if (mesh.twin(e) < e) continue;
    edges.ends.push_back({numbers[mesh.from(e).index()], numbers[mesh.to(e).index()]});
    for (const cdt::ConstraintId id : mesh.constraints(e)) edges.constraints.push_back(id.index());
    edges.offsets.push_back(static_cast<std::int64_t>(edges.constraints.size()));
  }
  return edges;
}

py::tuple edge_arrays(const PlanePointer& plane) {
  ConstrainedEdges edges = plane->use([](Plane& there) { return constrained_edges(there); });
  return py::make_tuple(to_array(std::move(edges.ends)), to_array(std::move(edges.offsets)),
                        to_array(std::move(edges.constraints)));
}

py::array constraint_ids(const PlanePointer& plane) {
  return to_array(plane->use([](Plane& there) {
    std::vector<std::uint32_t> ids;
    for (std::uint32_t id = 0; id < there.mesh.constraint_bound(); ++id)
      if (there.mesh.is_constraint(cdt::ConstraintId(id))) ids.push_back(id);
    return ids;
  }));
}

py::array line_points(const PlanePointer& plane, std::uint32_t id) {
  return point_array(plane->use([=](Plane& there) {
    require_constraint(there.mesh, cdt::ConstraintId(id));
    return there.mesh.points(cdt::ConstraintId(id));
  }));
}

bool is_line_closed(const PlanePointer& plane, std::uint32_t id) {
  return plane->use([=](Plane& there) {
    require_constraint(there.mesh, cdt::ConstraintId(id));
    return there.mesh.ends(cdt::ConstraintId(id)) == cdt::closed;
  });
}

/// The vertices that a constraint leads through, by their numbers; the first one again where it is
/// closed.
py::array line_path(const PlanePointer& plane, std::uint32_t id) {
  return to_array(plane->use([=](Plane& there) {
    const cdt::ConstraintId line(id);
    require_constraint(there.mesh, line);
    const std::vector<std::uint32_t>& numbers = there.numbered()->vertex_numbers;
    std::vector<std::uint32_t> path{numbers[there.mesh.first_vertex(line).index()]};
    for (const cdt::EdgeId e : there.mesh.pieces(line))
      path.push_back(numbers[there.mesh.to(e).index()]);
    return path;
  }));
}

std::vector<std::uint32_t> lines_at(const PlanePointer& plane, std::uint32_t id) {
  return plane->use([=](Plane& there) {
    if (!there.mesh.is_vertex(cdt::VertexId(id)))
      throw InputError("there is no vertex " + std::to_string(id));
    return numbers_of(there.mesh.constraints(cdt::VertexId(id)));
  });
}

// --- Questions ---

/// A finite triangle at a place; none beyond the hull.
std::optional<cdt::TriangleId> finite_triangle(const cdt::Triangulation& mesh,
                                               const cdt::Location& location) {
  using Kind = cdt::Location::Kind;
  if (location.kind == Kind::outside || location.kind == Kind::nowhere) return {};
  cdt::EdgeId e = location.edge;
  do {
    const cdt::TriangleId t = cdt::Triangulation::triangle(e);
    if (!mesh.is_infinite(t)) return t;
    e = location.kind == Kind::vertex ? mesh.rotated(e) : mesh.twin(e);
  } while (e != location.edge);
  return {};
}

bool may_be_inside(cdt::Point p) {
  constexpr double most = cdt::Triangulation::largest_coordinate;
  return std::abs(p.x) <= most && std::abs(p.y) <= most;
}

py::array triangles_at(const PlanePointer& plane, const Array<double>& array) {
  const std::vector<cdt::Point> points = points_of(array);
  return to_array(use_plane(plane, points.size(), [points](Plane& there) {
    std::vector<std::int64_t> found;
    found.reserve(points.size());
    const NumberingPointer made = there.numbered();
    for (const cdt::Point p : points) {
      std::optional<cdt::TriangleId> t;
      if (may_be_inside(p)) t = finite_triangle(there.mesh, there.mesh.locate(p));
      found.push_back(t ? made->triangle_numbers[t->index()] : -1);
    }
    return found;
  }));
}

py::array nearest_vertices(const PlanePointer& plane, const Array<double>& array) {
  const std::vector<cdt::Point> points = points_of(array);
  require_places(points);
  return to_array(use_plane(plane, points.size(), [points](Plane& there) {
    std::vector<std::int64_t> found;
    found.reserve(points.size());
    const NumberingPointer made = there.numbered();
    for (const cdt::Point p : points) {
      const cdt::VertexId v = cdt::nearest_vertex(there.mesh, p);
      found.push_back(v.is_none() ? -1 : std::int64_t{made->vertex_numbers[v.index()]});
    }
    return found;
  }));
}

/// Those that count for regions, by id: the closed ones, or those of them that are wanted.
std::vector<bool> chosen_lines(const cdt::Triangulation& mesh,
                               const std::optional<std::vector<std::uint32_t>>& wanted) {
  std::vector<bool> is_chosen(mesh.constraint_bound());
  const auto is_closed = [&](std::uint32_t id) {
    return mesh.ends(cdt::ConstraintId(id)) == cdt::closed;
  };
  if (wanted) {
    for (const std::uint32_t id : *wanted) {
      require_constraint(mesh, cdt::ConstraintId(id));
      if (!is_closed(id)) throw InputError("constraint " + std::to_string(id) + " is not closed");
      is_chosen[id] = true;
    }
    return is_chosen;
  }
  for (std::uint32_t id = 0; id < is_chosen.size(); ++id)
    is_chosen[id] = mesh.is_constraint(cdt::ConstraintId(id)) && is_closed(id);
  return is_chosen;
}

/// How often closed constraints wind around each triangle; with the places and corners that these
/// had then.
py::tuple winding_arrays(const PlanePointer& plane,
                         const std::optional<std::vector<std::uint32_t>>& wanted) {
  auto [made, windings] = plane->use([&](Plane& there) {
    const std::vector<bool> is_chosen = chosen_lines(there.mesh, wanted);
    const std::vector<int> by_id = cdt::winding_numbers(
        there.mesh, [&](cdt::ConstraintId id) { return is_chosen[id.index()]; });
    const NumberingPointer numbers = there.numbered();
    std::vector<std::int32_t> numbered_windings;
    for (const std::uint32_t id : numbers->triangle_ids) numbered_windings.push_back(by_id[id]);
    return std::pair(numbers, std::move(numbered_windings));
  });
  return py::make_tuple(to_array(std::move(windings)), place_view(made), corner_view(made));
}

py::tuple changed_triangles(const PlanePointer& plane) {
  auto changes = plane->use([](Plane& there) { return there.mesh.changes(); });
  return py::make_tuple(to_array(numbers_of(changes.unmade)), to_array(numbers_of(changes.made)));
}

void record_changes(const PlanePointer& plane, bool is_on) {
  plane->use([=](Plane& there) { there.mesh.record_changes(is_on); });
}

py::tuple snap_arrays(const PlanePointer& plane) {
  auto [lines, places] = plane->use([](Plane& there) {
    std::vector<std::uint32_t> ids;
    std::vector<cdt::Point> points;
    for (const cdt::Snap& snap : there.mesh.snaps()) {
      ids.push_back(there.mesh.segment(snap.segment).constraint.index());
      points.push_back(snap.place);
    }
    return std::pair(std::move(ids), std::move(points));
  });
  return py::make_tuple(to_array(std::move(lines)), point_array(places));
}

const char* word_for(cdt::Fault fault) {
  switch (fault) {
    case cdt::Fault::topology:
      return "topology";
    case cdt::Fault::inverted:
      return "inverted";
    case cdt::Fault::delaunay:
      return "delaunay";
    case cdt::Fault::uncovered:
      return "uncovered";
    case cdt::Fault::astray:
      return "astray";
  }
  return "";
}

py::list plane_faults(const PlanePointer& plane) {
  const auto findings = result_of(py::none(), [plane](Job&) {
    return plane->use_in_job([](Plane& there) { return cdt::check(there.mesh); });
  });
  py::list list;
  for (const cdt::Finding& finding : findings)
    list.append(py::make_tuple(word_for(finding.fault), finding.message));
  return list;
}

py::tuple plane_counts(const PlanePointer& plane) {
  const auto [vertices, constraints] = plane->use([](Plane& there) {
    return std::pair(there.mesh.vertex_count(), there.mesh.constraint_count());
  });
  return py::make_tuple(vertices, numbered(plane)->triangles.size(), constraints);
}

// --- Copies ---

PlanePointer copy_of(const PlanePointer& plane) {
  return shared_plane(plane->use([](Plane& there) { return there.mesh; }));
}

py::bytes plane_bytes(const PlanePointer& plane) {
  return plane->use([](Plane& there) {
    std::ostringstream out;
    cdt::save(there.mesh, out, cdt::Form::binary);
    return std::move(out).str();
  });
}

PlanePointer plane_of_bytes(const py::bytes& bytes) {
  return result_of(py::none(), [text = std::string(bytes)](Job&) {
    std::istringstream in(text);
    return shared_plane(cdt::load(in));
  });
}

}  // namespace

void add_triangulation(py::module_& module) {
  py::class_<SharedPlane, PlanePointer>(module, "Triangulation")
      .def(py::init([](double epsilon) { return shared_plane(cdt::Triangulation(epsilon)); }))
      .def("epsilon",
           [](const PlanePointer& plane) {
             return plane->use([](Plane& there) { return there.mesh.epsilon(); });
           })
      .def("insert", &insert_line)
      .def("insert_many", &insert_lines)
      .def("insert_point", &insert_vertex)
      .def("move", &move_line)
      .def("translate", &translate_line)
      .def("remove", &remove_line)
      .def("remove_point", &remove_vertex)
      .def("clear", &clear_plane)
      .def("arrays", &plane_arrays)
      .def("edges", &edge_arrays)
      .def("constraints", &constraint_ids)
      .def("points", &line_points)
      .def("is_closed", &is_line_closed)
      .def("path", &line_path)
      .def("constraints_at", &lines_at)
      .def("locate", &triangles_at)
      .def("nearest", &nearest_vertices)
      .def("winding_numbers", &winding_arrays)
      .def("record_changes", &record_changes)
      .def("changes", &changed_triangles)
      .def("snaps", &snap_arrays)
      .def("check", &plane_faults)
      .def("counts", &plane_counts)
      .def("copy", &copy_of)
      .def("to_bytes", &plane_bytes);
  module.def("triangulation_of_bytes", &plane_of_bytes);
}

}  // namespace loft::python
