// SPDX-License-Identifier: MIT
#include "io/planar/map_svg.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "io/planar/planar_mesh.h"

namespace loft::io {

namespace {

/// What is drawn of a map, and which feature each of it belongs to.
struct Outlines {
  std::vector<cdt::Polyline> polylines = {};  // views into the map
  std::vector<std::size_t> features = {};     // one a polyline

  void add(std::size_t feature, std::span<const cdt::Point> points, cdt::Ends ends) {
    polylines.push_back({points, ends});
    features.push_back(feature);
  }

  void add_all(std::size_t number, const Feature& feature) {
    for (const overlay::Polygon& polygon : feature.polygons) {
      add(number, polygon.outer, cdt::closed);
      for (const overlay::Ring& hole : polygon.holes) add(number, hole, cdt::closed);
    }
    for (const auto& line : feature.lines) add(number, line, cdt::open);
    for (const cdt::Point& point : feature.points) add(number, {&point, 1}, cdt::open);
  }
};

Outlines outlines_of(const Map& map) {
  Outlines outlines;
  for (std::size_t i = 0; i < map.features.size(); ++i) outlines.add_all(i, map.features[i]);
  return outlines;
}

/// Features without a name are told apart by their numbers.
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const Feature& feature : map.features)
    names.push_back(property(feature, "name").value_or(std::to_string(names.size())));
  return names;
}

}  // namespace

void write_map_svg(std::ostream& out, const Map& map, const SvgOptions& options) {
  const Outlines outlines = outlines_of(map);
  const std::vector<std::string> names = names_of(map);
  cdt::Triangulation mesh;
  std::vector<NamedConstraint> constraints;
  for (const cdt::ConstraintId id : mesh.insert(outlines.polylines))
    constraints.push_back({id, names[outlines.features[constraints.size()]]});
  SvgOptions without_edges = options;
  without_edges.has_edges = false;
  write_svg(out, to_planar_mesh(mesh, constraints), without_edges);
}

}  // namespace loft::io
