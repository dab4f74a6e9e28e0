// SPDX-License-Identifier: MIT
#include "reconstruct/clean/keyholes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "cdt/predicates.h"

namespace loft {

namespace {

using cdt::Point;
using Ring = std::vector<std::uint32_t>;

/// The sides of a channel are never further apart than that, compared to where they are nearest,
/// and the points that it ends with not further than that, compared to its width.
constexpr double most_widening = 1.5;

/// Runs at least that long are not followed again from other points of theirs.
constexpr std::size_t long_run = 64;

double distance(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

double distance(Point p, Point a, Point b) {
  const Point along{b.x - a.x, b.y - a.y};
  const double length = along.x * along.x + along.y * along.y;
  const double t =
      length > 0 ? std::clamp(((p.x - a.x) * along.x + (p.y - a.y) * along.y) / length, 0.0, 1.0)
                 : 0.0;
  return distance(p, {a.x + t * along.x, a.y + t * along.y});
}

/// The points of a ring by position; positions go on from n with the first point again.
class Positions {
 public:
  Positions(std::span<const Point> points, const Ring& ring) : points_(points), ring_(ring) {
    lengths_.push_back(0);
    areas_.push_back(0);
    for (std::size_t i = 0; i < 2 * size(); ++i) {
      lengths_.push_back(lengths_.back() + distance(at(i), at(i + 1)));
      areas_.push_back(areas_.back() + twice_area(at(i), at(i + 1)));
    }
  }

  [[nodiscard]] std::size_t size() const { return ring_.size(); }
  [[nodiscard]] Point at(std::size_t i) const { return points_[ring_[i % size()]]; }
  /// The way from one position to a later one.
  [[nodiscard]] double length(std::size_t i, std::size_t j) const {
    return lengths_[j] - lengths_[i];
  }
  [[nodiscard]] double length() const { return lengths_[size()]; }
  /// What the polygon from one position to a later one encloses, turned left or right.
  [[nodiscard]] double area(std::size_t i, std::size_t j) const {
    return std::abs(areas_[j] - areas_[i] + twice_area(at(j), at(i))) / 2;
  }
  /// The polygon from one position to a later one, as a ring; its end only if that is another
  /// place than its start.
  [[nodiscard]] Ring ring(std::size_t i, std::size_t j) const {
    Ring result;
    for (std::size_t k = i; k <= j; ++k) result.push_back(ring_[k % size()]);
    if (at(i) == at(j)) result.pop_back();
    return result;
  }

 private:
  /// Of the triangle with the ring's first point, so that its place costs no accuracy.
  [[nodiscard]] double twice_area(Point a, Point b) const {
    const Point o = at(0);
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  }

  std::span<const Point> points_;
  const Ring& ring_;
  std::vector<double> lengths_;
  std::vector<double> areas_;  // doubled
};

/// Two runs of a ring that are each other's way back, by positions: from `begin` up to `end`, and
/// from `back` up to `home`. What the channel joins is between end and back, and beyond home.
struct Run {
  std::size_t begin;
  std::size_t end;
  std::size_t back;
  std::size_t home;
};

/// How the two parts are to each other that a channel joins.
enum class Parts { apart, first_inside, second_inside };

/// A ring, and whether it bounds a hole: has the region outside.
struct Open {
  Ring ring;
  bool is_hole;
};

/// Finds a channel in one ring.
class Finder {
 public:
  Finder(const Positions& ring, bool is_hole, double width)
      : ring_(ring), is_hole_(is_hole), width_(width), is_spent_(ring.size()) {}

  [[nodiscard]] Parts parts(const Run& run) const {
    const std::size_t next_begin = run.begin + ring_.size();
    if (is_inside(farthest(run.end, run.back), run.home, next_begin)) return Parts::first_inside;
    if (is_inside(farthest(run.home, next_begin), run.end, run.back)) return Parts::second_inside;
    return Parts::apart;
  }

  std::optional<Run> run() {
    for (const auto& [apart, i, j] : close_points()) {
      if (is_spent_[i] && is_spent_[j]) continue;
      const Run run = follow(i, j, std::min(width_, most_widening * apart));
      if (is_channel(run, apart)) return run;
      if (run.end - run.begin < long_run) continue;
      for (std::size_t k = run.begin; k <= run.end; ++k) is_spent_[k % ring_.size()] = true;
      for (std::size_t k = run.back; k <= run.home; ++k) is_spent_[k % ring_.size()] = true;
    }
    return {};
  }

 private:
  struct Close {
    double apart;
    std::size_t i;
    std::size_t j;
    friend auto operator<=>(const Close&, const Close&) = default;
  };

  /// Pairs of points that are further from each other along the ring, and within the width, or
  /// within that of a side of the other where outlines are slanted; the nearest first.
  [[nodiscard]] std::vector<Close> close_points() const {
    const double reach = most_widening * width_;
    std::vector<std::size_t> order(ring_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [this](std::size_t i) { return std::pair(ring_.at(i), i); });
    std::vector<Close> found;
    for (std::size_t a = 0; a < order.size(); ++a) {
      for (std::size_t b = a + 1; b < order.size(); ++b) {
        const Point p = ring_.at(order[a]);
        const Point q = ring_.at(order[b]);
        if (q.x - p.x > reach) break;
        if (std::abs(q.y - p.y) > reach || distance(p, q) > reach) continue;
        const auto [i, j] = std::minmax(order[a], order[b]);
        const double between = ring_.length(i, j);
        if (std::min(between, ring_.length() - between) <= 2 * distance(p, q)) continue;
        if (to_side(i, j) <= width_ || to_side(j, i) <= width_)
          found.push_back({distance(p, q), i, j});
      }
    }
    std::ranges::sort(found);
    return found;
  }

  /// From a point to the nearer one of two sides that meet in another.
  [[nodiscard]] double to_side(std::size_t from, std::size_t to) const {
    const Point p = ring_.at(from);
    return std::min(distance(p, ring_.at(to + ring_.size() - 1), ring_.at(to)),
                    distance(p, ring_.at(to), ring_.at(to + 1)));
  }

  /// From two points both ways, as long as the ring runs along itself.
  [[nodiscard]] Run follow(std::size_t i, std::size_t j, double width) const {
    const auto [end, back] = inwards(i, j, width);
    // Outwards: the same, with the other part of the ring as what is between.
    const auto [home, begin] = inwards(j, i + ring_.size(), width);
    if (begin >= ring_.size()) return {begin - ring_.size(), end, back, home};
    return {begin, end + ring_.size(), back + ring_.size(), home + ring_.size()};
  }

  /// Forward from i and back from j. The channel may end where there are points on both sides.
  [[nodiscard]] std::pair<std::size_t, std::size_t> inwards(std::size_t i, std::size_t j,
                                                            double width) const {
    const auto may_end = [&](std::size_t p, std::size_t q) {
      return distance(ring_.at(p), ring_.at(q)) <= most_widening * width;
    };
    std::pair ends{i, j};
    std::size_t p = i;
    std::size_t q = j;
    while (p + 2 < q) {
      const bool is_along_q = distance(ring_.at(p + 1), ring_.at(q), ring_.at(q - 1)) <= width;
      const bool is_along_p = distance(ring_.at(q - 1), ring_.at(p), ring_.at(p + 1)) <= width;
      if (distance(ring_.at(p + 1), ring_.at(q - 1)) <= width) {
        ++p;
        --q;
      } else if (is_along_q) {
        ++p;
      } else if (is_along_p) {
        --q;
      } else {
        break;
      }
      if (may_end(p, q)) ends = {p, q};
    }
    // One side may go on to a corner of a slanted outline.
    if (p + 2 < q) {
      if (distance(ring_.at(q), ring_.at(p), ring_.at(p + 1)) <= width && may_end(p + 1, q))
        return {p + 1, q};
      if (distance(ring_.at(p), ring_.at(q), ring_.at(q - 1)) <= width && may_end(p, q - 1))
        return {p, q - 1};
    }
    return ends;
  }

  /// Whether a run is one whose sides are that far apart where they are nearest.
  [[nodiscard]] bool is_channel(const Run& run, double apart) const {
    const std::size_t next_begin = run.begin + ring_.size();
    if (next_begin < run.home) return false;
    if (ring_.length(run.begin, run.end) <= apart || ring_.length(run.back, run.home) <= apart)
      return false;
    if (!is_wide(run.end, run.back, apart) || !is_wide(run.home, next_begin, apart)) return false;
    // Outside of an outline is what joins it to a hole; inside of a hole, what joins two of them.
    return (parts(run) == Parts::apart) == is_hole_;
  }

  /// Whether a disc fits into part of the ring whose radius is larger than that. The largest one of
  /// radius r fulfils r l >= a + pi r^2, by length and area (T. Bonnesen, 1921).
  [[nodiscard]] bool is_wide(std::size_t i, std::size_t j, double radius) const {
    const double area = ring_.area(i, j);
    const double length = ring_.length(i, j) + distance(ring_.at(i), ring_.at(j));
    const double root = std::sqrt(std::max(0.0, length * length - 4 * std::numbers::pi * area));
    return 2 * area > radius * (length + root);
  }

  /// The point between two positions that is farthest from the first one.
  [[nodiscard]] Point farthest(std::size_t i, std::size_t j) const {
    const auto rank = [&](std::size_t k) {
      return std::pair(distance(ring_.at(k), ring_.at(i)), ring_.at(k));
    };
    std::size_t best = i;
    for (std::size_t k = i; k <= j; ++k)
      if (rank(k) > rank(best)) best = k;
    return ring_.at(best);
  }

  /// Whether the polygon between two positions has an odd number of sides to the right of p
  /// (exact).
  [[nodiscard]] bool is_inside(Point p, std::size_t i, std::size_t j) const {
    bool is_odd = false;
    for (std::size_t k = i; k <= j; ++k) {
      const Point a = ring_.at(k);
      const Point b = ring_.at(k == j ? i : k + 1);
      if ((a.y <= p.y) == (b.y <= p.y)) continue;
      if (cdt::orient(a, b, p) == (b.y > a.y ? 1 : -1)) is_odd = !is_odd;
    }
    return is_odd;
  }

  const Positions& ring_;
  bool is_hole_;
  double width_;
  std::vector<bool> is_spent_;  // by long runs that were no channels
};

/// The area between the two sides of a channel.
double area_between(const Positions& ring, const Run& run) {
  const double whole = ring.area(run.begin, run.home);
  const double beyond = ring.area(run.end, run.back);
  return std::max(0.0, std::abs(whole - beyond));
}

}  // namespace

KeyholeCut cut_keyholes(std::span<const Point> points, double width) {
  KeyholeCut cut;
  Ring whole;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (whole.empty() || points[whole.back()] != points[i]) whole.push_back(i);
  while (whole.size() > 1 && points[whole.front()] == points[whole.back()]) whole.pop_back();
  std::vector<Open> open;  // still to be looked at
  open.push_back({std::move(whole), false});
  while (!open.empty()) {
    auto [ring, is_hole] = std::move(open.back());
    open.pop_back();
    const Positions positions(points, ring);
    Finder finder(positions, is_hole, width);
    const auto run = finder.run();
    if (!run) {
      cut.rings.push_back(std::move(ring));
      continue;
    }
    cut.channels.push_back({positions.at(run->begin), area_between(positions, *run)});
    const Parts parts = finder.parts(*run);
    open.push_back(
        {positions.ring(run->end, run->back), (parts == Parts::first_inside) != is_hole});
    open.push_back({positions.ring(run->home, run->begin + ring.size()),
                    (parts == Parts::second_inside) != is_hole});
  }
  return cut;
}

}  // namespace loft
