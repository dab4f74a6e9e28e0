// SPDX-License-Identifier: MIT
#include "io/planar/planar_mesh.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "io/planar/ids_in_use.h"

namespace loft::io {

namespace {

using Piece = PlanarMesh::Piece;
using Course = PlanarMesh::Course;
using Region = PlanarMesh::Region;
using cdt::EdgeId;
using cdt::Triangulation;
using cdt::VertexId;

/// Spreads a number over 64 bits (the finaliser of SplitMix64).
std::uint64_t scatter(std::uint64_t number) {
  number += 0x9e37'79b9'7f4a'7c15;
  number = (number ^ number >> 30U) * 0xbf58'476d'1ce4'e5b9;
  number = (number ^ number >> 27U) * 0x94d0'49bb'1331'11eb;
  return number ^ number >> 31U;
}

/// The key of what the name encloses, of the number where there is no name.
std::uint64_t key_of(std::string_view name, std::size_t number) {
  if (name.empty()) return scatter(number);
  std::uint64_t hash = 0xcbf2'9ce4'8422'2325;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100'0000'01b3;
  return scatter(hash);
}

bool is_same_edge(const Piece& a, const Piece& b) { return a.from == b.from && a.to == b.to; }

class PlanarMeshMaker {
 public:
  explicit PlanarMeshMaker(const Triangulation& mesh) : mesh_(mesh) {}

  PlanarMesh make(std::span<const NamedConstraint> constraints) {
    number_vertices();
    number_triangles();
    link_triangles();
    follow(constraints);
    gather_pieces();
    number_regions();
    enclose_regions();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::uint32_t number_of(VertexId v) const { return vertex_numbers_[v.index()]; }

  void number_vertices() {
    std::vector<VertexId> ids = vertices_of(mesh_);
    vertex_numbers_.assign(ids.empty() ? 1 : ids.back().index() + 1, PlanarMesh::none);
    std::ranges::sort(ids, {}, [&](VertexId v) { return mesh_.point(v); });
    for (const VertexId v : ids) {
      vertex_numbers_[v.index()] = static_cast<std::uint32_t>(result_.points.size());
      const cdt::Point point = mesh_.point(v);
      result_.points.push_back({point.x + 0.0, point.y + 0.0});  // no negative zeros
    }
  }

  void number_triangles() {
    std::vector<std::pair<std::array<std::uint32_t, 3>, EdgeId>> sorted;
    for (const cdt::TriangleId t : triangles_of(mesh_)) {
      if (mesh_.is_infinite(t)) continue;
      EdgeId e = Triangulation::edge(t);
      const auto start = [&](EdgeId edge) { return number_of(mesh_.from(edge)); };
      while (start(e) > start(Triangulation::next(e)) || start(e) > start(Triangulation::prev(e)))
        e = Triangulation::next(e);
      sorted.push_back(
          {{start(e), start(Triangulation::next(e)), start(Triangulation::prev(e))}, e});
    }
    std::ranges::sort(sorted);
    for (const auto& [corners, e] : sorted) {
      result_.triangles.push_back(corners);
      first_edges_.push_back(e);
    }
  }

  void link_triangles() {
    std::uint32_t bound = 0;
    for (const EdgeId e : first_edges_) bound = std::max(bound, e.index() / 3 * 3 + 3);
    std::vector<std::uint32_t> numbers(bound, PlanarMesh::none);  // by EdgeId
    for (std::uint32_t t = 0; t < first_edges_.size(); ++t) {
      EdgeId e = first_edges_[t];
      for (std::uint32_t corner = 0; corner < 3; ++corner, e = Triangulation::next(e))
        numbers[e.index()] = 3 * t + corner;
    }
    for (EdgeId e : first_edges_) {
      for (int corner = 0; corner < 3; ++corner, e = Triangulation::next(e)) {
        const std::uint32_t twin = mesh_.twin(e).index();
        result_.neighbours.push_back(twin < bound ? numbers[twin] : PlanarMesh::none);
      }
    }
  }

  [[nodiscard]] Course course_of(const NamedConstraint& constraint) const {
    Course course{constraint.name, 0, {number_of(mesh_.first_vertex(constraint.id))}};
    for (const EdgeId e : mesh_.pieces(constraint.id))
      course.vertices.push_back(number_of(mesh_.to(e)));
    return course;
  }

  void follow(std::span<const NamedConstraint> constraints) {
    std::vector<Course>& courses = result_.constraints;
    if (constraints.empty()) {
      for (const cdt::ConstraintId id : constraints_of(mesh_)) courses.push_back(course_of({id}));
      std::ranges::sort(courses, {}, &Course::vertices);
    } else {
      for (const NamedConstraint& constraint : constraints)
        courses.push_back(course_of(constraint));
    }
    for (std::size_t i = 0; i < courses.size(); ++i) courses[i].key = key_of(courses[i].name, i);
  }

  void gather_pieces() {
    std::vector<Piece>& pieces = result_.pieces;
    for (std::uint32_t c = 0; c < result_.constraints.size(); ++c) {
      const std::vector<std::uint32_t>& vertices = result_.constraints[c].vertices;
      for (std::size_t i = 1; i < vertices.size(); ++i) {
        const auto [from, to] = std::minmax(vertices[i - 1], vertices[i]);
        pieces.push_back({from, to, c});
      }
    }
    std::ranges::sort(pieces);
    merge_repeated(pieces);
    std::vector<std::uint32_t>& first = result_.first_piece;
    first.assign(result_.points.size() + 1, 0);
    for (const Piece& piece : pieces) ++first[piece.from + 1];
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  }

  static void merge_repeated(std::vector<Piece>& pieces) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const bool is_repeated = kept > 0 && is_same_edge(pieces[kept - 1], pieces[i]) &&
                               pieces[kept - 1].constraint == pieces[i].constraint;
      if (is_repeated) {
        ++pieces[kept - 1].passages;
      } else {
        pieces[kept++] = pieces[i];
      }
    }
    pieces.resize(kept);
  }

  void number_regions() {
    result_.region_of.assign(result_.triangles.size(), PlanarMesh::none);
    for (std::uint32_t t = 0; t < result_.triangles.size(); ++t) {
      if (result_.region_of[t] != PlanarMesh::none) continue;
      result_.regions.emplace_back();
      spread_region(t);
    }
  }

  void spread_region(std::uint32_t first) {
    const auto region = static_cast<std::uint32_t>(result_.regions.size() - 1);
    std::vector<std::uint32_t> front{first};
    result_.region_of[first] = region;
    while (!front.empty()) {
      const std::size_t t = front.back();
      front.pop_back();
      ++result_.regions.back().triangles;
      for (std::size_t e = 3 * t; e < 3 * t + 3; ++e) {
        const std::uint32_t twin = result_.neighbours[e];
        if (twin == PlanarMesh::none || result_.region_of[twin / 3] != PlanarMesh::none) continue;
        if (!result_.pieces_along(e).empty()) continue;
        result_.region_of[twin / 3] = region;
        front.push_back(twin / 3);
      }
    }
  }

  /// What a region is told beyond an edge, from what it is on this side.
  [[nodiscard]] Region beyond(std::size_t edge, Region region) const {
    for (const Piece& piece : result_.pieces_along(edge)) {
      const Course& course = result_.constraints[piece.constraint];
      if (!course.is_loop() || piece.passages % 2 == 0) continue;
      region.is_odd = !region.is_odd;
      region.key ^= course.key;
    }
    return region;
  }

  /// Finds out what encloses each region, from the outside inwards.
  void enclose_regions() {
    std::vector<bool> is_reached(result_.triangles.size());
    std::vector<std::size_t> front;
    const auto enter = [&](std::size_t t, std::size_t edge, const Region& before) {
      if (is_reached[t]) return;
      is_reached[t] = true;
      const Region here = beyond(edge, before);
      Region& region = result_.regions[result_.region_of[t]];
      region.is_odd = here.is_odd;
      region.key = here.key;
      front.push_back(t);
    };
    for (std::size_t e = 0; e < result_.neighbours.size(); ++e)
      if (result_.neighbours[e] == PlanarMesh::none) enter(e / 3, e, {});
    while (!front.empty()) {
      const std::size_t t = front.back();
      front.pop_back();
      for (std::size_t e = 3 * t; e < 3 * t + 3; ++e) {
        const std::uint32_t twin = result_.neighbours[e];
        if (twin != PlanarMesh::none) enter(twin / 3, e, result_.regions[result_.region_of[t]]);
      }
    }
  }

  const Triangulation& mesh_;
  PlanarMesh result_;
  std::vector<std::uint32_t> vertex_numbers_;  // by VertexId
  std::vector<EdgeId> first_edges_;            // of each triangle, from its smallest corner
};

}  // namespace

std::span<const Piece> PlanarMesh::pieces_along(std::uint32_t a, std::uint32_t b) const {
  const auto [from, to] = std::minmax(a, b);
  const std::span<const Piece> candidates =
      std::span(pieces).subspan(first_piece[from], first_piece[from + 1] - first_piece[from]);
  const auto begin = std::ranges::lower_bound(candidates, to, {}, &Piece::to);
  const auto end = std::ranges::upper_bound(candidates, to, {}, &Piece::to);
  return {begin, end};
}

PlanarMesh to_planar_mesh(const Triangulation& mesh, std::span<const NamedConstraint> constraints) {
  return PlanarMeshMaker(mesh).make(constraints);
}

std::size_t count_constrained_edges(const PlanarMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.pieces.size(); ++i)
    if (i == 0 || !is_same_edge(mesh.pieces[i - 1], mesh.pieces[i])) ++count;
  return count;
}

}  // namespace loft::io
