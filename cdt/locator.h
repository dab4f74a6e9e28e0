// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/ids.h"
#include "cdt/point.h"

namespace loft::cdt {

/// Remembers a vertex for each cell of a grid over the plane, and for each cell of coarser grids
/// above it, none of them much longer than wide, so that a walk can begin near its goal:
/// jump-and-walk (Mücke, Saias, Zhu 1996) with the jump looked up. It only ever suggests, so
/// nothing depends on what it knows. Memory: about 3 bytes a vertex. Cost: constant; laying it out
/// anew is amortised.
class Locator {
 public:
  void clear();
  /// Whether so many vertices or a place so far out ask for a new layout.
  [[nodiscard]] bool is_outgrown(std::size_t vertices, Point p) const;
  /// A new grid over these points; the ids are their indices. Unused ones have coordinates that
  /// are not finite.
  void lay_out(std::span<const Point> points, std::size_t used);
  void add(VertexId v, Point p);
  /// `instead` is another vertex nearby, or none.
  void replace(VertexId v, Point p, VertexId instead);
  /// The same vertex, at q instead of p.
  void move(VertexId v, Point p, Point q, VertexId instead);
  /// A vertex near p; none if nothing is known.
  [[nodiscard]] VertexId near(Point p) const;

 private:
  friend class Persistence;
  static constexpr unsigned most_levels = 14;

  void set_out(unsigned levels, Box box);

  [[nodiscard]] bool contains(Point p) const {
    return p.x >= box_.low.x && p.x <= box_.high.x && p.y >= box_.low.y && p.y <= box_.high.y;
  }
  /// Where it is in the finest grid.
  struct Place {
    std::size_t column;
    std::size_t row;

    friend bool operator==(const Place&, const Place&) = default;
  };
  [[nodiscard]] Place finest(Point p) const;
  [[nodiscard]] std::size_t cell(Place place, unsigned level) const;
  /// The binary logarithm of how many columns a level has; it has 4^(level + 1) cells.
  [[nodiscard]] unsigned column_bits(unsigned level) const;

  Box box_;
  double columns_per_unit_ = 0;
  double rows_per_unit_ = 0;
  unsigned finest_bits_ = 0;                      // column_bits() of the finest grid
  unsigned levels_ = 0;                           // the finest grid has 4^levels cells
  int tilt_ = 0;                                  // half the binary logarithm of height by width
  std::size_t laid_out_for_ = 0;                  // vertices
  std::array<std::size_t, most_levels> first_{};  // where a level's cells begin
  std::vector<VertexId> cells_;
};

}  // namespace loft::cdt
