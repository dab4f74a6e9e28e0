// SPDX-License-Identifier: MIT
#include "cdt/locator.h"

#include <algorithm>
#include <cmath>

namespace loft::cdt {

namespace {

/// Below that a walk is short anyway.
constexpr std::size_t fewest_vertices = 64;

}  // namespace

void Locator::clear() {
  box_ = {};
  levels_ = 0;
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
  const double columns = static_cast<double>(1U << levels_);
  columns_per_unit_ = columns / std::max(box_.high.x - box_.low.x, 1e-300);
  rows_per_unit_ = columns / std::max(box_.high.y - box_.low.y, 1e-300);
}

/// Row by row; places outside the box count to its border.
std::size_t Locator::cell(Point p, unsigned level) const {
  const unsigned columns = 1U << levels_;
  const auto index = [&](double place) {
    return place < columns ? static_cast<unsigned>(std::max(place, 0.0)) : columns - 1;
  };
  const unsigned x = index((p.x - box_.low.x) * columns_per_unit_);
  const unsigned y = index((p.y - box_.low.y) * rows_per_unit_);
  const unsigned shift = levels_ - 1 - level;
  return first_[level] + ((std::size_t{y >> shift} << (level + 1)) | (x >> shift));
}

void Locator::add(VertexId v, Point p) {
  for (unsigned level = levels_; level-- > 0;) {
    VertexId& known = cells_[cell(p, level)];
    const bool was_known = !known.is_none();
    known = v;
    if (was_known) break;
  }
}

void Locator::replace(VertexId v, Point p, VertexId instead) {
  for (unsigned level = levels_; level-- > 0;) {
    VertexId& known = cells_[cell(p, level)];
    if (known == v) known = instead;
  }
}

void Locator::move(VertexId v, Point p, Point q, VertexId instead) {
  if (levels_ == 0 || cell(p, levels_ - 1) == cell(q, levels_ - 1)) return;
  replace(v, p, instead);
  add(v, q);
}

VertexId Locator::near(Point p) const {
  for (unsigned level = levels_; level-- > 0;)
    if (const VertexId v = cells_[cell(p, level)]; !v.is_none()) return v;
  return VertexId::none();
}

}  // namespace loft::cdt
