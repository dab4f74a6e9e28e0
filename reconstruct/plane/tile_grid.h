// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// Whether two boxes in the plane have a point in common.
[[nodiscard]] inline bool boxes_meet(const cdt::Box& a, const cdt::Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// Boxes in the plane, sorted into the cells of a regular grid; more can be added.
/// Finds those near a place. Memory: about four entries a box where sizes are alike.
class TileGrid {
 public:
  /// `box_of(i)` is the box of item i.
  template <class BoxOf>
  TileGrid(std::size_t count, BoxOf box_of) {
    std::vector<cdt::Box> boxes(count);
    cdt::Box all;
    double size = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      boxes[i] = box_of(i);
      all.add(boxes[i].low);
      all.add(boxes[i].high);
      size += std::max(boxes[i].high.x - boxes[i].low.x, boxes[i].high.y - boxes[i].low.y);
    }
    lay_out(all, size / static_cast<double>(std::max<std::size_t>(count, 1)), count);
    for (std::uint32_t i = 0; i < count; ++i) add(i, boxes[i]);
  }

  void add(std::uint32_t item, const cdt::Box& box) {
    for_each_cell(box, [&](std::uint32_t& head) {
      entries_.push_back({item, head});
      head = static_cast<std::uint32_t>(entries_.size() - 1);
      return true;
    });
  }

  /// Whether a test holds for all items near a box; stops at the first that fails. An item may be
  /// tested more than once.
  template <class Test>
  [[nodiscard]] bool all_of_near(const cdt::Box& box, Test test) {
    return for_each_cell(box, [&](const std::uint32_t& head) {
      for (std::uint32_t i = head; i != end; i = entries_[i].next)
        if (!test(entries_[i].item)) return false;
      return true;
    });
  }

 private:
  static constexpr std::uint32_t end = 0xffff'ffff;
  struct Entry {
    std::uint32_t item;
    std::uint32_t next;
  };

  /// Cells about as large as the boxes, not many more than there are boxes.
  void lay_out(const cdt::Box& all, double size, std::size_t count) {
    origin_ = all.low;
    const double width = count == 0 ? 0 : all.high.x - all.low.x;
    const double height = count == 0 ? 0 : all.high.y - all.low.y;
    const double least =
        std::sqrt(width * height / static_cast<double>(std::max<std::size_t>(count, 1)));
    const double longest = std::max(width, height);
    cell_ = std::max({size, least, longest / 1024});
    if (!(cell_ > 0)) cell_ = 1;
    columns_ = static_cast<std::size_t>(width / cell_) + 1;
    rows_ = static_cast<std::size_t>(height / cell_) + 1;
    heads_.assign(columns_ * rows_, end);
  }

  template <class Visit>
  bool for_each_cell(const cdt::Box& box, Visit visit) {
    const auto cell = [&](double offset, std::size_t count) {
      const double at = std::floor(offset / cell_);
      return at < 0 ? 0 : std::min(static_cast<std::size_t>(at), count - 1);
    };
    const std::size_t last_column = cell(box.high.x - origin_.x, columns_);
    const std::size_t last_row = cell(box.high.y - origin_.y, rows_);
    for (std::size_t row = cell(box.low.y - origin_.y, rows_); row <= last_row; ++row)
      for (std::size_t column = cell(box.low.x - origin_.x, columns_); column <= last_column;
           ++column)
        if (!visit(heads_[row * columns_ + column])) return false;
    return true;
  }

  cdt::Point origin_;
  double cell_ = 1;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::uint32_t> heads_;  // of each cell's list in entries_
  std::vector<Entry> entries_;
};

}  // namespace loft
