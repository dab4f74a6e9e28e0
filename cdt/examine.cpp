// SPDX-License-Identifier: MIT
#include <cstdint>
#include <vector>

#include "cdt/archive.h"
#include "cdt/blocks.h"
#include "cdt/check.h"
#include "cdt/persistence.h"

namespace loft::cdt {

namespace {

template <class... Words>
[[noreturn]] void refuse(std::string_view table, std::size_t row, const Words&... words) {
  throw Misfit{table, row, (... + detail::as_word(words))};
}

}  // namespace

class Persistence::Examination {
 public:
  static void of_all(Triangulation& mesh) {
    mesh.has_bends_ = true;  // for all that is known
    mesh.traits_.assign(mesh.points_.size(), Triangulation::passed | Triangulation::crowded);
    examine_constraints(mesh);
    examine_blocks(mesh);
    examine_vertices(mesh);
    examine_stars(mesh);
    examine_hull(mesh);
    for (const Finding& finding : check(mesh)) {
      if (finding.segment.is_none())
        refuse("triangles", finding.edge.is_none() ? 0 : finding.edge.index() / 3, finding.message);
      refuse("segments", finding.segment.index(), finding.message);
    }
    examine_pieces(mesh);
  }

  static void of_triangles(const Triangulation& mesh) {
    for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
      const EdgeId e(i);
      const TriangleId t = Triangulation::triangle(e);
      if (!mesh.is_triangle(t)) continue;
      const VertexId v = mesh.from(e);
      if (v != Triangulation::infinite && !mesh.is_vertex(v))
        refuse("triangles", t.index(), t, " has corner ", v, ", which there is not");
      if (v == mesh.to(e)) refuse("triangles", t.index(), t, " has ", v, " twice");
      const EdgeId f = mesh.twin(e);
      if (!mesh.is_triangle(Triangulation::triangle(f)))
        refuse("triangles", t.index(), t, " has twin ", f, ", which there is not");
      if (mesh.twin(f) != e)
        refuse("triangles", t.index(), e, " has twin ", f, ", but not the other way round");
      if (mesh.from(f) != mesh.to(e) || mesh.to(f) != v)
        refuse("triangles", t.index(), e, " and its twin ", f, " join different vertices");
    }
  }

 private:
  static void examine_vertices(Triangulation& mesh) {
    const bool are_triangles = mesh.vertex_count() >= 2;
    if (!are_triangles && mesh.triangle_count() > 0)
      refuse("triangles", 0, "there are triangles, but not two vertices");
    mesh.is_flat_ = true;
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i)
      if (mesh.is_triangle(TriangleId(i)) && !mesh.is_infinite(TriangleId(i)))
        mesh.is_flat_ = false;
    if (are_triangles != mesh.is_triangle(Triangulation::triangle(mesh.last_)))
      refuse("last", 0, "last is ", mesh.last_, ", which does not fit");
    for (std::uint32_t i = 0; i < mesh.vertex_bound(); ++i) {
      const VertexId v(i);
      if (i > 0 && !mesh.is_vertex(v)) continue;
      if (i > 0 && mesh.vertex_count() == 1) mesh.only_ = v;
      const EdgeId e = mesh.edge(v);
      const bool fits = are_triangles
                            ? mesh.is_triangle(Triangulation::triangle(e)) && mesh.from(e) == v
                            : e.is_none();
      if (fits) continue;
      if (i == 0) refuse("infinite", 0, "the edge ", e, " does not start at infinity");
      refuse("vertices", i - 1, "the edge ", e, " does not start from ", v);
    }
  }

  /// All edges from a vertex are around it.
  static void examine_stars(const Triangulation& mesh) {
    if (mesh.vertex_count() < 2) return;
    std::vector<std::uint32_t> degrees(mesh.vertex_bound());
    for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i)
      if (mesh.is_triangle(TriangleId(i / 3))) ++degrees[mesh.from(EdgeId(i)).index()];
    for (std::uint32_t i = 0; i < mesh.vertex_bound(); ++i) {
      if (i > 0 && !mesh.is_vertex(VertexId(i))) continue;
      const EdgeId first = mesh.edge(VertexId(i));
      EdgeId e = first;
      do {
        --degrees[i];
        e = mesh.rotated(e);
      } while (e != first);
      if (degrees[i] > 0)
        refuse("vertices", i == 0 ? 0 : i - 1, "the triangles at ", VertexId(i),
               " do not go around it once");
    }
  }

  /// The hull, which check() finds convex everywhere, goes around once.
  static void examine_hull(const Triangulation& mesh) {
    if (mesh.vertex_count() < 2) return;
    const auto is_rightward = [&](EdgeId e) {
      return mesh.point(mesh.from(e)) < mesh.point(mesh.to(e));
    };
    const EdgeId first = Triangulation::next(mesh.edge(Triangulation::infinite));
    unsigned turns = 0;
    EdgeId e = first;
    do {
      const EdgeId ahead = Triangulation::next(mesh.twin(Triangulation::next(e)));
      if (is_rightward(e) != is_rightward(ahead)) ++turns;
      e = ahead;
    } while (e != first);
    if (turns != 2) refuse("infinite", 0, "the hull does not go around once");
  }

  static void examine_constraints(Triangulation& mesh) {
    std::vector<std::uint32_t> points_at(mesh.vertex_bound());
    for (std::uint32_t i = 0; i < mesh.constraint_bound(); ++i) {
      const ConstraintId c(i);
      if (!mesh.is_constraint(c)) continue;
      examine_constraint(mesh, c);
      mesh.for_each_point(c, [&](VertexId v) { ++points_at[v.index()]; });
    }
    for (std::uint32_t i = 1; i < mesh.vertex_bound(); ++i)
      if (mesh.is_vertex(VertexId(i)) && points_at[i] > mesh.uses_[i])
        refuse("vertices", i - 1, VertexId(i), " has ", points_at[i], " points of constraints");
    for (std::uint32_t i = 0; i < mesh.segment_bound(); ++i) {
      const SegmentId s(i);
      if (!mesh.is_segment(s)) continue;
      const ConstraintId c = mesh.segment(s).constraint;
      const SegmentId first = mesh.first_segment(c);
      if (s < first || i - first.index() >= mesh.segments(c).size())
        refuse("segments", i, s, " is not among the segments of ", c);
    }
    link_those_without_length(mesh);
  }

  static void examine_constraint(const Triangulation& mesh, ConstraintId c) {
    const auto misfit = [&](const auto&... words) { refuse("constraints", c.index(), words...); };
    const auto& constraint = mesh.constraints_[c.index()];
    const std::uint32_t count = constraint.segment_count;
    const std::uint64_t first = constraint.first_segment;
    if (count == 0 && first != 0) misfit(c, " has no segment, so its first should be s0");
    if (first + count > mesh.segment_bound()) misfit(c, " has segments that there are not");
    if (count == 1 && constraint.is_closed != 0) misfit(c, " is closed, but has one segment");
    VertexId at = constraint.first_vertex;
    for (const Segment& s : mesh.segments(c)) {
      if (s.constraint != c) misfit(c, " has segments of ", s.constraint);
      if (s.from != at) misfit("the segments of ", c, " are not joined at ", at);
      at = s.to;
    }
    if (constraint.is_closed != 0 && at != constraint.first_vertex)
      misfit(c, " is closed, but ends at ", at);
  }

  /// Those at one vertex are one chain.
  static void link_those_without_length(Triangulation& mesh) {
    std::vector<ConstraintId> members;
    std::vector<bool> is_linked(mesh.constraint_bound());
    const auto is_member = [&](ConstraintId c) {
      return mesh.is_constraint(c) && mesh.is_without_length(c);
    };
    for (std::uint32_t i = 0; i < mesh.constraint_bound(); ++i) {
      const ConstraintId c(i);
      if (!mesh.is_constraint(c)) continue;
      const ConstraintId other = mesh.constraints_[i].next_here;
      if (is_member(c)) members.push_back(c);
      if (other.is_none()) continue;
      if (!is_member(c)) refuse("constraints", i, c, " has length, so nothing comes after it");
      if (!is_member(other) || mesh.first_vertex(other) != mesh.first_vertex(c))
        refuse("constraints", i, other, " cannot come after ", c);
      if (is_linked[other.index()]) refuse("constraints", i, other, " comes after two");
      is_linked[other.index()] = true;
    }
    std::size_t reached = 0;
    for (const ConstraintId c : members) {
      if (is_linked[c.index()]) continue;
      mesh.without_length_.resize(mesh.vertex_bound());
      ConstraintId& head = mesh.without_length_[mesh.first_vertex(c).index()];
      if (!head.is_none())
        refuse("constraints", c.index(), head, " and ", c, " both come first at their vertex");
      head = c;
      for (ConstraintId d = c; !d.is_none(); d = mesh.constraints_[d.index()].next_here) ++reached;
    }
    if (reached != members.size())
      refuse("constraints", 0, "some constraints without length come after one another in a ring");
  }

  /// Beyond `dense`, the blocks of constraints are as long as their class says, too.
  static void examine_blocks(const Triangulation& mesh) {
    if (mesh.dense_segments_ == Triangulation::unused) return;
    std::vector<bool> is_taken(mesh.segment_bound());
    for (std::uint32_t index = 0; index < size_classes; ++index)
      for (std::uint32_t first = mesh.free_segments_[index]; first != Triangulation::unused;
           first = mesh.segments_[first].from.index())
        for (std::uint32_t k = 0; k < size_of_class(index); ++k) is_taken[first + k] = true;
    for (std::uint32_t i = 0; i < mesh.constraint_bound(); ++i) {
      const ConstraintId c(i);
      if (!mesh.is_constraint(c) || mesh.segments(c).empty()) continue;
      const std::uint32_t first = mesh.first_segment(c).index();
      if (first < mesh.dense_segments_) continue;
      const auto count = static_cast<std::uint32_t>(mesh.segments(c).size());
      for (std::uint32_t k = 0; k < size_class(count).size; ++k) {
        const std::size_t s = std::size_t{first} + k;
        if (s >= is_taken.size() || is_taken[s] ||
            (k >= count && mesh.is_segment(SegmentId(first + k))))
          refuse("constraints", i, "there is no room for the segments of ", c);
        is_taken[s] = true;
      }
    }
  }

  /// The passages of a segment are one way from its start to its end.
  static void examine_pieces(const Triangulation& mesh) {
    std::vector<std::uint32_t> counts(mesh.segment_bound());
    for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
      const EdgeId e(i);
      if (!mesh.is_triangle(Triangulation::triangle(e)) || mesh.twin(e) < e) continue;
      for (const Passage passage : mesh.passages(e)) ++counts[passage.segment().index()];
    }
    for (std::uint32_t i = 0; i < mesh.segment_bound(); ++i) {
      const SegmentId s(i);
      if (!mesh.is_segment(s)) continue;
      const auto pieces = mesh.pieces(s);
      VertexId at = mesh.segment(s).from;
      for (const EdgeId e : pieces) {
        if (mesh.from(e) != at) refuse("segments", i, "the pieces of ", s, " are not joined");
        at = mesh.to(e);
      }
      if (at != mesh.segment(s).to || pieces.size() != counts[i])
        refuse("segments", i, s, " is not the way of its passages");
    }
  }
};

void Persistence::examine_triangles(const Triangulation& mesh) { Examination::of_triangles(mesh); }

void Persistence::examine(Triangulation& mesh) { Examination::of_all(mesh); }

}  // namespace loft::cdt
