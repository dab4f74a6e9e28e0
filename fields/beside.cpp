// SPDX-License-Identifier: MIT
#include "fields/beside.h"

#include <algorithm>

#include "cdt/predicates.h"

namespace loft::fields {

using cdt::EdgeId;
using cdt::orient;
using cdt::TriangleId;
using cdt::Triangulation;
using cdt::VertexId;

namespace {

/// The next value of a counter that marks things; where it comes round, no mark is left.
void count_on(std::uint32_t& now, std::vector<std::uint32_t>& marks) {
  if (++now != 0) return;
  std::ranges::fill(marks, 0U);
  now = 1;
}

}  // namespace

void BesidePieces::begin(const Triangulation& mesh) {
  mesh_ = &mesh;
  vertices_.clear();
  triangle_round_.resize(std::max(triangle_round_.size(), mesh.triangle_bound()), 0);
  vertex_round_.resize(std::max(vertex_round_.size(), mesh.vertex_bound()), 0);
  count_on(vertex_now_, vertex_round_);
}

bool BesidePieces::add(VertexId v) {
  if (vertex_round_[v.index()] == vertex_now_) return false;
  vertex_round_[v.index()] = vertex_now_;
  vertices_.push_back(v);
  return true;
}

bool BesidePieces::add(const SeparatorPiece& piece, VertexId end) {
  const EdgeId first = mesh_->edge(end);
  if (first.is_none()) return false;
  count_on(triangle_now_, triangle_round_);
  front_.clear();
  EdgeId e = first;
  do {
    reach(Triangulation::triangle(e));
    e = mesh_->rotated(e);
  } while (e != first);
  if (front_.empty()) return false;
  while (!front_.empty()) {
    const TriangleId t = front_.back();
    front_.pop_back();
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId side = Triangulation::edge(t, corner);
      add(mesh_->from(side));
      const TriangleId beyond = Triangulation::triangle(mesh_->twin(side));
      if (triangle_round_[beyond.index()] != triangle_now_ && touches(piece, side)) reach(beyond);
    }
  }
  return true;
}

void BesidePieces::reach(TriangleId t) {
  triangle_round_[t.index()] = triangle_now_;
  if (!mesh_->is_infinite(t)) front_.push_back(t);
}

/// Whether a piece and an edge have a point in common. The ends of the piece are vertices.
bool BesidePieces::touches(const SeparatorPiece& piece, EdgeId e) const {
  using Part = SeparatorPiece::Part;
  const Point p = mesh_->point(mesh_->from(e));
  const Point q = mesh_->point(mesh_->to(e));
  const int of_p = orient(piece.a, piece.b, p);
  const int of_q = orient(piece.a, piece.b, q);
  if (of_p == of_q && of_p != 0) return false;
  if (of_p == 0 || of_q == 0)
    return (of_p == 0 && piece.standing(p).touches > 0) ||
           (of_q == 0 && piece.standing(q).touches > 0);
  const int of_a = orient(p, q, piece.a);
  const int of_b = orient(p, q, piece.b);
  if (piece.part == Part::between) return of_a != of_b || of_a == 0;
  const int ahead = of_q > of_p ? -1 : 1;  // the side of pq that the line leads to
  return piece.part == Part::before ? of_a == ahead || of_a == 0 : of_b == -ahead || of_b == 0;
}

}  // namespace loft::fields
