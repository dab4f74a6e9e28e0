// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "reconstruct/tile/slab.h"

namespace loft {

class SheetHeights;
struct CircleCell;

/// A vertex of a slab's tiles that is not a contour vertex.
struct InnerVertex {
  Vec3 place;
  VertexKind kind;
};

/// The heights of a slab's overlay over its sheets: which vertex of the tiles is above or below
/// each corner of a sheet triangle.
///
/// Nodes, the vertices of the tiles, are numbered: first the points of the lower region, then
/// those of the upper one, then the inner vertices. After lifting no sheet triangle touches a slice
/// plane except in contour vertices and contour edges of that slice, if is_complete().
class Lift {
 public:
  /// Lifts; inserts Steiner vertices into the slab's overlay.
  explicit Lift(Slab& slab);

  /// False where a sheet is so thin, a few roundings, that there is no place for a vertex in it.
  [[nodiscard]] bool is_complete() const { return is_complete_; }
  /// The node at from(corner), seen from the sheet triangle left of it.
  [[nodiscard]] std::uint32_t node(cdt::EdgeId corner) const;
  /// The node of an overlay vertex beside which there is no sheet.
  [[nodiscard]] std::uint32_t node(cdt::VertexId v) const { return nodes_[v.index()]; }
  /// The node of a contour vertex.
  [[nodiscard]] std::uint32_t node(std::uint32_t point, Level level) const {
    return level == Level::lower ? point : lower_count_ + point;
  }
  [[nodiscard]] const std::vector<InnerVertex>& inner() const { return inner_; }

 private:
  /// Of a column only its wedges have heights; of a vertex that is a column: `by_wedge`.
  enum class Height : std::uint8_t { by_wedge, lower, upper, between };
  /// The sheet triangles around a column between two contour edges.
  struct Wedge {
    cdt::EdgeId first;  // contour edge on its right
    cdt::EdgeId last;   // contour edge on its left
  };
  /// A Steiner vertex to be: on the edge between the first two corners, or, if there is a third
  /// one, in their triangle; without corners at its place, whatever is there.
  struct Steiner {
    double rank;  // the lowest is inserted first
    cdt::Point place;
    double z;
    cdt::VertexId corners[3];
  };

  [[nodiscard]] static Height height(Level level) {
    return level == Level::lower ? Height::lower : Height::upper;
  }
  [[nodiscard]] Height height(cdt::EdgeId corner) const {
    const Height height = heights_[mesh_.from(corner).index()];
    return height == Height::by_wedge ? column_heights_[corner.index()] : height;
  }
  [[nodiscard]] std::vector<Wedge> wedges(cdt::VertexId column) const;
  [[nodiscard]] Level choose(const Wedge& wedge) const;
  [[nodiscard]] int chords(const Wedge& wedge, Level level) const;
  void set_heights(const Wedge& wedge, Level level);
  void decide_columns();
  void set_columns();
  void lift_vertices();
  [[nodiscard]] std::vector<Steiner> find_chords() const;
  [[nodiscard]] std::vector<Steiner> find_flat() const;
  [[nodiscard]] Steiner in_middle_of(cdt::EdgeId e, SheetHeights& heights) const;
  [[nodiscard]] std::vector<Steiner> find_coarse_ends() const;
  [[nodiscard]] double extent(const Steiner& steiner) const;
  bool insert(const std::vector<Steiner>& unsorted);
  [[nodiscard]] double z_at(cdt::EdgeId corner) const;
  void add_inner(cdt::VertexId v, double z, VertexKind kind);
  [[nodiscard]] bool is_chord(cdt::EdgeId e) const;
  [[nodiscard]] bool is_flat(cdt::EdgeId e) const;
  [[nodiscard]] bool is_level(const CircleCell& cell, Height height) const;
  [[nodiscard]] bool is_there(const Steiner& steiner) const;
  std::optional<cdt::VertexId> split(const Steiner& steiner);
  std::optional<cdt::VertexId> split_at(cdt::Point place);
  std::optional<cdt::VertexId> split(cdt::EdgeId e, cdt::Point place);
  [[nodiscard]] std::optional<cdt::TriangleId> triangle_beside(cdt::EdgeId e,
                                                               cdt::Point point) const;

  Slab& slab_;
  const cdt::Triangulation& mesh_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
  bool is_complete_ = false;
  std::vector<InnerVertex> inner_;
  std::vector<std::uint32_t> nodes_;    // of each overlay vertex; of a column the lower one
  std::vector<Height> heights_;         // of each overlay vertex
  std::vector<cdt::VertexId> columns_;  // in the order of their places
  std::vector<Height> column_heights_;  // of each corner at a column
  std::map<std::pair<cdt::VertexId, cdt::SegmentId>, Level> choices_;  // by a wedge's first edge
};

}  // namespace loft
