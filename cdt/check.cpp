// SPDX-License-Identifier: MIT
#include "cdt/check.h"

#include <algorithm>
#include <sstream>

#include "cdt/predicates.h"
#include "cdt/rounding.h"

namespace loft::cdt {

namespace {

using Findings = std::vector<Finding>;

template <class... Words>
void report(Findings& findings, Fault fault, EdgeId e, const Words&... words) {
  std::ostringstream message;
  (message << ... << words);
  findings.push_back({fault, e, SegmentId::none(), message.str()});
}

std::vector<EdgeId> edges_of(const Triangulation& mesh) {
  std::vector<EdgeId> edges;
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i)
    if (mesh.is_triangle(TriangleId(i / 3))) edges.emplace_back(i);
  return edges;
}

void check_topology(const Triangulation& mesh, Findings& findings) {
  for (const EdgeId e : edges_of(mesh)) {
    const EdgeId f = mesh.twin(e);
    if (!mesh.is_triangle(Triangulation::triangle(f)) || mesh.twin(f) != e) {
      report(findings, Fault::topology, e, "the twin of ", e, " is ", f, ", not the reverse");
    } else if (mesh.from(f) != mesh.to(e) || mesh.to(f) != mesh.from(e)) {
      report(findings, Fault::topology, e, e, " and its twin join different vertices");
    } else if (mesh.passages(e).size() != mesh.passages(f).size() ||
               !std::ranges::equal(mesh.passages(e), mesh.passages(f))) {
      report(findings, Fault::topology, e, e, " and its twin have different passages");
    }
  }
  if (mesh.vertex_count() < 2) return;
  for (std::uint32_t v = 0; v < mesh.vertex_bound(); ++v) {
    if (v > 0 && !mesh.is_vertex(VertexId(v))) continue;
    const EdgeId e = mesh.edge(VertexId(v));
    if (!mesh.is_triangle(Triangulation::triangle(e)) || mesh.from(e) != VertexId(v))
      report(findings, Fault::topology, e, "the edge of ", VertexId(v), " starts elsewhere");
  }
  if (mesh.triangle_count() != 2 * mesh.vertex_count() - 2)
    report(findings, Fault::topology, EdgeId::none(), mesh.triangle_count(), " triangles for ",
           mesh.vertex_count(), " vertices");
}

void check_orientation(const Triangulation& mesh, Findings& findings) {
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
    const EdgeId e = Triangulation::edge(TriangleId(i));
    if (!mesh.is_triangle(TriangleId(i)) || mesh.is_infinite(TriangleId(i))) continue;
    if (orient(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))) <= 0)
      report(findings, Fault::inverted, e, TriangleId(i), " is not counter-clockwise");
  }
  // The hull, clockwise: the finite edges of the infinite triangles.
  for (const EdgeId e : edges_of(mesh)) {
    if (mesh.apex(e) != Triangulation::infinite) continue;
    const EdgeId ahead = Triangulation::next(mesh.twin(Triangulation::next(e)));
    if (orient(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.to(ahead))) > 0)
      report(findings, Fault::inverted, e, "the hull is not convex at ", mesh.to(e));
  }
}

void check_delaunay(const Triangulation& mesh, Findings& findings) {
  for (const EdgeId e : edges_of(mesh)) {
    const EdgeId f = mesh.twin(e);
    if (f < e || mesh.is_constrained(e) || mesh.is_infinite(Triangulation::triangle(e)) ||
        mesh.is_infinite(Triangulation::triangle(f)))
      continue;
    if (in_circle_perturbed(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)),
                            mesh.point(mesh.apex(e)), mesh.point(mesh.apex(f))) > 0)
      report(findings, Fault::delaunay, e, e, " is not Delaunay");
  }
}

/// Names the first vertex on the way of a segment that is too far from it.
void check_line(const Triangulation& mesh, SegmentId s, const std::vector<EdgeId>& pieces,
                Findings& findings) {
  const Point a = mesh.point(mesh.segment(s).from);
  const Point b = mesh.point(mesh.segment(s).to);
  const auto is_astray = [&](EdgeId e) {
    const VertexId v = mesh.to(e);
    const Point p = mesh.point(v);
    return !rounds_to(a, b, p) && exact_distance(a, b, p) > most_astray(a, b) &&
           !mesh.has_own_point(v);
  };
  const auto found = std::ranges::find_if(pieces, is_astray);
  if (found == pieces.end()) return;
  const VertexId v = mesh.to(*found);
  std::ostringstream message;
  message << s << " from " << mesh.segment(s).from << " to " << mesh.segment(s).to
          << " leads through " << v << ", which is off its line by "
          << exact_distance(a, b, mesh.point(v));
  findings.push_back({Fault::astray, EdgeId::none(), s, message.str()});
}

void check_cover(const Triangulation& mesh, Findings& findings) {
  for (std::uint32_t i = 0; i < mesh.segment_bound(); ++i) {
    const SegmentId s(i);
    if (!mesh.is_segment(s)) continue;
    const Segment& segment = mesh.segment(s);
    if (segment.from == segment.to) continue;
    const auto pieces = mesh.pieces(s);
    if (!pieces.empty() && mesh.to(pieces.back()) == segment.to) {
      if (mesh.epsilon() == 0) check_line(mesh, s, pieces, findings);
      continue;
    }
    std::ostringstream message;
    message << s << " from " << segment.from << " to " << segment.to << " ends after "
            << pieces.size() << " pieces";
    findings.push_back({Fault::uncovered, EdgeId::none(), s, message.str()});
  }
}

}  // namespace

std::vector<Finding> check(const Triangulation& mesh) {
  Findings findings;
  check_topology(mesh, findings);
  if (!findings.empty()) return findings;
  check_orientation(mesh, findings);
  check_delaunay(mesh, findings);
  check_cover(mesh, findings);
  return findings;
}

}  // namespace loft::cdt
