// SPDX-License-Identifier: MIT
#include "fields/separator.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "cdt/exact_sum.h"
#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::fields {

namespace {

/// Which side of a direction the other one is on: +1 left. Both lead from one point to another.
int turn_between(Point a, Point b, Point c, Point d) {
  cdt::ExactSum cross;  // (b - a) x (d - c)
  for (const auto& [p, sign] : {std::pair(b, 1), std::pair(a, -1)}) {
    cross.add_product(sign * p.x, d.y);
    cross.add_product(-sign * p.x, c.y);
    cross.add_product(-sign * p.y, d.x);
    cross.add_product(sign * p.y, c.x);
  }
  return cross.sign();
}

/// Where an end far out is, counter-clockwise from where a ray from p to the right ends, which is
/// hardly above p: sectors 0 to 4. The end comes from a to b.
int sector_of_end(Point a, Point b, Point p) {
  constexpr int first = 0, above = 1, opposite = 2, below = 3, last = 4;
  if (a.y != b.y) return a.y < b.y ? above : below;
  if (b.x < a.x) return opposite;
  return b.y > p.y ? first : last;
}

/// Whether a place on the line through a and b is in a part of it.
bool is_in_part(const SeparatorPiece& piece, Point p) {
  using Part = SeparatorPiece::Part;
  const bool is_upward = piece.a < piece.b;
  if (piece.part == Part::before) return is_upward ? p <= piece.a : piece.a <= p;
  if (piece.part == Part::beyond) return is_upward ? piece.b <= p : p <= piece.b;
  return is_upward ? piece.a <= p && p <= piece.b : piece.b <= p && p <= piece.a;
}

/// Whether a piece is at the height of p, or at the one hardly above it.
struct Heights {
  bool at = false;
  bool above = false;
};

Heights heights_at(const SeparatorPiece& piece, Point p) {
  using Part = SeparatorPiece::Part;
  const double from = piece.a.y;
  const double to = piece.b.y;
  if (from == to) return {.at = p.y == from};
  const bool is_rising = from < to;
  if (piece.part == Part::between) {
    const auto [low, high] = std::minmax(from, to);
    return {low <= p.y && p.y <= high, low <= p.y && p.y < high};
  }
  // What ends in a is under it if it rises; what begins in b is over it if it rises.
  const double end = piece.part == Part::before ? from : to;
  const bool is_under = (piece.part == Part::before) == is_rising;
  return is_under ? Heights{p.y <= end, p.y < end} : Heights{end <= p.y, end <= p.y};
}

void check_separator(std::span<const Point> points) {
  if (points.size() < 2)
    throw std::invalid_argument("the separator has " + std::to_string(points.size()) +
                                (points.size() == 1 ? " point" : " points") + " and needs two");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string name = "point " + std::to_string(i) + " of the separator ";
    if (!cdt::Triangulation::is_usable(points[i]))
      throw std::invalid_argument(name +
                                  "has a coordinate that is not usable: it must be 0, or of "
                                  "magnitude 1e-50 to 1e75");
    if (i > 0 && points[i] == points[i - 1])
      throw std::invalid_argument(name + "repeats the one before it");
  }
}

}  // namespace

Standing SeparatorPiece::standing(Point p) const {
  const Heights heights = heights_at(*this, p);
  if (!heights.at) return {};
  const int side = cdt::orient(a, b, p);
  if (side == 0) return {.touches = is_in_part(*this, p) ? 1 : 0};
  const int way = a.y < b.y ? 1 : -1;
  return {.winding = heights.above && side == way ? way : 0};
}

Separator::Separator(std::vector<Point> points) : points_(std::move(points)) {
  using Part = SeparatorPiece::Part;
  check_separator(points_);
  pieces_.reserve(points_.size() + 1);
  pieces_.push_back({Part::before, points_[0], points_[1]});
  for (std::size_t i = 1; i < points_.size(); ++i)
    pieces_.push_back({Part::between, points_[i - 1], points_[i]});
  pieces_.push_back({Part::beyond, points_[points_.size() - 2], points_.back()});
  is_last_end_further_ = is_last_end_further();
}

bool Separator::is_last_end_further() const {
  const Point a = points_[1];
  const Point b = points_[0];
  const Point c = points_[points_.size() - 2];
  const Point d = points_.back();
  const int turn = turn_between(a, b, c, d);
  return turn != 0 ? turn > 0 : cdt::orient(a, b, d) > 0;
}

std::int32_t Separator::closing(Point p) const {
  const int first = sector_of_end(points_[1], points_[0], p);
  const int last = sector_of_end(points_[points_.size() - 2], points_.back(), p);
  // The arc from the last end to the first comes past the ray if that is between.
  return (first != last ? last > first : is_last_end_further_) ? 1 : 0;
}

Standing Separator::standing(Point p) const {
  Standing sum{.winding = closing(p)};
  for (const SeparatorPiece& piece : pieces_) sum += piece.standing(p);
  return sum;
}

OwnPieces own_pieces(const Separator& one, const Separator& other) {
  const auto a = one.pieces();
  const auto b = other.pieces();
  const auto first = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
  std::size_t last = a.size();
  std::size_t last_other = b.size();
  while (last > first && last_other > first && a[last - 1] == b[last_other - 1]) {
    --last;
    --last_other;
  }
  return {first, last};
}

}  // namespace loft::fields
