// SPDX-License-Identifier: MIT
#include "tests/cdt/random_edits.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace loft::cdt {

namespace {

class Author {
 public:
  Author(std::uint64_t seed, Ground ground, std::size_t population)
      : random_(seed), ground_(ground), population_(population) {}

  [[nodiscard]] Edit next() {
    Edit edit = constraints_.empty() || below(2 * population_) >= constraints_.size() + below(2)
                    ? insertion_or_change()
                    : Edit{Edit::Kind::remove, chosen(), {}, {}};
    carry_out(edit, constraints_);
    return edit;
  }

 private:
  [[nodiscard]] std::size_t below(std::size_t n) { return random_() % n; }
  [[nodiscard]] double number_below(std::size_t n) { return static_cast<double>(below(n)); }

  [[nodiscard]] std::size_t chosen() {
    return std::next(constraints_.begin(), static_cast<std::ptrdiff_t>(below(constraints_.size())))
        ->first;
  }

  [[nodiscard]] Edit insertion_or_change() {
    if (constraints_.empty() || below(2) == 0)
      return {Edit::Kind::insert, next_name_++, outline(), {}};
    const std::size_t name = chosen();
    if (below(2) == 0) return {Edit::Kind::translate, name, {}, stride()};
    return {Edit::Kind::move, name, {changed(constraints_.at(name)), open}, {}};
  }

  /// Some or all points elsewhere, or others altogether.
  [[nodiscard]] std::vector<Point> changed(const Outline& before) {
    if (below(3) == 0) return outline().points;
    std::vector<Point> points = before.points;
    for (Point& p : points)
      if (below(2) == 0) p = point();
    return points;
  }

  [[nodiscard]] Point point() {
    switch (ground_) {
      case Ground::grid_8:
        return {number_below(8), number_below(8)};
      case Ground::grid_4:
        return {number_below(4), number_below(4)};
      case Ground::decimals:
        return {number_below(1000) / 1000, number_below(1000) / 1000};
      case Ground::near_parallel:
        return {number_below(2), number_below(1000) * 1e-9};
      case Ground::far_from_origin:
        return {5e6 + number_below(100) / 7, 4e7 + number_below(100) / 7};
      case Ground::beside_lines:
        return constraints_.empty() || below(2) == 0 ? Point{decimal(), decimal()} : beside();
      case Ground::near_zero:
        return near_zero();
      case Ground::flush:
        return below(4) == 0 ? Point{decimal(), decimal()} : along_corridor();
      case Ground::nearly_equal:
        break;
    }
    const auto coordinate = [&] { return number_below(3) + number_below(1000) * 1e-16; };
    const double x = coordinate();
    return {x, coordinate()};
  }

  /// Between -9.999 and 9.999, with one to three decimals.
  [[nodiscard]] double decimal() {
    const double tens[] = {10, 100, 1000};
    const double unit = tens[below(3)];
    return (number_below(static_cast<std::size_t>(20 * unit)) - 10 * unit) / unit;
  }

  /// On a side of an outline, but for a few last places.
  [[nodiscard]] Point beside() {
    const auto& points = constraints_.at(chosen()).points;
    const std::size_t i = below(points.size());
    const Point a = points[i];
    const Point b = points[(i + 1) % points.size()];
    const double shares[] = {0.5, 0.25, 0.1, 0.3, 0.001, number_below(1000) / 1000, 1.0 / 3};
    const double share = shares[below(std::size(shares))];
    return {nudged(a.x + share * (b.x - a.x)), nudged(a.y + share * (b.y - a.y))};
  }

  [[nodiscard]] double nudged(double x) {
    if (x == 0) return x;  // steps there underflow
    const double to = below(2) == 0 ? -1e300 : 1e300;
    for (std::size_t steps = below(9); steps > 0; --steps) x = std::nextafter(x, to);
    return x;
  }

  /// On one of a few lines across 0, far away or very near, or beside them.
  [[nodiscard]] Point near_zero() {
    const Point ways[] = {{0.6, 1.8}, {-1.7, 0.6}, {1, 0}, {0, 0.7}};
    const Point way = ways[below(std::size(ways))];
    const double sizes[] = {1e-15, 1, 100.0 / 3};
    const double far = sizes[below(std::size(sizes))] * (number_below(9) - 4);
    return {nudged(far * way.x + 1e-15 * number_below(3)), nudged(far * way.y)};
  }

  /// One of a few places on one of a few parallel lines, by arithmetic that rounds.
  [[nodiscard]] Point along_corridor() {
    const Point ways[] = {{0.6, 1.8}, {-1.7, 0.6}, {0.3, 0.1}};
    const Point along = ways[below(2)];
    const Point across = ways[2];
    const double far = number_below(40) / 8;
    const double beside = number_below(3);
    return {-1.2 + far * along.x + beside * across.x, 2.4 + far * along.y + beside * across.y};
  }

  /// How far a translation goes.
  [[nodiscard]] Point stride() {
    const Point from = point();
    const Point to = point();
    const Point all{to.x - from.x, to.y - from.y};
    if (is_grid(ground_)) return {std::round(all.x / 2) + 0.0, std::round(all.y / 2) + 0.0};
    return below(2) == 0 ? Point{all.x / 2, all.y / 2} : Point{all.x / 1024, all.y / 1024};
  }

  [[nodiscard]] Outline outline() {
    switch (below(9)) {
      case 0:
        return {{point()}, open};
      case 1:
        return spike();
      case 2:
        return out_and_back();
      case 3:
        return star();
      case 4:
        return rectangle();
      case 5:
        if (!constraints_.empty()) return copy();
        break;
      case 6:
        return {{point(), point()}, open};
      default:
        break;
    }
    return polyline();
  }

  [[nodiscard]] Outline polyline() {
    Outline outline{{}, below(2) == 0 ? open : closed};
    for (std::size_t n = 2 + below(6); n > 0; --n) outline.points.push_back(point());
    return outline;
  }

  /// Out and back over the same edge, then on.
  [[nodiscard]] Outline spike() {
    const Point base = point();
    return {{base, point(), base, point()}, below(2) == 0 ? open : closed};
  }

  [[nodiscard]] Outline out_and_back() {
    Outline outline = polyline();
    outline.points.insert(outline.points.end(), outline.points.rbegin(), outline.points.rend());
    return outline;
  }

  /// Five or seven points, joined across.
  [[nodiscard]] Outline star() {
    const Point centre = point();
    const Point rim = point();
    const double radius = std::hypot(rim.x - centre.x, rim.y - centre.y);
    const std::size_t corners = 5 + 2 * below(2);
    Outline outline{{}, closed};
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i * (corners / 2)) /
                           static_cast<double>(corners);
      Point p{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
      if (is_grid(ground_)) p = {std::round(p.x) + 0.0, std::round(p.y) + 0.0};
      outline.points.push_back(p);
    }
    return outline;
  }

  [[nodiscard]] Outline rectangle() {
    const Point a = point();
    const Point b = point();
    return {{a, {b.x, a.y}, b, {a.x, b.y}}, closed};
  }

  /// The same again, or backwards.
  [[nodiscard]] Outline copy() {
    Outline outline = constraints_.at(chosen());
    if (below(2) == 0) std::ranges::reverse(outline.points);
    return outline;
  }

  std::mt19937_64 random_;
  Ground ground_;
  std::size_t population_;
  std::size_t next_name_ = 0;
  Constraints constraints_;
};

}  // namespace

const char* name_of(Ground ground) {
  constexpr const char* names[] = {"8x8 grid",      "4x4 grid",        "decimals",
                                   "near-parallel", "far from origin", "nearly equal",
                                   "beside lines",  "near zero",       "flush"};
  return names[static_cast<std::size_t>(ground)];
}

Script random_script(std::uint64_t seed, Ground ground, std::size_t edits, std::size_t population) {
  Author author(seed, ground, population);
  Script script;
  script.reserve(edits);
  while (script.size() < edits) script.push_back(author.next());
  return script;
}

}  // namespace loft::cdt
