// SPDX-License-Identifier: MIT
#include "cdt/locator.h"

#include <algorithm>
#include <cmath>

namespace loft::cdt {

namespace {

/// Below that a walk is short anyway.
constexpr std::size_t fewest_vertices = 64;

/// By how many halvings a box is higher than wide, halved; no more than `most` either way.
int tilt_of(const Box& box, int most) {
  const double width = std::max(box.high.x - box.low.x, 1e-300);
  const double height = std::max(box.high.y - box.low.y, 1e-300);
  const double tilt = (std::log2(height) - std::log2(width)) / 2;
  return static_cast<int>(std::lround(std::clamp<double>(tilt, -most, most)));
}

}  // namespace

void Locator::clear() {
  box_ = {};
  levels_ = 0;
  finest_bits_ = 0;
  laid_out_for_ = 0;
  cells_.clear();
}

bool Locator::is_outgrown(std::size_t vertices, Point p) const {
  if (vertices < fewest_vertices) return false;
  if (vertices > 2 * laid_out_for_) return true;
  return !contains(p) && 4 * vertices > 5 * laid_out_for_;
}

void Locator::lay_out(std::span<const Point> points, std::size_t used) {
  const auto is_used = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  Box box;
  for (const Point p : points)
    if (is_used(p)) box.add(p);
  laid_out_for_ = used;
  unsigned levels = 1;
  while (levels + 1 < most_levels && (std::size_t{2} << (2 * levels)) < used) ++levels;
  set_out(levels, box);
  for (std::uint32_t v = 0; v < points.size(); ++v)
    if (is_used(points[v])) add(VertexId(v), points[v]);
}

/// Empty grids of so many levels.
void Locator::set_out(unsigned levels, Box box) {
  box_ = box;
  levels_ = levels;
  std::size_t cells = 0;
  for (unsigned level = 0; level < levels_; ++level) {
    first_[level] = cells;
    cells += std::size_t{1} << (2 * (level + 1));
  }
  cells_.assign(cells, VertexId::none());
  finest_bits_ = 0;
  if (levels_ == 0) return;
  tilt_ = tilt_of(box_, static_cast<int>(levels_));
  finest_bits_ = column_bits(levels_ - 1);
  columns_per_unit_ = std::exp2(finest_bits_) / std::max(box_.high.x - box_.low.x, 1e-300);
  rows_per_unit_ =
      std::exp2(2 * levels_ - finest_bits_) / std::max(box_.high.y - box_.low.y, 1e-300);
}

unsigned Locator::column_bits(unsigned level) const {
  const int half = static_cast<int>(level) + 1;
  return static_cast<unsigned>(std::clamp(half - tilt_, 0, 2 * half));
}

/// Places outside the box count to its border.
Locator::Place Locator::finest(Point p) const {
  const auto index = [](double place, unsigned bits) {
    const std::size_t count = std::size_t{1} << bits;
    return place < static_cast<double>(count) ? static_cast<std::size_t>(std::max(place, 0.0))
                                              : count - 1;
  };
  return {index((p.x - box_.low.x) * columns_per_unit_, finest_bits_),
          index((p.y - box_.low.y) * rows_per_unit_, 2 * levels_ - finest_bits_)};
}

/// Row by row.
std::size_t Locator::cell(Place place, unsigned level) const {
  const unsigned columns = column_bits(level);
  const unsigned fewer_rows = 2 * (levels_ - 1 - level) - (finest_bits_ - columns);
  return first_[level] +
         ((place.row >> fewer_rows << columns) | (place.column >> (finest_bits_ - columns)));
}

void Locator::add(VertexId v, Point p) {
  const Place place = finest(p);
  for (unsigned level = levels_; level-- > 0;) {
    VertexId& known = cells_[cell(place, level)];
    const bool was_known = !known.is_none();
    known = v;
    if (was_known) break;
  }
}

void Locator::replace(VertexId v, Point p, VertexId instead) {
  const Place place = finest(p);
  for (unsigned level = levels_; level-- > 0;) {
    VertexId& known = cells_[cell(place, level)];
    if (known == v) known = instead;
  }
}

void Locator::move(VertexId v, Point p, Point q, VertexId instead) {
  if (levels_ == 0 || finest(p) == finest(q)) return;
  replace(v, p, instead);
  add(v, q);
}

VertexId Locator::near(Point p) const {
  const Place place = finest(p);
  for (unsigned level = levels_; level-- > 0;)
    if (const VertexId v = cells_[cell(place, level)]; !v.is_none()) return v;
  return VertexId::none();
}

}  // namespace loft::cdt
