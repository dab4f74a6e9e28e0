// SPDX-License-Identifier: MIT
#include "paths/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace loft::paths {

namespace {

/// Cells in a row for so many segments: some go through many.
[[nodiscard]] std::size_t columns_for(std::size_t segments) {
  constexpr std::size_t least = 8;
  constexpr std::size_t most = 256;
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(segments)));
  return std::clamp(2 * root, least, most);
}

}  // namespace

void CellGrid::lay_out(const cdt::Box& box, std::size_t segments) {
  box_ = box;
  columns_ = columns_for(segments);
  const auto scale = [&](double low, double high) {
    return high > low ? static_cast<double>(columns_) / (high - low) : 0;
  };
  per_x_ = scale(box.low.x, box.high.x);
  per_y_ = scale(box.low.y, box.high.y);
  cells_.assign(columns_ * columns_, {});
}

std::size_t CellGrid::column(double x) const { return rank((x - box_.low.x) * per_x_); }
std::size_t CellGrid::row(double y) const { return rank((y - box_.low.y) * per_y_); }

/// In a row or column, however far out it is.
std::size_t CellGrid::rank(double at) const {
  const auto last = static_cast<double>(columns_ - 1);
  return at > 0 ? static_cast<std::size_t>(std::min(at, last)) : 0;
}

/// Row by row, between where the segment comes in and goes out.
template <class Visit>
void CellGrid::for_each_cell(cdt::Point from, cdt::Point to, double margin, Visit visit) const {
  if (to.y < from.y) std::swap(from, to);
  const std::size_t first = row(from.y - margin);
  const std::size_t last = row(to.y + margin);
  for (std::size_t r = first; r <= last; ++r) {
    double low = std::min(from.x, to.x);
    double high = std::max(from.x, to.x);
    if (per_y_ > 0 && to.y > from.y) {
      // A bit more than the row, for rounding.
      const double height = 1 / per_y_;
      const double bottom = box_.low.y + (static_cast<double>(r) - 0.01) * height - margin;
      const double top = box_.low.y + (static_cast<double>(r) + 1.01) * height + margin;
      const auto at = [&](double y) {
        const double t = std::clamp((y - from.y) / (to.y - from.y), 0.0, 1.0);
        return from.x + t * (to.x - from.x);
      };
      const double one = at(r == 0 ? from.y : bottom);
      const double other = at(r + 1 == columns_ ? to.y : top);
      low = std::max(low, std::min(one, other));
      high = std::min(high, std::max(one, other));
    }
    const std::size_t right = column(high + margin);
    for (std::size_t c = column(low - margin); c <= right; ++c) visit(r * columns_ + c);
  }
}

void CellGrid::add(Item item, cdt::Point from, cdt::Point to, double margin) {
  for_each_cell(from, to, margin, [&](std::size_t cell) { cells_[cell].push_back(item); });
}

void CellGrid::remove(Item item, cdt::Point from, cdt::Point to, double margin) {
  for_each_cell(from, to, margin, [&](std::size_t cell) {
    auto& items = cells_[cell];
    const auto found = std::ranges::find(items, item);
    if (found == items.end()) return;
    *found = items.back();
    items.pop_back();
  });
}

void CellGrid::find(const cdt::Box& box, std::vector<Item>& found) const {
  if (cells_.empty() || box.is_empty()) return;
  const std::size_t right = column(box.high.x);
  const std::size_t top = row(box.high.y);
  for (std::size_t r = row(box.low.y); r <= top; ++r)
    for (std::size_t c = column(box.low.x); c <= right; ++c)
      found.insert(found.end(), cells_[r * columns_ + c].begin(), cells_[r * columns_ + c].end());
}

}  // namespace loft::paths
