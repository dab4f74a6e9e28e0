// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "cdt/triangulation.h"
#include "reconstruct/clean/region.h"

namespace loft {

/// The sheet over a part that ends in points and lines of the other slice, its tips: triangles over
/// the part, with the tips as vertices and edges. Where a tip sees what is behind an edge between
/// two vertices of the outline, that edge is flipped: so over an outline that is star-shaped around
/// a point there is a cone. Edges that stay get a vertex of their own, at the height of
/// height_share(), as the chords of other sheets do.
class TipSheet {
 public:
  static constexpr std::uint32_t none = Origin::none;

  struct Vertex {
    cdt::Point place;
    std::uint32_t outline = none;  ///< index of a point of the part
    std::uint32_t tip = none;      ///< of a point of the tips: then the sheet is there
    double share = 0;  ///< of a vertex that is neither: how far it is from the part's slice
  };
  using Triangle = std::array<std::uint32_t, 3>;

  /// Tips are the lines of a region; those that the part does not cover are left out: it covers
  /// what is inside or on its outline but for `contact`. None if vertices of one slice are nearer
  /// than that, if no tip is left, or if rounding leaves no room for a vertex.
  static std::optional<TipSheet> make(const Region& part, const Region& tips, double contact);

  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  /// Counter-clockwise.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The vertices along the edge that begins with a loop vertex of the part, with its ends.
  [[nodiscard]] std::vector<std::uint32_t> along(std::size_t loop_vertex) const;
  [[nodiscard]] const std::vector<std::uint32_t>& covered() const { return covered_; }
  /// Whether rounding has moved anything on an outline.
  [[nodiscard]] bool is_doubtful() const { return is_doubtful_; }

 private:
  TipSheet(const Region& part, const Region& tips, double contact)
      : part_(part), tips_(tips), mesh_(contact) {}

  // Of the triangulation.
  void insert();
  [[nodiscard]] bool is_inside(cdt::EdgeId e) const;
  [[nodiscard]] std::vector<cdt::VertexId> line_vertices(std::size_t line) const;
  [[nodiscard]] bool covers(std::size_t line) const;
  void classify();
  [[nodiscard]] bool drop_uncovered();
  [[nodiscard]] bool note_vertices();
  void list_triangles();
  [[nodiscard]] bool list_outline();

  // Of the triangles.
  [[nodiscard]] std::uint32_t from(std::uint32_t h) const { return triangles_[h / 3][h % 3]; }
  [[nodiscard]] std::uint32_t to(std::uint32_t h) const { return from(next(h)); }
  [[nodiscard]] std::uint32_t apex(std::uint32_t h) const { return from(next(next(h))); }
  [[nodiscard]] static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] cdt::Point place(std::uint32_t v) const { return vertices_[v].place; }
  [[nodiscard]] bool is_tip(std::uint32_t v) const { return vertices_[v].tip != none; }
  [[nodiscard]] bool is_made(std::uint32_t v) const {
    return !is_tip(v) && vertices_[v].outline == none;
  }
  [[nodiscard]] bool is_chord(std::uint32_t h) const;
  [[nodiscard]] bool is_flippable(std::uint32_t h) const;
  void join(std::uint32_t h, std::uint32_t twin, bool is_line);
  void flip(std::uint32_t h);
  void flip_chords();
  [[nodiscard]] std::vector<std::uint32_t> chords() const;
  [[nodiscard]] bool lift_chords();
  [[nodiscard]] bool lift_flat();
  void split_edge(std::uint32_t h, std::uint32_t middle);
  void split_side(std::uint32_t h, std::uint32_t middle);
  void split_triangle(std::uint32_t t, std::uint32_t middle);
  [[nodiscard]] bool is_upright() const;

  const Region& part_;
  const Region& tips_;
  cdt::Triangulation mesh_;
  std::vector<std::optional<cdt::ConstraintId>> constraints_;  // of each line, while it is in
  std::vector<bool> is_inside_;                                // of each triangle of the mesh
  std::vector<std::uint32_t> covered_;
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> vertex_of_;  // of each vertex of the mesh
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> twins_;                     // of each side; none on the outline
  std::vector<bool> is_line_;                            // whether a line runs along a side
  std::vector<std::vector<std::uint32_t>> outline_;      // what is along each edge of the part
  using Ends = std::pair<std::uint32_t, std::uint32_t>;  // the smaller number first
  std::map<Ends, std::uint32_t> middles_;                // of pieces of the outline
  std::map<Ends, std::uint32_t> sides_;                  // where chords are
  bool is_doubtful_ = false;
};

}  // namespace loft
