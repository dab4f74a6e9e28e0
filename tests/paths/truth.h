// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cdt/predicates.h"
#include "paths/distance.h"
#include "paths/path.h"
#include "tests/paths/scenes.h"

namespace loft::paths {

/// All shortest paths of a setting, by a graph of what sees what: every end of a piece of border or
/// wall is a place, around which the pieces that end there bound wedges. Two wedges see each other
/// where the straight way from one place to the other begins in the one, ends in the other, and in
/// between meets nothing, not even a place: so a way through a place is one that stays in a wedge
/// there, and a passage without width is none. It asks the setting for border and walls alone.
class Truth {
 public:
  explicit Truth(const Setting& setting) {
    const FreeSpace& space = setting.space();
    const Triangulation& mesh = space.mesh();
    for (const overlay::BorderEdge& edge : space.border())
      barriers_.push_back({edge.from, edge.to, {true, false}});
    const std::size_t borders = barriers_.size();
    for (const overlay::RingId wall : setting.walls())
      for (const EdgeId e : mesh.pieces(wall))
        if (space.is_free(Triangulation::triangle(e)) &&
            space.is_free(Triangulation::triangle(mesh.twin(e))))
          barriers_.push_back({mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), {true, true}});
    borders_ = borders;
    drop_repeated_walls();
    for (const Barrier& barrier : barriers_) {
      points_.push_back(barrier.from);
      points_.push_back(barrier.to);
    }
    std::ranges::sort(points_);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    for (const Point p : points_) places_.push_back(place_at(p));
    links_.resize(places_.size());
    is_linked_.resize(places_.size());
  }

  [[nodiscard]] bool is_free(Point p) const {
    return std::ranges::any_of(place_at(p).wedges, [](bool is_free) { return is_free; });
  }
  [[nodiscard]] bool is_corner(Point p) const { return find(p).has_value(); }
  /// The ends of all pieces of border and wall.
  [[nodiscard]] std::span<const Point> corners() const { return points_; }

  /// How long the shortest path is, if there is one. Precondition: both are free.
  [[nodiscard]] std::optional<double> length(Point from, Point to) {
    const Place start = place_at(from);
    const Place goal = place_at(to);
    std::vector<std::vector<Link>> last(places_.size());
    for (std::uint32_t p = 0; p < places_.size(); ++p)
      for (Link link : links_between(places_[p], goal)) last[p].push_back(link);

    using Entry = std::pair<double, std::pair<std::uint32_t, std::uint32_t>>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> best;
    double shortest = std::numeric_limits<double>::infinity();
    const auto reach = [&](std::uint32_t place, std::uint32_t wedge, double length) {
      const auto [at, is_new] = best.try_emplace({place, wedge}, length);
      if (!is_new && at->second <= length) return;
      at->second = length;
      queue.push({length, {place, wedge}});
    };
    if (from == to) return 0;
    for (const Link& link : links_between(start, goal)) shortest = std::min(shortest, link.length);
    for (std::uint32_t p = 0; p < places_.size(); ++p)
      for (const Link& link : links_between(start, places_[p])) reach(p, link.there, link.length);
    while (!queue.empty()) {
      const auto [length, at] = queue.top();
      queue.pop();
      if (length >= shortest) break;
      if (best.at(at) < length) continue;
      const auto [place, wedge] = at;
      for (const Link& link : last[place])
        if (link.here == wedge) shortest = std::min(shortest, length + link.length);
      for (const Link& link : links_of(place))
        if (link.here == wedge) reach(link.place, link.there, length + link.length);
    }
    if (shortest < std::numeric_limits<double>::infinity()) return shortest;
    return std::nullopt;
  }

  /// Whether a path meets no inside of an obstacle, crosses no wall and goes through no passage
  /// without width.
  [[nodiscard]] bool is_clear(std::span<const Piece> pieces) const {
    std::vector<std::uint32_t> wedges;
    for (const Piece& piece : pieces) {
      const std::vector<Point> stops = stops_on(piece.from, piece.to);
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const bool is_first = &piece == &pieces.front() && i == 0;
        std::vector<std::uint32_t> next;
        for (const Link& link : links_between(place_at(stops[i]), place_at(stops[i + 1])))
          if (is_first || std::ranges::find(wedges, link.here) != wedges.end())
            next.push_back(link.there);
        if (next.empty()) return false;
        wedges = next;
      }
    }
    return true;
  }

  /// Whether a path that comes from `before` and goes to `after` has something to turn around at a
  /// place between: on the inner side of the turn.
  [[nodiscard]] bool turns_around_something(Point before, Point here, Point after) const {
    const int turn = cdt::orient(before, here, after);
    if (turn == 0 || !is_corner(here)) return false;
    const Point first = turn > 0 ? after : before;
    const Point last = turn > 0 ? before : after;
    const Place place = place_at(here);
    return std::ranges::any_of(place.rays, [&](const Ray& ray) {
      return cdt::orient(here, first, ray.to) >= 0 && cdt::orient(here, ray.to, last) >= 0;
    });
  }

 private:
  /// Nobody goes through it. What is free beside it: on its left, and on its right.
  struct Barrier {
    Point from;
    Point to;
    std::pair<bool, bool> is_free;
  };
  /// A barrier from a place, with what is free counter-clockwise after it.
  struct Ray {
    Point to;
    bool is_free_after = false;
  };
  /// Wedge i is between the rays i and i + 1; without rays there is one, all around.
  struct Place {
    Point at;
    std::vector<Ray> rays;
    std::vector<bool> wedges;  // whether it is free
  };
  /// From a wedge of one place to one of another.
  struct Link {
    std::uint32_t place;
    std::uint32_t here;
    std::uint32_t there;
    double length;
  };
  /// In which direction something is, seen from a place: along a ray, or in a wedge.
  struct Direction {
    bool is_along = false;
    std::uint32_t index = 0;
  };

  /// Pieces of walls may lie on one another, and some on the border.
  void drop_repeated_walls() {
    const auto walls = barriers_.begin() + static_cast<std::ptrdiff_t>(borders_);
    for (auto at = walls; at != barriers_.end(); ++at)
      if (at->to < at->from) std::swap(at->from, at->to);
    std::sort(walls, barriers_.end(), [](const Barrier& a, const Barrier& b) {
      return std::pair(a.from, a.to) < std::pair(b.from, b.to);
    });
    const auto is_same = [](const Barrier& a, const Barrier& b) {
      return a.from == b.from && a.to == b.to;
    };
    barriers_.erase(std::unique(walls, barriers_.end(), is_same), barriers_.end());
  }

  [[nodiscard]] std::optional<std::uint32_t> find(Point p) const {
    const auto at = std::ranges::lower_bound(points_, p);
    if (at == points_.end() || *at != p) return std::nullopt;
    return static_cast<std::uint32_t>(at - points_.begin());
  }

  [[nodiscard]] static bool is_between(Point a, Point p, Point b) {
    return (a < p && p < b) || (b < p && p < a);
  }
  [[nodiscard]] static bool is_ahead(Point from, Point to, Point p) {
    return (from < to) == (from < p);
  }
  /// Whether the direction from the origin to p comes in the first half turn.
  [[nodiscard]] static bool is_upper(Point origin, Point p) {
    return p.y > origin.y || (p.y == origin.y && p.x > origin.x);
  }
  [[nodiscard]] static bool is_before(Point origin, Point a, Point b) {
    if (is_upper(origin, a) != is_upper(origin, b)) return is_upper(origin, a);
    return cdt::orient(origin, a, b) > 0;
  }

  [[nodiscard]] Place place_at(Point p) const {
    if (!places_.empty() && places_.size() == points_.size())
      if (const auto at = find(p)) return places_[*at];
    Place place{p, {}, {}};
    for (const Barrier& b : barriers_) {
      const bool is_inside = p != b.from && p != b.to && is_between(b.from, p, b.to) &&
                             cdt::orient(b.from, b.to, p) == 0;
      if (p == b.from || is_inside) place.rays.push_back({b.to, b.is_free.first});
      if (p == b.to || is_inside) place.rays.push_back({b.from, b.is_free.second});
    }
    std::ranges::sort(place.rays,
                      [&](const Ray& a, const Ray& b) { return is_before(p, a.to, b.to); });
    for (const Ray& ray : place.rays) place.wedges.push_back(ray.is_free_after);
    if (place.rays.empty()) place.wedges.push_back(is_inside(p));
    return place;
  }

  /// Whether a point on no barrier is in what the border encloses: a ray to its right.
  [[nodiscard]] bool is_inside(Point p) const {
    bool is_inside = false;
    for (std::size_t i = 0; i < borders_; ++i) {
      const auto [from, to, is_free] = barriers_[i];
      if ((from.y > p.y) == (to.y > p.y)) continue;
      const int side = cdt::orient(from, to, p);
      if (to.y > from.y ? side > 0 : side < 0) is_inside = !is_inside;
    }
    return is_inside;
  }

  [[nodiscard]] static Direction direction(const Place& from, Point to) {
    const auto count = static_cast<std::uint32_t>(from.rays.size());
    for (std::uint32_t i = 0; i < count; ++i)
      if (cdt::orient(from.at, from.rays[i].to, to) == 0 && is_ahead(from.at, from.rays[i].to, to))
        return {true, i};
    for (std::uint32_t i = 0; i < count; ++i)
      if (is_before(from.at, to, from.rays[i].to)) return {false, (i + count - 1) % count};
    return {false, count == 0 ? 0 : count - 1};
  }

  [[nodiscard]] const std::vector<Link>& links_of(std::uint32_t place) {
    if (!is_linked_[place]) {
      is_linked_[place] = true;
      for (std::uint32_t other = 0; other < places_.size(); ++other)
        for (Link link : links_between(places_[place], places_[other])) {
          link.place = other;
          links_[place].push_back(link);
        }
    }
    return links_[place];
  }

  [[nodiscard]] std::vector<Link> links_between(const Place& a, const Place& b) const {
    std::vector<Link> links;
    if (a.at == b.at) return links;
    const Direction there = direction(a, b.at);
    const double length = distance_between(a.at, b.at);
    const auto add = [&](std::size_t here, std::size_t other) {
      if (a.wedges[here] && b.wedges[other])
        links.push_back(
            {0, static_cast<std::uint32_t>(here), static_cast<std::uint32_t>(other), length});
    };
    if (there.is_along) {
      const Point end = a.rays[there.index].to;
      if (b.at != end && !is_between(a.at, b.at, end)) return links;
      const std::size_t back = direction(b, a.at).index;
      add(there.index, (back + b.rays.size() - 1) % b.rays.size());
      add((there.index + a.rays.size() - 1) % a.rays.size(), back);
      return links;
    }
    if (!a.wedges[there.index] || is_barred(a.at, b.at)) return links;
    add(there.index, direction(b, a.at).index);
    return links;
  }

  /// Whether a barrier crosses the way between two points, or ends on it. The one that did so last
  /// is asked first.
  [[nodiscard]] bool is_barred(Point a, Point b) const {
    if (last_ < barriers_.size() && bars(barriers_[last_], a, b)) return true;
    for (last_ = 0; last_ < barriers_.size(); ++last_)
      if (bars(barriers_[last_], a, b)) return true;
    return false;
  }
  [[nodiscard]] static bool bars(const Barrier& barrier, Point a, Point b) {
    const auto [from, to, is_free] = barrier;
    if (std::max(from.x, to.x) < std::min(a.x, b.x) || std::min(from.x, to.x) > std::max(a.x, b.x))
      return false;
    if (std::max(from.y, to.y) < std::min(a.y, b.y) || std::min(from.y, to.y) > std::max(a.y, b.y))
      return false;
    const int from_side = cdt::orient(a, b, from);
    const int to_side = cdt::orient(a, b, to);
    if (from_side == 0 && is_between(a, from, b)) return true;
    if (to_side == 0 && is_between(a, to, b)) return true;
    return from_side * to_side < 0 && cdt::orient(from, to, a) * cdt::orient(from, to, b) < 0;
  }

  /// The places on a straight way, its ends included, in order.
  [[nodiscard]] std::vector<Point> stops_on(Point from, Point to) const {
    std::vector<Point> stops{from, to};
    for (const Point p : points_)
      if (is_between(from, p, to) && cdt::orient(from, to, p) == 0) stops.push_back(p);
    std::ranges::sort(stops);
    if (to < from) std::ranges::reverse(stops);
    return stops;
  }

  std::vector<Barrier> barriers_;  // the border, then walls
  std::size_t borders_ = 0;
  std::vector<Point> points_;  // sorted
  std::vector<Place> places_;  // of each
  std::vector<std::vector<Link>> links_;
  std::vector<bool> is_linked_;
  mutable std::size_t last_ = 0;
};

inline constexpr double tolerance = 1e-12;

[[nodiscard]] inline std::string name_of(const Query& query) {
  std::ostringstream name;
  name << std::setprecision(17) << query.from << " to " << query.to;
  return name.str();
}

/// A path is what it says: from start to goal, clear of everything, with turns only where it must.
inline void expect_taut(const Truth& truth, const Query& query, const Path& path) {
  Point at = query.from;
  double length = 0;
  for (const Piece& piece : path.pieces) {
    ASSERT_EQ(piece.from, at);
    ASSERT_NE(piece.from, piece.to);
    ASSERT_EQ(piece.turn, Turn::straight);
    at = piece.to;
    length += distance_between(piece.from, piece.to);
  }
  ASSERT_EQ(at, query.to);
  EXPECT_NEAR(length, path.length, tolerance * length);
  EXPECT_TRUE(truth.is_clear(path.pieces));
  for (std::size_t i = 0; i + 1 < path.pieces.size(); ++i)
    EXPECT_TRUE(
        truth.turns_around_something(path.pieces[i].from, path.pieces[i].to, path.pieces[i + 1].to))
        << path.pieces[i].to;
}

}  // namespace loft::paths
