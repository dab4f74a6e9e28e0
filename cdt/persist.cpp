// SPDX-License-Identifier: MIT
#include "cdt/persist.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cdt/archive.h"
#include "cdt/blocks.h"
#include "cdt/check.h"

namespace loft::cdt {

namespace {

/// What does not fit, and in which row of which table.
struct Misfit {
  std::string_view table;
  std::size_t row;
  std::string message;
};

template <class... Words>
[[noreturn]] void refuse(std::string_view table, std::size_t row, const Words&... words) {
  throw Misfit{table, row, (... + detail::as_word(words))};
}

}  // namespace

/// The one who may look inside.
class Persistence {
 public:
  /// What a state consists of, for those who write it and those who read it.
  template <class Archive, class Mesh>
  static void describe(Archive& archive, Mesh& mesh) {
    describe_single_fields(archive, mesh);
    describe_vertices(archive, mesh);
    describe_triangles(archive, mesh);
    describe_constraints(archive, mesh);
    describe_segments(archive, mesh);
    if constexpr (Archive::is_reading) examine_triangles(mesh);
    describe_passages(archive, mesh);
    describe_free_ids(
        archive, "free_vertices", mesh.free_vertices_, mesh.points_.size(),
        [&](VertexId v) { return v == Triangulation::infinite || mesh.is_vertex(v); });
    describe_free_ids(archive, "free_triangles", mesh.free_triangles_, mesh.triangle_bound(),
                      [&](TriangleId t) { return mesh.is_triangle(t); });
    describe_free_ids(archive, "free_constraints", mesh.free_constraints_, mesh.constraint_bound(),
                      [&](ConstraintId c) { return mesh.is_constraint(c); });
    describe_free_blocks(archive, mesh);
    describe_snaps(archive, mesh);
    describe_locator(archive, mesh.locator_, mesh.points_.size());
    archive.end();
  }

  /// Everything that can only be told when all is there.
  static void examine(Triangulation& mesh) {
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

 private:
  template <class Archive, class Mesh>
  static void describe_single_fields(Archive& archive, Mesh& mesh) {
    archive.line("epsilon", mesh.epsilon_);
    if constexpr (Archive::is_reading)
      if (!(mesh.epsilon_ >= 0) || mesh.epsilon_ > Triangulation::largest_coordinate)
        archive.fail("epsilon should be finite and not negative");
    archive.line("recording", mesh.is_recording_);
    archive.line("last", mesh.last_);
    archive.line("infinite", mesh.vertex_edges_[0]);
    SegmentId dense(mesh.dense_segments_);
    archive.line("dense", dense);
    if constexpr (Archive::is_reading) mesh.dense_segments_ = dense.index();
  }

  template <class Archive, class Mesh>
  static void describe_vertices(Archive& archive, Mesh& mesh) {
    archive.table("vertices", mesh.points_.size() - 1, [&](std::uint32_t i) {
      const VertexId v(i + 1);
      if constexpr (Archive::is_reading) {
        mesh.points_.push_back(mesh.points_[0]);
        mesh.vertex_edges_.emplace_back();
        mesh.uses_.push_back(Triangulation::unused);
      }
      Point point = mesh.points_[v.index()];
      EdgeId edge = mesh.vertex_edges_[v.index()];
      std::uint32_t uses = mesh.uses_[v.index()];
      bool is_there = mesh.is_vertex(v);
      archive.row(v, is_there, point.x, point.y, edge, uses);
      if constexpr (Archive::is_reading) {
        if (!is_there) return;
        const auto is_usable = [](double x) {
          return std::abs(x) <= Triangulation::largest_coordinate;
        };
        if (!is_usable(point.x) || !is_usable(point.y))
          archive.fail(v, " should have coordinates that are finite and not beyond 1e75");
        if (uses >= Triangulation::moved) archive.fail(v, " has too many uses");
        mesh.points_[v.index()] = point;
        mesh.vertex_edges_[v.index()] = edge;
        mesh.uses_[v.index()] = uses;
        ++mesh.vertex_count_;
      }
    });
  }

  /// Whether there are passages follows from the table of these.
  template <class Archive, class Mesh>
  static void describe_triangles(Archive& archive, Mesh& mesh) {
    archive.table("triangles", mesh.triangle_bound(), [&](std::uint32_t i) {
      const TriangleId t(i);
      std::array<VertexId, 3> corners;
      std::array<EdgeId, 3> twins;
      bool is_there = mesh.is_triangle(t);
      if constexpr (!Archive::is_reading) {
        for (unsigned k = 0; k < 3; ++k) {
          corners[k] = mesh.from(Triangulation::edge(t, k));
          twins[k] = mesh.twin(Triangulation::edge(t, k));
        }
      }
      archive.row(t, is_there, corners[0], corners[1], corners[2], twins[0], twins[1], twins[2]);
      if constexpr (Archive::is_reading) {
        for (unsigned k = 0; k < 3; ++k) {
          if (is_there && corners[k].index() >= mesh.points_.size())
            archive.fail(t, " has corner ", corners[k], ", which there is not");
          if (is_there && twins[k].index() >= Triangulation::OrientedEdge::constrained)
            archive.fail(t, " has twin ", twins[k], ", which there is not");
          mesh.edges_.push_back(is_there ? Triangulation::OrientedEdge{corners[k], twins[k].index()}
                                         : Triangulation::OrientedEdge{VertexId::none(), 0});
        }
        if (mesh.edges_.size() > Triangulation::OrientedEdge::constrained)
          archive.fail("there are too many triangles");
        ++mesh.triangle_bound_;
      }
    });
  }

  template <class Archive, class Mesh>
  static void describe_constraints(Archive& archive, Mesh& mesh) {
    archive.table("constraints", mesh.constraints_.size(), [&](std::uint32_t i) {
      const ConstraintId c(i);
      if constexpr (Archive::is_reading) mesh.constraints_.push_back({});
      auto& constraint = mesh.constraints_[i];
      bool is_there = mesh.is_constraint(c);
      VertexId first_vertex = constraint.first_vertex;
      SegmentId first_segment(constraint.first_segment);
      std::uint32_t count = constraint.segment_count;
      bool is_closed = constraint.is_closed != 0;
      ConstraintId next_here;  // where it means nothing, none
      if constexpr (!Archive::is_reading)
        if (is_there && mesh.is_without_length(c)) next_here = constraint.next_here;
      archive.row(c, is_there, first_vertex, first_segment, count, is_closed, next_here);
      if constexpr (Archive::is_reading) {
        if (!is_there) return;
        if (!mesh.is_vertex(first_vertex))
          archive.fail(c, " starts from ", first_vertex, ", which there is not");
        constraint.first_vertex = first_vertex;
        constraint.first_segment = first_segment.index();
        constraint.segment_count = count & 0x7fff'ffff;
        constraint.is_closed = is_closed ? 1 : 0;
        constraint.next_here = next_here;
        if (constraint.segment_count != count) archive.fail(c, " has too many segments");
      }
    });
  }

  template <class Archive, class Mesh>
  static void describe_segments(Archive& archive, Mesh& mesh) {
    archive.table("segments", mesh.segments_.size(), [&](std::uint32_t i) {
      const SegmentId s(i);
      if constexpr (Archive::is_reading) mesh.segments_.emplace_back();
      Segment segment = mesh.segments_[i];
      bool is_there = mesh.is_segment(s);
      archive.row(s, is_there, segment.from, segment.to, segment.constraint);
      if constexpr (Archive::is_reading) {
        if (i >= PassageSets::most_segments) archive.fail("there are too many segments");
        if (!is_there) return;
        for (const VertexId v : {segment.from, segment.to})
          if (!mesh.is_vertex(v)) archive.fail(s, " ends at ", v, ", which there is not");
        if (!mesh.is_constraint(segment.constraint))
          archive.fail(s, " is of constraint ", segment.constraint, ", which there is not");
        mesh.segments_[i] = segment;
      }
    });
  }

  template <class Archive, class Mesh>
  static void describe_passages(Archive& archive, Mesh& mesh) {
    std::vector<EdgeId> edges;
    if constexpr (!Archive::is_reading)
      for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i)
        if (const EdgeId e(i); mesh.is_constrained(e) && e < mesh.twin(e)) edges.push_back(e);
    EdgeId e;
    std::vector<Passage> passages;
    archive.table("passages", edges.size(), [&](std::uint32_t i) {
      [[maybe_unused]] const EdgeId before = e;
      if constexpr (!Archive::is_reading) {
        e = edges[i];
        const auto all = mesh.passages(e);
        passages.assign(all.begin(), all.end());
      }
      archive.list(e, passages);
      if constexpr (Archive::is_reading) {
        if (!mesh.is_triangle(Triangulation::triangle(e)))
          archive.fail("there are passages along ", e, ", which there is not");
        if (!before.is_none() && e <= before) archive.fail(e, " should be before ", before);
        if (mesh.twin(e) < e) archive.fail("passages should be with the twin of ", e);
        if (mesh.from(e) == Triangulation::infinite || mesh.to(e) == Triangulation::infinite)
          archive.fail("there are passages along ", e, ", which goes to infinity");
        if (passages.empty()) archive.fail("there is no passage along ", e);
        if (!std::ranges::is_sorted(passages))
          archive.fail("the passages along ", e, " should be sorted");
        PassageSet set;
        for (const Passage passage : passages) {
          if (!mesh.is_segment(passage.segment()))
            archive.fail(passage.segment(), " runs along ", e, ", but there is no such segment");
          set = mesh.sets_.with(set, passage);
        }
        mesh.join(e, mesh.twin(e), set);
      }
    });
  }

  template <class Archive, class Ids, class IsThere>
  static void describe_free_ids(Archive& archive, std::string_view name, Ids& free,
                                std::size_t bound, IsThere is_there) {
    using Id = typename std::remove_const_t<Ids>::value_type;
    std::vector<bool> is_known(Archive::is_reading ? bound : 0);
    archive.table(name, free.size(), [&](std::uint32_t i) {
      Id id = Archive::is_reading ? Id() : free[i];
      archive.entry(id);
      if constexpr (Archive::is_reading) {
        if (id.index() >= bound) archive.fail(id, " cannot be free: there is no such place");
        if (is_there(id)) archive.fail(id, " cannot be free: it is there");
        if (is_known[id.index()]) archive.fail(id, " is free twice");
        is_known[id.index()] = true;
        free.push_back(id);
      }
    });
    if constexpr (Archive::is_reading) {
      for (std::uint32_t i = 0; i < bound; ++i)
        if (!is_known[i] && !is_there(Id(i))) archive.fail(name, " should have ", Id(i));
    }
  }

  /// The links between free blocks are in the segments that they consist of: `from` of the first.
  template <class Archive, class Mesh>
  static void describe_free_blocks(Archive& archive, Mesh& mesh) {
    struct Block {
      std::uint32_t size_class;
      SegmentId first;
    };
    std::vector<Block> blocks;
    if constexpr (!Archive::is_reading) {
      for (std::uint32_t index = 0; index < size_classes; ++index)
        for (std::uint32_t first = mesh.free_segments_[index]; first != Triangulation::unused;
             first = mesh.segments_[first].from.index())
          blocks.push_back({index, SegmentId(first)});
    }
    std::vector<bool> is_known(Archive::is_reading ? mesh.segments_.size() : 0);
    Block last{0, SegmentId::none()};
    archive.table("free_blocks", blocks.size(), [&](std::uint32_t i) {
      Block block = Archive::is_reading ? Block{} : blocks[i];
      archive.entry(block.size_class, block.first);
      if constexpr (Archive::is_reading) {
        const auto [size_class, first] = block;
        if (size_class >= size_classes || size_class == 0)
          archive.fail("there is no class ", size_class);
        if (size_class < last.size_class) archive.fail("classes should be in order");
        const std::uint64_t end = first.index() + size_of_class(size_class);
        if (end > mesh.segments_.size())
          archive.fail("a block from ", first, " goes beyond the end");
        for (std::uint32_t s = first.index(); s < end; ++s) {
          if (mesh.is_segment(SegmentId(s))) archive.fail(SegmentId(s), " is there, not free");
          if (is_known[s]) archive.fail(SegmentId(s), " is in two free blocks");
          is_known[s] = true;
        }
        if (size_class == last.size_class) {
          mesh.segments_[last.first.index()].from = VertexId(first.index());
        } else {
          mesh.free_segments_[size_class] = first.index();
        }
        last = block;
      }
    });
    if constexpr (Archive::is_reading) {
      const std::uint32_t dense = mesh.dense_segments_;
      if (dense != Triangulation::unused && dense > mesh.segments_.size())
        archive.fail("dense should be at most the number of segments");
      if (dense == Triangulation::unused && !last.first.is_none())
        archive.fail("where there are free blocks, dense should say since when");
    }
  }

  template <class Archive, class Mesh>
  static void describe_snaps(Archive& archive, Mesh& mesh) {
    archive.table("snaps", mesh.snaps_.size(), [&](std::uint32_t i) {
      Snap snap = Archive::is_reading ? Snap{} : mesh.snaps_[i];
      archive.entry(snap.segment, snap.place.x, snap.place.y);
      if constexpr (Archive::is_reading) {
        if (!mesh.is_segment(snap.segment))
          archive.fail(snap.segment, " is snapped, but there is no such segment");
        if (!std::isfinite(snap.place.x) || !std::isfinite(snap.place.y))
          archive.fail("the place of a snap should be finite");
        mesh.snaps_.push_back(snap);
      }
    });
  }

  /// It only ever suggests where to look, but where a walk begins decides which of two triangles
  /// it finds, and so the ids of new ones.
  template <class Archive, class Grid>
  static void describe_locator(Archive& archive, Grid& locator, std::size_t vertex_bound) {
    std::uint32_t levels = locator.levels_;
    auto laid_out_for = static_cast<std::uint32_t>(locator.laid_out_for_);
    Box box = locator.box_;
    archive.line("levels", levels);
    archive.line("laid_out_for", laid_out_for);
    archive.line("low", box.low.x, box.low.y);
    archive.line("high", box.high.x, box.high.y);
    std::vector<std::uint32_t> columns;  // of each row
    if constexpr (Archive::is_reading) {
      if (levels >= Locator::most_levels) archive.fail("there are too many levels of cells");
      const bool is_box = box.low.x <= box.high.x && box.low.y <= box.high.y &&
                          std::isfinite(box.high.x - box.low.x) &&
                          std::isfinite(box.high.y - box.low.y);
      if (levels > 0 ? !is_box : box.low != Box().low || box.high != Box().high)
        archive.fail("the box of the cells is none");
      if (levels == 0 && laid_out_for != 0) archive.fail("without cells this should be 0");
    }
    for (unsigned level = 1; level <= levels; ++level)
      columns.insert(columns.end(), std::size_t{1} << level, 1U << level);

    std::vector<VertexId> cells;
    std::vector<VertexId> row;
    std::size_t known_cells = 0;
    std::size_t rows = 0;
    archive.table("cells", columns.size(), [&](std::uint32_t i) {
      if constexpr (!Archive::is_reading) {
        const auto first = locator.cells_.begin() + static_cast<std::ptrdiff_t>(known_cells);
        row.assign(first, first + columns[i]);
        known_cells += columns[i];
      }
      archive.list(i, row);
      if constexpr (Archive::is_reading) {
        if (i >= columns.size()) archive.fail("there are too many rows of cells");
        if (row.size() != columns[i]) archive.fail("a row here should have ", columns[i], " cells");
        for (const VertexId v : row)
          if (!v.is_none() && (v == Triangulation::infinite || v.index() >= vertex_bound))
            archive.fail("a cell has ", v, ", which there is not");
        cells.insert(cells.end(), row.begin(), row.end());
        ++rows;
      }
    });
    if constexpr (Archive::is_reading) {
      if (rows != columns.size())
        archive.fail("there should be ", columns.size(), " rows of cells");
      if (levels == 0) return;
      locator.laid_out_for_ = laid_out_for;
      locator.set_out(levels, box);
      locator.cells_ = std::move(cells);
    }
  }

  // --- Examination ---

  static void examine_triangles(const Triangulation& mesh) {
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

namespace {

template <class Reader>
Triangulation read(Reader reader) {
  Triangulation mesh;
  try {
    Persistence::describe(reader, mesh);
    Persistence::examine(mesh);
  } catch (const Misfit& misfit) {
    reader.fail_in(misfit.table, misfit.row, misfit.message);
  }
  return mesh;
}

template <class Writer>
void write(const Triangulation& mesh, Writer writer) {
  Persistence::describe(writer, mesh);
}

}  // namespace

void save(const Triangulation& mesh, std::ostream& out, Form form) {
  form == Form::text ? write(mesh, TextWriter(out)) : write(mesh, BinaryWriter(out));
}

Triangulation load(std::istream& in) {
  const bool is_binary = in.peek() == static_cast<unsigned char>(binary_magic[0]);
  return is_binary ? read(BinaryReader(in)) : read(TextReader(in));
}

}  // namespace loft::cdt
