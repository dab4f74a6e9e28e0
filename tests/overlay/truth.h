// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "overlay/layer.h"
#include "overlay/polygon.h"
#include "tests/overlay/fixed_point.h"

namespace loft::overlay {

/// What the result of an operation is, without rounding.
template <class Number>
struct TrueResult {
  Number twice_area;               ///< in units of the arrangement's coordinates
  std::vector<std::size_t> holes;  ///< how many each polygon has, sorted
};

/// The arrangement of rings of two layers in columns: the plane is cut at the x of each corner and
/// crossing; between two such lines nothing crosses, so the segments there are in one order, with
/// cells between them. It knows nothing of triangulations. Its `Number` is a FixedPoint with places
/// enough, or a rational number behind the same functions.
///
/// Coordinates are doubles times 2^shift, which must make them whole.
template <class Number>
class TrueArrangement {
 public:
  /// How often each layer's rings wind around.
  using Turns = std::array<int, 2>;
  using Whole = typename Number::Whole;

  TrueArrangement(const std::array<std::vector<Ring>, 2>& layers, int shift) : shift_(shift) {
    for (std::size_t layer = 0; layer < 2; ++layer)
      for (const Ring& ring : layers[layer])
        for (std::size_t i = 0; i < ring.size(); ++i)
          add(layer, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
    for (std::size_t i = 0; i < segments_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) cross(segments_[i], segments_[k]);
    make_columns();
  }

  /// The result where what is inside is said by the windings.
  template <class IsInside>
  [[nodiscard]] TrueResult<Number> result(const IsInside& is_inside) const {
    std::vector<bool> inside;
    TrueResult<Number> result;
    for (const Cell& cell : cells_) {
      inside.push_back(is_inside(cell.turns));
      if (inside.back()) result.twice_area = result.twice_area + cell.twice_area;
    }
    result.holes = holes_of_polygons(inside);
    return result;
  }

  /// Whether all corners and crossings are doubles.
  [[nodiscard]] bool is_representable() const {
    return std::ranges::all_of(places_,
                               [&](const Place& p) { return is_double(p.x) && is_double(p.y); });
  }

  /// Whether each corner and crossing is further than so much from the segments that it is not on:
  /// if so, nothing changes sides by moving less than half of that.
  [[nodiscard]] bool is_clear_by(double distance) const {
    return std::ranges::all_of(places_, [&](const Place& p) {
      return std::ranges::all_of(
          segments_, [&](const Segment& s) { return !is_nearer(p, s, distance) || is_on(p, s); });
    });
  }

  [[nodiscard]] int shift() const { return shift_; }

 private:
  struct Place {
    Number x, y;
    double near_x, near_y;  // as the doubles were
  };
  /// From left to right; upright ones upward.
  struct Segment {
    Whole x, y, dx, dy;
    Point from, to;
    std::size_t layer;
    int step;       // of the layer's winding, where it is crossed upward
    Number height;  // on the line that the last column ends at
  };
  /// Segments in a column that are the same there.
  struct Strand {
    Number left, right;  // heights on the column's lines
    Turns step;
  };
  struct Column {
    std::vector<Strand> strands;
    std::size_t first_cell;  // below all strands; others follow upward
  };
  struct Cell {
    Turns turns;
    Number twice_area;  // 0 of those without bounds
  };
  using CellPair = std::pair<std::size_t, std::size_t>;

  [[nodiscard]] Whole whole(double x) const {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    const Whole digits(static_cast<long long>(std::ldexp(mantissa, 53)));
    const int up = exponent - 53 + shift_;
    return up >= 0 ? Whole(digits << up) : Whole(digits >> -up);
  }

  void add(std::size_t layer, Point from, Point to) {
    places_.push_back({Number(whole(from.x)), Number(whole(from.y)), from.x, from.y});
    if (from == to) return;
    const int step = from < to ? 1 : -1;
    if (step < 0) std::swap(from, to);
    const Whole x = whole(from.x);
    const Whole y = whole(from.y);
    segments_.push_back({x, y, whole(to.x) - x, whole(to.y) - y, from, to, layer, step, Number(y)});
  }

  [[nodiscard]] static int side(const Segment& s, const Whole& x, const Whole& y) {
    return Whole(s.dx * (y - s.y) - s.dy * (x - s.x)).sign();
  }

  /// Notes where two segments cross inside both.
  void cross(const Segment& a, const Segment& b) {
    if (std::max(a.from.x, b.from.x) > std::min(a.to.x, b.to.x)) return;
    if (side(a, b.x, b.y) * side(a, b.x + b.dx, b.y + b.dy) >= 0) return;
    if (side(b, a.x, a.y) * side(b, a.x + a.dx, a.y + a.dy) >= 0) return;
    const Whole way = b.dx * (a.y - b.y) - b.dy * (a.x - b.x);
    const Whole all = a.dx * b.dy - a.dy * b.dx;
    const Number x = Number(a.x) + Number::quotient(a.dx * way, all);
    const Number y = Number(a.y) + Number::quotient(a.dy * way, all);
    places_.push_back({x, y, x.to_double(shift_), y.to_double(shift_)});
  }

  [[nodiscard]] static Number height(const Segment& s, const Number& x) {
    return Number(s.y) + (x - Number(s.x)) * s.dy / s.dx;
  }

  // Columns and cells.

  void make_columns() {
    std::vector<Place> lines = places_;
    std::ranges::sort(lines, [](const Place& a, const Place& b) { return a.x < b.x; });
    const auto is_same = [](const Place& a, const Place& b) { return a.x == b.x; };
    lines.erase(std::unique(lines.begin(), lines.end(), is_same), lines.end());
    add_column({}, {});
    for (std::size_t i = 0; i + 1 < lines.size(); ++i)
      add_column(strands(lines[i], lines[i + 1]), lines[i + 1].x - lines[i].x);
    add_column({}, {});
  }

  [[nodiscard]] std::vector<Strand> strands(const Place& left, const Place& right) {
    std::vector<Strand> all;
    for (Segment& s : segments_) {
      if (s.dx == 0 || !is_over(s, left, right)) continue;
      Strand& strand = all.emplace_back(Strand{s.height, height(s, right.x), {}});
      strand.step[s.layer] = s.step;
      s.height = strand.right;
    }
    std::ranges::sort(all, [](const Strand& a, const Strand& b) {
      return a.left != b.left ? a.left < b.left : a.right < b.right;
    });
    return merged(all);
  }

  /// Whether a segment is over all of a column; as each ends on a line, it is over all or nothing.
  [[nodiscard]] static bool is_over(const Segment& s, const Place& left, const Place& right) {
    if (s.from.x > left.near_x || s.to.x < right.near_x) return false;
    if (s.from.x < left.near_x && s.to.x > right.near_x) return true;
    return Number(s.x) <= left.x && Number(Whole(s.x + s.dx)) >= right.x;
  }

  [[nodiscard]] static std::vector<Strand> merged(std::span<const Strand> sorted) {
    std::vector<Strand> result;
    for (const Strand& strand : sorted) {
      if (result.empty() || result.back().left != strand.left ||
          result.back().right != strand.right) {
        result.push_back(strand);
        continue;
      }
      for (std::size_t layer = 0; layer < 2; ++layer)
        result.back().step[layer] += strand.step[layer];
    }
    return result;
  }

  void add_column(std::vector<Strand> strands, const Number& width) {
    Column column{std::move(strands), cells_.size()};
    cells_.push_back({});
    for (std::size_t i = 0; i < column.strands.size(); ++i) {
      const Strand& strand = column.strands[i];
      neighbours_.emplace_back(cells_.size() - 1, cells_.size());
      if (i > 0) cells_.back().twice_area = twice_area(column.strands[i - 1], strand, width);
      Cell above{cells_.back().turns, {}};
      for (std::size_t layer = 0; layer < 2; ++layer) above.turns[layer] += strand.step[layer];
      cells_.push_back(above);
    }
    if (column.first_cell != 0) join_columns(last_, column);
    last_ = std::move(column);
  }

  [[nodiscard]] static Number twice_area(const Strand& below, const Strand& above,
                                         const Number& width) {
    return width * ((above.left - below.left) + (above.right - below.right));
  }

  /// The cells of two columns that share a piece of the line between these.
  void join_columns(const Column& a, const Column& b) {
    const std::size_t of_a = a.strands.size();
    const std::size_t of_b = b.strands.size();
    std::size_t i = 0;
    std::size_t k = 0;
    while (true) {
      // Cells i and k share all from the last height up to the next, if that is a piece.
      const bool ends_a = i < of_a && (k == of_b || a.strands[i].right <= b.strands[k].left);
      const bool ends_b = k < of_b && (i == of_a || b.strands[k].left <= a.strands[i].right);
      if (!ends_a && !ends_b) break;
      const Number& next = ends_a ? a.strands[i].right : b.strands[k].left;
      if (const auto low = last_height(a, i, b, k); !low || *low < next)
        neighbours_.emplace_back(a.first_cell + i, b.first_cell + k);
      i += ends_a ? 1 : 0;
      k += ends_b ? 1 : 0;
    }
    neighbours_.emplace_back(a.first_cell + i, b.first_cell + k);
  }

  /// The larger one of the heights at which cells i and k begin; none if both go down without end.
  [[nodiscard]] static std::optional<Number> last_height(const Column& a, std::size_t i,
                                                         const Column& b, std::size_t k) {
    if (i == 0 && k == 0) return std::nullopt;
    if (i == 0) return b.strands[k - 1].left;
    if (k == 0) return a.strands[i - 1].right;
    return std::max(a.strands[i - 1].right, b.strands[k - 1].left);
  }

  // Faces.

  /// Things that are joined, step by step.
  class Union {
   public:
    explicit Union(std::size_t count) : parent_(count) {
      std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }
    [[nodiscard]] std::size_t root(std::size_t a) {
      while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
      return a;
    }

   private:
    std::vector<std::size_t> parent_;
  };

  /// Cells on whose borders nothing changes make faces. A polygon's inside is one face, as faces
  /// are joined along pieces of lines, not in points. Of all that is not in it, what is joined in
  /// the same way, along pieces, is one side of a simple ring, which touches other rings in points:
  /// the outside of the outer ring, or the inside of a hole. So the holes are one fewer than those.
  [[nodiscard]] std::vector<std::size_t> holes_of_polygons(const std::vector<bool>& inside) const {
    Union faces(cells_.size());
    for (const auto& [a, b] : neighbours_)
      if (inside[a] == inside[b]) faces.join(a, b);
    std::vector<CellPair> borders;
    std::vector<std::size_t> outsides;
    std::vector<std::size_t> polygons;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (faces.root(c) == c) (inside[c] ? polygons : outsides).push_back(c);
    for (const auto& [a, b] : neighbours_)
      if (inside[a] != inside[b]) borders.emplace_back(faces.root(a), faces.root(b));
    std::vector<std::size_t> holes;
    for (const std::size_t polygon : polygons)
      holes.push_back(parts_without(polygon, borders, polygons.size() + outsides.size()) - 1);
    std::ranges::sort(holes);
    return holes;
  }

  /// Of so many faces, how many parts those other than one make, joined along borders.
  [[nodiscard]] std::size_t parts_without(std::size_t face, std::span<const CellPair> borders,
                                          std::size_t face_count) const {
    Union parts(cells_.size());
    std::size_t count = face_count - 1;
    for (const auto& [a, b] : borders) {
      if (a == face || b == face || parts.root(a) == parts.root(b)) continue;
      parts.join(a, b);
      --count;
    }
    return count;
  }

  // Distances.

  [[nodiscard]] bool is_double(const Number& x) const {
    return Number::scaled(x.to_double(shift_), shift_) == x;
  }

  [[nodiscard]] static bool is_nearer(const Place& p, const Segment& s, double distance) {
    const double x = s.to.x - s.from.x, y = s.to.y - s.from.y;
    const double to_x = p.near_x - s.from.x, to_y = p.near_y - s.from.y;
    const double length = std::hypot(x, y);
    const double along = std::clamp((to_x * x + to_y * y) / length, 0.0, length);
    return std::hypot(to_x - along * x / length, to_y - along * y / length) < distance;
  }

  /// Exactly on a segment that is near.
  [[nodiscard]] static bool is_on(const Place& p, const Segment& s) {
    const Number x = p.x - Number(s.x);
    const Number y = p.y - Number(s.y);
    if (x * s.dy != y * s.dx) return false;
    const Number from{};
    const bool is_steep = abs(s.dy) > abs(s.dx);
    const Number& along = is_steep ? y : x;
    const Number to(is_steep ? s.dy : s.dx);
    return std::min(from, to) <= along && along <= std::max(from, to);
  }

  int shift_;
  std::vector<Place> places_;  // corners and crossings, some more than once
  std::vector<Segment> segments_;
  std::vector<Cell> cells_;           // column by column
  std::vector<CellPair> neighbours_;  // that share a piece of a line
  Column last_;
};

}  // namespace loft::overlay
