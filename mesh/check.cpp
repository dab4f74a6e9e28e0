// SPDX-License-Identifier: MIT
#include "mesh/check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/admitted.h"
#include "mesh/meeting_faces.h"
#include "mesh/nesting.h"
#include "mesh/predicates.h"

namespace loft {

namespace {

using Findings = std::vector<Finding>;

bool names_all_vertices(const Mesh& mesh, std::uint32_t face) {
  return std::ranges::all_of(mesh.faces[face],
                             [&](std::uint32_t v) { return v < mesh.points.size(); });
}

bool is_finite(const Vec3& p) {
  return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

/// Whether exact tests can hold the place.
bool is_admitted(const Vec3& p) {
  return std::ranges::all_of(p, [](double x) { return admitted::mesh.admits(x); });
}

std::vector<std::uint32_t> faces_of(std::span<const EdgeSide> sides) {
  std::vector<std::uint32_t> result;
  for (const EdgeSide& side : sides) result.push_back(side.face);
  return result;
}

// --- Faces and vertices by themselves ---

void find_bad_indices(const Mesh& mesh, Findings& findings) {
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    if (!names_all_vertices(mesh, face)) findings.push_back({Fault::bad_index, {face}, {}});
  }
}

void find_not_finite(const Mesh& mesh, Findings& findings) {
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (!is_finite(mesh.points[v])) findings.push_back({Fault::not_finite, {}, {v}});
  }
}

void find_out_of_range(const Mesh& mesh, Findings& findings) {
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& point = mesh.points[v];
    if (is_finite(point) && !is_admitted(point)) findings.push_back({Fault::out_of_range, {}, {v}});
  }
}

/// Reports the faces without area; returns those that have one.
std::vector<std::uint32_t> find_degenerate_faces(const Mesh& mesh, Findings& findings) {
  std::vector<std::uint32_t> with_area;
  with_area.reserve(mesh.faces.size());
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    if (!names_all_vertices(mesh, face)) continue;
    const auto [a, b, c] = corners(mesh, face);
    if (!is_admitted(a) || !is_admitted(b) || !is_admitted(c)) continue;
    if (collinear(a, b, c)) {
      findings.push_back({Fault::degenerate_face, {face}, {}});
    } else {
      with_area.push_back(face);
    }
  }
  return with_area;
}

// --- Topology ---

bool is_inconsistent(const Mesh& mesh, std::span<const EdgeSide> sides) {
  return sides.size() == 2 && runs_up(mesh, sides[0]) == runs_up(mesh, sides[1]);
}

void find_edges(Fault fault, const Edges& edges, Findings& findings, const auto& is_at_fault) {
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges[e];
    if (!is_at_fault(sides)) continue;
    findings.push_back({fault, faces_of(sides), {sides[0].low, sides[0].high}});
  }
}

/// Faces that share an edge at a vertex are in the same fan of it: joins their corners there.
/// A corner is 3 * face + its place in the face.
DisjointSets fans(const Mesh& mesh, const Edges& edges) {
  const auto corner_at_low = [&](const EdgeSide& side) {
    return 3 * side.face + (runs_up(mesh, side) ? side.corner : (side.corner + 1) % 3);
  };
  const auto corner_at_high = [&](const EdgeSide& side) {
    return 3 * side.face + (runs_up(mesh, side) ? (side.corner + 1) % 3 : side.corner);
  };
  DisjointSets result(3 * mesh.faces.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const EdgeSide& side : edges[e].subspan(1)) {
      result.unite(corner_at_low(edges[e].front()), corner_at_low(side));
      result.unite(corner_at_high(edges[e].front()), corner_at_high(side));
    }
  }
  return result;
}

/// Reports each vertex of several fans, with one face of each.
void find_nonmanifold_vertices(const Mesh& mesh, std::span<const std::uint32_t> faces,
                               const Edges& edges, Findings& findings) {
  DisjointSets fan = fans(mesh, edges);
  std::vector<std::vector<std::uint32_t>> more_fans(mesh.points.size());
  std::vector<std::uint32_t> first_fan(mesh.points.size(),
                                       3 * static_cast<std::uint32_t>(mesh.faces.size()));
  for (const std::uint32_t face : faces) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = 3 * face + i;
      if (fan.find(corner) != corner) continue;  // each fan counts at its smallest corner
      const std::uint32_t vertex = mesh.faces[face][i];
      first_fan[vertex] = std::min(first_fan[vertex], corner);
      if (first_fan[vertex] != corner) more_fans[vertex].push_back(face);
    }
  }
  for (std::uint32_t v = 0; v < more_fans.size(); ++v) {
    if (more_fans[v].empty()) continue;
    more_fans[v].insert(more_fans[v].begin(), first_fan[v] / 3);
    findings.push_back({Fault::nonmanifold_vertex, std::move(more_fans[v]), {v}});
  }
}

// --- Geometry ---

/// For each face its component where that is closed and oriented and meets no other one, so that
/// inside and outside mean something; not_in_a_shell elsewhere.
std::vector<std::uint32_t> shell_components(const Mesh& mesh, const Edges& edges,
                                            std::span<const std::uint32_t> proper,
                                            std::span<const FacePair> meeting) {
  const std::vector<std::uint32_t> component = components(mesh, edges);
  std::vector<bool> is_shell(mesh.faces.size(), false);
  for (const std::uint32_t face : proper) is_shell[component[face]] = true;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges[e];
    if (sides.size() != 2 || is_inconsistent(mesh, sides))
      is_shell[component[sides[0].face]] = false;
  }
  for (const std::uint32_t face : proper) {
    if (!std::ranges::all_of(corners(mesh, face), is_admitted)) is_shell[component[face]] = false;
  }
  for (const auto& [f, g] : meeting) {
    if (component[f] != component[g]) is_shell[component[f]] = is_shell[component[g]] = false;
  }
  std::vector<std::uint32_t> result(mesh.faces.size(), not_in_a_shell);
  for (const std::uint32_t face : proper) {
    if (is_shell[component[face]]) result[face] = component[face];
  }
  return result;
}

/// A shell inside an even number of others looks outwards, a cavity inwards.
void find_inside_out(std::span<const Shell> shells, Findings& findings) {
  for (const Shell& shell : shells) {
    if (std::abs(shell.volume) <= shell.volume_error) continue;
    const bool should_look_outwards = shell.depth % 2 == 0;
    if ((shell.volume > 0) != should_look_outwards) {
      findings.push_back({Fault::inside_out, {shell.first_face}, {}});
    }
  }
}

}  // namespace

const char* name(Fault fault) {
  switch (fault) {
    case Fault::bad_index:
      return "bad_index";
    case Fault::not_finite:
      return "not_finite";
    case Fault::out_of_range:
      return "out_of_range";
    case Fault::degenerate_face:
      return "degenerate_face";
    case Fault::boundary_edge:
      return "boundary_edge";
    case Fault::nonmanifold_edge:
      return "nonmanifold_edge";
    case Fault::nonmanifold_vertex:
      return "nonmanifold_vertex";
    case Fault::inconsistent_edge:
      return "inconsistent_edge";
    case Fault::inside_out:
      return "inside_out";
    case Fault::self_intersection:
      return "self_intersection";
  }
  return "unknown";
}

std::size_t most_intersections(const Mesh& mesh) { return 100'000 + 4 * mesh.faces.size(); }

std::vector<Finding> check(const Mesh& mesh) {
  Findings findings;
  find_bad_indices(mesh, findings);
  find_not_finite(mesh, findings);
  find_out_of_range(mesh, findings);
  const std::vector<std::uint32_t> with_area = find_degenerate_faces(mesh, findings);

  const std::vector<std::uint32_t> proper = proper_faces(mesh);
  const Edges edges(mesh, proper);
  find_edges(Fault::boundary_edge, edges, findings, [](auto sides) { return sides.size() == 1; });
  find_edges(Fault::nonmanifold_edge, edges, findings, [](auto sides) { return sides.size() > 2; });
  find_nonmanifold_vertices(mesh, proper, edges, findings);
  find_edges(Fault::inconsistent_edge, edges, findings,
             [&](auto sides) { return is_inconsistent(mesh, sides); });

  const std::size_t most = most_intersections(mesh);
  const std::vector<FacePair> meeting = meeting_faces(mesh, with_area, most);
  if (meeting.size() < most) {
    const auto component = shell_components(mesh, edges, proper, meeting);
    find_inside_out(shells(mesh, component, with_area), findings);
  }
  for (const auto& [f, g] : meeting) findings.push_back({Fault::self_intersection, {f, g}, {}});
  return findings;
}

Contacts contacts(const Mesh& mesh) {
  const Edges edges(mesh, proper_faces(mesh));
  std::vector<std::uint32_t> used;
  for (std::size_t e = 0; e < edges.size(); ++e)
    used.insert(used.end(), {edges[e].front().low, edges[e].front().high});
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::ranges::sort(used, {}, [&](std::uint32_t v) { return std::pair(mesh.points[v], v); });

  Contacts result;
  std::vector<std::uint32_t> place_of(mesh.points.size());  // the first vertex at the same place
  bool is_counted = false;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const bool is_there = i > 0 && mesh.points[used[i]] == mesh.points[used[i - 1]];
    place_of[used[i]] = is_there ? place_of[used[i - 1]] : used[i];
    if (is_there && !is_counted && ++result.points == 1) result.first = mesh.points[used[i]];
    is_counted = is_there;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> places;
  for (std::size_t e = 0; e < edges.size(); ++e)
    places.emplace_back(
        std::minmax({place_of[edges[e].front().low], place_of[edges[e].front().high]}));
  std::ranges::sort(places);
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i] == places[i - 1] && (i == 1 || places[i - 1] != places[i - 2])) ++result.edges;
  return result;
}

}  // namespace loft
