// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <compare>
#include <limits>
#include <ostream>

namespace loft::cdt {

/// A place in the plane. Ordered lexicographically, x first.
struct Point {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point&, const Point&) = default;
  friend auto operator<=>(const Point&, const Point&) = default;
  /// As above, in fewer branches.
  friend bool operator<(const Point& p, const Point& q) {
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  }
  friend std::ostream& operator<<(std::ostream& out, const Point& p) {
    return out << '(' << p.x << ", " << p.y << ')';
  }
};

/// An axis-parallel box; default-constructed it is empty.
struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] bool is_empty() const { return !(low.x <= high.x); }
};

}  // namespace loft::cdt
