// SPDX-License-Identifier: MIT
#include "tests/cdt/reference.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "cdt/predicates.h"

namespace loft::cdt {

namespace {

using Integer = boost::multiprecision::cpp_int;

/// Coordinates as integers, in units of a power of two that divides them all.
class Scale {
 public:
  explicit Scale(std::span<const Point> points) {
    for (const Point p : points)
      for (const double x : {p.x, p.y})
        if (x != 0) unit_ = std::min(unit_, std::ilogb(x) - digits);
  }

  [[nodiscard]] Integer exact(double x) const {
    if (x == 0) return 0;
    const int shift = std::ilogb(x) - digits;
    const auto mantissa = static_cast<std::int64_t>(std::scalbn(x, -shift));
    return Integer(mantissa) << static_cast<unsigned>(shift - unit_);
  }

 private:
  static constexpr int digits = std::numeric_limits<double>::digits - 1;
  int unit_ = std::numeric_limits<int>::max();
};

struct ExactPoint {
  Integer x;
  Integer y;
};

Integer area(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  return (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
}

/// A place on a segment: how far along it, exactly, as a fraction with a positive denominator.
struct Stop {
  Integer along;
  Integer of;
  Point place;

  friend bool operator<(const Stop& a, const Stop& b) { return a.along * b.of < b.along * a.of; }
};

bool is_strictly_between(Point a, Point b, Point p) {
  return std::min(a, b) < p && p < std::max(a, b) && orient(a, b, p) == 0;
}

bool may_meet(Point a, Point b, Point c, Point d) {
  return std::max(a.x, b.x) >= std::min(c.x, d.x) && std::max(c.x, d.x) >= std::min(a.x, b.x) &&
         std::max(a.y, b.y) >= std::min(c.y, d.y) && std::max(c.y, d.y) >= std::min(a.y, b.y);
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

/// Finds the places on one segment.
class Tracer {
 public:
  explicit Tracer(std::span<const Point> inputs) : inputs_(inputs), scale_(inputs) {}

  void add(const std::pair<Point, Point>& segment) {
    segments_.push_back(
        {segment.first, segment.second, exact(segment.first), exact(segment.second)});
  }

  [[nodiscard]] std::vector<Point> chain(std::size_t chosen) const {
    const ExactSegment& s = segments_[chosen];
    std::vector<Stop> stops{{0, 1, s.low}, {1, 1, s.high}};
    for (const Point p : inputs_)
      if (is_strictly_between(s.low, s.high, p)) stops.push_back(stop_at(s, p));
    for (const ExactSegment& t : segments_)
      if (may_meet(s.low, s.high, t.low, t.high) && crosses(s.low, s.high, t.low, t.high))
        stops.push_back(crossing(s, t));
    std::ranges::sort(stops, [](const Stop& a, const Stop& b) { return a < b; });
    std::vector<Point> chain;
    for (const Stop& stop : stops)
      if (chain.empty() || chain.back() != stop.place) chain.push_back(stop.place);
    return chain;
  }

 private:
  struct ExactSegment {
    Point low;
    Point high;
    ExactPoint exact_low;
    ExactPoint exact_high;
  };

  [[nodiscard]] ExactPoint exact(Point p) const { return {scale_.exact(p.x), scale_.exact(p.y)}; }

  [[nodiscard]] Stop stop_at(const ExactSegment& s, Point p) const {
    const ExactPoint at = exact(p);
    if (s.low.x != s.high.x) return {at.x - s.exact_low.x, s.exact_high.x - s.exact_low.x, p};
    return {at.y - s.exact_low.y, s.exact_high.y - s.exact_low.y, p};
  }

  [[nodiscard]] static Stop crossing(const ExactSegment& s, const ExactSegment& t) {
    Integer to_low = area(t.exact_low, t.exact_high, s.exact_low);
    Integer whole = to_low - area(t.exact_low, t.exact_high, s.exact_high);
    if (whole < 0) {
      to_low = -to_low;
      whole = -whole;
    }
    return {to_low, whole, intersection(s.low, s.high, t.low, t.high)};
  }

  std::span<const Point> inputs_;
  Scale scale_;
  std::vector<ExactSegment> segments_;
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
  Tracer tracer(inputs_);
  for (const auto& [segment, chain] : chains_) tracer.add(segment);
  vertices_ = inputs_;
  std::size_t i = 0;
  for (auto& [segment, chain] : chains_) {
    chain = tracer.chain(i++);
    vertices_.insert(vertices_.end(), chain.begin(), chain.end());
  }
  make_set(vertices_);
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
  return true;
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
