// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cdt/point.h"

namespace loft::paths {

/// Segments by the cells of a grid that they go through: to find those near a place. A superset:
/// what is told apart by its cell only. Memory: an item for each cell of each segment.
class CellGrid {
 public:
  /// Which segment, and of what.
  struct Item {
    std::uint32_t owner = 0;
    std::uint32_t part = 0;

    friend auto operator<=>(const Item&, const Item&) = default;
  };

  /// Forgets all; a grid over a box from now on. What is outside counts to the cells at its rim.
  void lay_out(const cdt::Box& box, std::size_t segments);
  [[nodiscard]] bool is_laid_out() const { return !cells_.empty(); }

  void add(Item item, cdt::Point from, cdt::Point to, double margin);
  /// Takes out what add() put in with the same values.
  void remove(Item item, cdt::Point from, cdt::Point to, double margin);
  /// Adds the items in the cells of a box to `found`, some more than once.
  void find(const cdt::Box& box, std::vector<Item>& found) const;

 private:
  template <class Visit>
  void for_each_cell(cdt::Point from, cdt::Point to, double margin, Visit visit) const;
  [[nodiscard]] std::size_t column(double x) const;
  [[nodiscard]] std::size_t row(double y) const;
  [[nodiscard]] std::size_t rank(double at) const;

  cdt::Box box_;
  std::size_t columns_ = 0;
  double per_x_ = 0;
  double per_y_ = 0;
  std::vector<std::vector<Item>> cells_;
};

}  // namespace loft::paths
