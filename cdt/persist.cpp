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
#include "cdt/persistence.h"

namespace loft::cdt {

class Persistence::Description {
 public:
  /// What a state consists of, for those who write it and those who read it.
  template <class Archive, class Mesh>
  static void all(Archive& archive, Mesh& mesh) {
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
};

template <class Archive, class Mesh>
void Persistence::describe(Archive& archive, Mesh& mesh) {
  Description::all(archive, mesh);
}

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
