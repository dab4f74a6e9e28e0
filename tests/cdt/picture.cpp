// SPDX-License-Identifier: MIT
#include "tests/cdt/picture.h"

#include <algorithm>
#include <map>
#include <ostream>
#include <sstream>
#include <utility>

namespace loft::cdt {

namespace {

std::ostream& operator<<(std::ostream& out, const Corners& corners) {
  return out << "triangle " << corners[0] << corners[1] << corners[2];
}

std::ostream& operator<<(std::ostream& out, const Line& line) {
  out << "edge " << line.low << line.high << " with";
  for (const Run& run : line.runs)
    out << ' ' << run.constraint << '.' << run.segment << (run.upward ? "up" : "down");
  return out;
}

Line line_of(const Triangulation& mesh, EdgeId e,
             const std::map<ConstraintId, std::size_t>& names) {
  Line line{mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), {}};
  if (line.high < line.low) std::swap(line.low, line.high);
  for (const Passage passage : mesh.passages(e)) {
    const ConstraintId c = mesh.segment(passage.segment()).constraint;
    line.runs.push_back({names.at(c), passage.segment().index() - mesh.first_segment(c).index(),
                         passage.is_upward()});
  }
  std::ranges::sort(line.runs);
  return line;
}

Corners corners_of(const Triangulation& mesh, TriangleId t) {
  const EdgeId e = Triangulation::edge(t);
  Corners corners{mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))};
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  return corners;
}

/// The first difference of two sorted lists; false if there is none.
template <class Item>
bool tell_difference(std::ostream& out, const std::vector<Item>& actual,
                     const std::vector<Item>& expected) {
  const auto [a, e] = std::ranges::mismatch(actual, expected);
  if (a == actual.end() && e == expected.end()) return false;
  out << "there is ";
  a == actual.end() ? out << "no more" : out << *a;
  out << ", expected was ";
  e == expected.end() ? out << "no more" : out << *e;
  return true;
}

}  // namespace

Picture picture_of(const Triangulation& mesh, std::span<const ConstraintId> ids) {
  std::map<ConstraintId, std::size_t> names;
  for (std::size_t i = 0; i < ids.size(); ++i) names[ids[i]] = i;
  Picture picture;
  for (std::uint32_t v = 1; v < mesh.vertex_bound(); ++v)
    if (mesh.is_vertex(VertexId(v))) picture.vertices.push_back(mesh.point(VertexId(v)));
  for (std::uint32_t t = 0; t < mesh.triangle_bound(); ++t) {
    if (!mesh.is_triangle(TriangleId(t))) continue;
    if (!mesh.is_infinite(TriangleId(t)))
      picture.triangles.push_back(corners_of(mesh, TriangleId(t)));
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(TriangleId(t), corner);
      if (mesh.is_constrained(e) && e < mesh.twin(e))
        picture.lines.push_back(line_of(mesh, e, names));
    }
  }
  std::ranges::sort(picture.vertices);
  std::ranges::sort(picture.triangles);
  std::ranges::sort(picture.lines, {}, [](const Line& l) { return std::pair(l.low, l.high); });
  return picture;
}

std::string difference(const Picture& actual, const Picture& expected) {
  std::ostringstream words;
  words.precision(17);
  if (!tell_difference(words, actual.vertices, expected.vertices) &&
      !tell_difference(words, actual.lines, expected.lines))
    tell_difference(words, actual.triangles, expected.triangles);
  return words.str();
}

}  // namespace loft::cdt
