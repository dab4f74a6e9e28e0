// SPDX-License-Identifier: MIT
#include "tests/cdt/reference.h"

#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "cdt/predicates.h"

namespace loft::cdt {

namespace {

using Integer = boost::multiprecision::cpp_int;

/// Coordinates as integers, in units of a power of two that divides them all, and what is half way
/// between them and their neighbours.
class Scale {
 public:
  explicit Scale(std::span<const Point> points) {
    for (const Point p : points)
      for (const double x : {p.x, p.y})
        if (x != 0) unit_ = std::min(unit_, std::ilogb(x) - digits - 1);
  }

  [[nodiscard]] Integer exact(double x) const {
    if (x == 0) return 0;
    const int shift = std::ilogb(x) - digits;
    const auto mantissa = static_cast<std::int64_t>(std::scalbn(x, -shift));
    return Integer(mantissa) << static_cast<unsigned>(shift - unit_);
  }

 private:
  static constexpr int digits = std::numeric_limits<double>::digits + 2;
  int unit_ = std::numeric_limits<int>::max();
};

struct ExactPoint {
  Integer x;
  Integer y;
};

bool is_strictly_between(Point a, Point b, Point p) {
  return std::min(a, b) < p && p < std::max(a, b) && orient(a, b, p) == 0;
}

bool may_meet(Point a, Point b, Point c, Point d) {
  return std::max(a.x, b.x) >= std::min(c.x, d.x) && std::max(c.x, d.x) >= std::min(a.x, b.x) &&
         std::max(a.y, b.y) >= std::min(c.y, d.y) && std::max(c.y, d.y) >= std::min(a.y, b.y);
}

/// The way from a to b: p before q.
bool is_in_order(Point p, Point q, Point a, Point b) {
  const auto keeps = [](double from, double to, double start, double end) {
    return start <= end ? from <= to : from >= to;
  };
  return p != q && keeps(p.x, q.x, a.x, b.x) && keeps(p.y, q.y, a.y, b.y);
}

template <class Visit>
void for_each_segment(const Outline& outline, Visit visit) {
  const auto& points = outline.points;
  for (std::size_t i = 1; i < points.size(); ++i) visit(i - 1, points[i - 1], points[i]);
  if (outline.ends == closed && points.size() > 1)
    visit(points.size() - 1, points.back(), points.front());
}

void make_set(std::vector<Point>& points) {
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// Whether points of a segment round to vertices, by rational arithmetic.
class Tracer {
 public:
  explicit Tracer(std::span<const Point> vertices) : vertices_(vertices), scale_(vertices) {}

  /// From the smaller end to the larger.
  [[nodiscard]] std::vector<Point> chain(Point low, Point high) const {
    std::vector<Point> chain;
    for (const Point p : vertices_)
      if (p == low || p == high || rounds_to(low, high, p)) chain.push_back(p);
    std::ranges::sort(chain, [&](Point p, Point q) { return is_in_order(p, q, low, high); });
    return chain;
  }

 private:
  /// What rounds to a coordinate: from half way to its neighbour below to half way to the one
  /// above, in units of a half; the ends are included if it is even.
  struct Cell {
    Integer low;
    Integer high;
    bool has_ends;
  };
  /// Part of the way along a segment, as fractions of one denominator.
  struct Stretch {
    Integer from;
    Integer to;
    bool has_from = true;
    bool has_to = true;
  };

  [[nodiscard]] Cell cell(double x) const {
    if (x == 0) return {0, 0, true};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Integer here = scale_.exact(x);
    return {here + scale_.exact(std::nextafter(x, -infinity)),
            here + scale_.exact(std::nextafter(x, infinity)),
            (std::bit_cast<std::uint64_t>(x) & 1) == 0};
  }

  /// Where the way from a to b, both in halves, is in a cell; in units of 1 / scale.
  [[nodiscard]] static std::optional<Stretch> clip(const Integer& a, const Integer& b,
                                                   const Cell& cell, const Integer& scale) {
    if (a == b) {
      const bool is_inside =
          cell.has_ends ? cell.low <= a && a <= cell.high : cell.low < a && a < cell.high;
      if (!is_inside) return {};
      return Stretch{0, scale, true, true};
    }
    const Integer other = scale / (b > a ? Integer(b - a) : Integer(a - b));
    Stretch stretch = b > a ? Stretch{(cell.low - a) * other, (cell.high - a) * other}
                            : Stretch{(a - cell.high) * other, (a - cell.low) * other};
    stretch.has_from = stretch.has_to = cell.has_ends;
    return stretch;
  }

  [[nodiscard]] bool rounds_to(Point a, Point b, Point p) const {
    if (!may_meet(a, b, p, p)) return false;
    const double reach = std::abs(p.x) + std::abs(p.y);
    const double way = std::abs(b.x - a.x) + std::abs(b.y - a.y);
    const double near = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    const double far = std::abs(a.x) + std::abs(a.y) + reach;
    if (std::abs(near) > 1e-14 * far * way) return false;  // what is left is decided exactly
    const Integer ax = 2 * scale_.exact(a.x), ay = 2 * scale_.exact(a.y);
    const Integer bx = 2 * scale_.exact(b.x), by = 2 * scale_.exact(b.y);
    const Integer wide = ax == bx ? Integer(1) : Integer(abs(bx - ax));
    const Integer tall = ay == by ? Integer(1) : Integer(abs(by - ay));
    const Integer scale = wide * tall;
    const auto x = clip(ax, bx, cell(p.x), scale);
    const auto y = clip(ay, by, cell(p.y), scale);
    if (!x || !y) return false;
    Stretch both{0, scale, true, true};
    for (const Stretch& stretch : {*x, *y}) {
      if (stretch.from > both.from || (stretch.from == both.from && !stretch.has_from)) {
        both.from = stretch.from;
        both.has_from = stretch.has_from;
      }
      if (stretch.to < both.to || (stretch.to == both.to && !stretch.has_to)) {
        both.to = stretch.to;
        both.has_to = stretch.has_to;
      }
    }
    return both.from < both.to || (both.from == both.to && both.has_from && both.has_to);
  }

  std::span<const Point> vertices_;
  Scale scale_;
};

/// Wraps triangles around everything, one after the other: from an edge to the corner whose circle
/// with it is the smallest, of those that can be joined to both of its ends.
class Wrapping {
 public:
  using Index = std::size_t;
  struct Side {
    Index from;
    Index to;
  };

  Wrapping(const std::vector<Point>& vertices, std::vector<Side> constrained)
      : vertices_(vertices),
        constrained_(std::move(constrained)),
        is_done_(vertices.size() * vertices.size()) {}

  [[nodiscard]] std::vector<Corners> triangles() {
    std::vector<Corners> triangles;
    std::vector<Side> front;
    if (const auto first = hull_side()) front.push_back(*first);
    while (!front.empty()) {
      const auto [a, b] = front.back();
      front.pop_back();
      if (is_done(a, b)) continue;
      const auto c = corner(a, b);
      if (!c) continue;
      for (const auto& [from, to] : {Side{a, b}, Side{b, *c}, Side{*c, a}}) {
        is_done(from, to) = true;
        front.push_back({to, from});
      }
      Corners& corners = triangles.emplace_back(Corners{at(a), at(b), at(*c)});
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    }
    std::ranges::sort(triangles);
    return triangles;
  }

 private:
  [[nodiscard]] Point at(Index v) const { return vertices_[v]; }
  [[nodiscard]] char& is_done(Index a, Index b) { return is_done_[a * vertices_.size() + b]; }

  /// From the smallest vertex, with all others on its left, or behind its end.
  [[nodiscard]] std::optional<Side> hull_side() const {
    if (vertices_.size() < 3) return {};
    Index b = 1;
    for (Index v = 2; v < vertices_.size(); ++v)
      if (orient(at(0), at(b), at(v)) < 0) b = v;
    return Side{0, b};
  }

  [[nodiscard]] std::optional<Index> corner(Index a, Index b) {
    std::optional<Index> best;
    for (Index c = 0; c < vertices_.size(); ++c) {
      if (c == a || c == b || orient(at(a), at(b), at(c)) <= 0) continue;
      if (best && in_circle_perturbed(at(a), at(b), at(*best), at(c)) < 0) continue;
      if (can_join(a, c) && can_join(b, c)) best = c;
    }
    return best;
  }

  /// Whether nothing is between two vertices. What was in the way once often is again: it comes
  /// to the front.
  [[nodiscard]] bool can_join(Index a, Index b) {
    const auto is_in_the_way = [&](const Side& side) {
      return may_meet(at(a), at(b), at(side.from), at(side.to)) &&
             crosses(at(a), at(b), at(side.from), at(side.to));
    };
    const auto obstacle = std::ranges::find_if(constrained_, is_in_the_way);
    if (obstacle != constrained_.end()) {
      std::rotate(constrained_.begin(), obstacle, obstacle + 1);
      return false;
    }
    return std::ranges::none_of(vertices_,
                                [&](Point p) { return is_strictly_between(at(a), at(b), p); });
  }

  const std::vector<Point>& vertices_;
  std::vector<Side> constrained_;
  std::vector<char> is_done_;
};

}  // namespace

Reference::Reference(std::span<const Outline> constraints) {
  gather_points(constraints);
  trace_chains(constraints);
  lead_runs(constraints);
}

void Reference::gather_points(std::span<const Outline> constraints) {
  for (const Outline& outline : constraints)
    inputs_.insert(inputs_.end(), outline.points.begin(), outline.points.end());
  make_set(inputs_);
}

void Reference::trace_chains(std::span<const Outline> constraints) {
  for (const Outline& outline : constraints)
    for_each_segment(outline, [&](std::size_t, Point a, Point b) {
      if (a != b) chains_[std::minmax(a, b)];
    });
  vertices_ = inputs_;
  for (auto one = chains_.begin(); one != chains_.end(); ++one) {
    const auto& [a, b] = one->first;
    for (auto other = chains_.begin(); other != one; ++other) {
      const auto& [c, d] = other->first;
      if (may_meet(a, b, c, d) && crosses(a, b, c, d))
        vertices_.push_back(intersection(a, b, c, d));
    }
  }
  make_set(vertices_);
  const Tracer tracer(vertices_);
  for (auto& [ends, chain] : chains_) chain = tracer.chain(ends.first, ends.second);
}

void Reference::lead_runs(std::span<const Outline> constraints) {
  for (std::size_t c = 0; c < constraints.size(); ++c)
    for_each_segment(constraints[c], [&](std::size_t s, Point a, Point b) {
      if (a == b) return;
      std::vector<Point> way = chains_.at(std::minmax(a, b));
      if (b < a) std::ranges::reverse(way);
      for (std::size_t i = 1; i < way.size(); ++i)
        lines_[std::minmax(way[i - 1], way[i])].push_back({c, s, way[i - 1] < way[i]});
    });
  for (auto& [ends, runs] : lines_) std::ranges::sort(runs);
}

bool Reference::is_embeddable() const {
  for (auto one = lines_.begin(); one != lines_.end(); ++one) {
    const auto& [a, b] = one->first;
    for (const Point p : vertices_)
      if (is_strictly_between(a, b, p)) return false;
    for (auto other = lines_.begin(); other != one; ++other) {
      const auto& [c, d] = other->first;
      if (may_meet(a, b, c, d) && crosses(a, b, c, d)) return false;
    }
  }
  return std::ranges::none_of(chains_, [&](const auto& entry) { return leaves_aside(entry); });
}

/// Whether a vertex is between a segment and its chain.
bool Reference::leaves_aside(const std::pair<const Straight, std::vector<Point>>& entry) const {
  const auto& [ends, chain] = entry;
  const auto [a, b] = ends;
  for (std::size_t i = 1; chain.size() > 2 && i < chain.size(); ++i) {
    const Point p = chain[i - 1];
    const Point q = chain[i];
    const auto is_aside = [&, a = a, b = b](Point v) {
      return is_in_order(p, v, a, b) && is_in_order(v, q, a, b) &&
             orient(a, b, v) != orient(p, q, v);
    };
    if (std::ranges::any_of(vertices_, is_aside)) return true;
  }
  return false;
}

Picture Reference::picture() const {
  Picture picture{vertices_, {}, {}};
  std::vector<Wrapping::Side> constrained;
  const auto index = [&](Point p) {
    return static_cast<std::size_t>(std::ranges::lower_bound(vertices_, p) - vertices_.begin());
  };
  for (const auto& [ends, runs] : lines_) {
    picture.lines.push_back({ends.first, ends.second, runs});
    constrained.push_back({index(ends.first), index(ends.second)});
  }
  picture.triangles = Wrapping(vertices_, std::move(constrained)).triangles();
  return picture;
}

}  // namespace loft::cdt
