// SPDX-License-Identifier: MIT
#include "paths/corridor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "overlay/boolean.h"
#include "paths/distance.h"

namespace loft::paths {

namespace {

constexpr int most_halvings = 20;

[[nodiscard]] Point along_ray(Point from, Point direction, double length) {
  return {from.x + length * direction.x, from.y + length * direction.y};
}

/// The direction between two that are less than half a turn apart.
[[nodiscard]] Point halfway(Point a, Point b) {
  const Point sum{a.x + b.x, a.y + b.y};
  const double length = distance_between({}, sum);
  return {sum.x / length, sum.y / length};
}

/// Directions all around, counter-clockwise, so many that chords between them are no further than
/// `most_error` from the circle.
[[nodiscard]] std::vector<Point> directions_around(double radius, double most_error) {
  std::vector<Point> all{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  double depth = 1 - std::sqrt(0.5);  // of the circle of radius 1 beyond a chord
  for (int i = 0; i < most_halvings && radius * depth > most_error; ++i) {
    std::vector<Point> more;
    for (std::size_t k = 0; k < all.size(); ++k) {
      more.push_back(all[k]);
      more.push_back(halfway(all[k], all[(k + 1) % all.size()]));
    }
    all = std::move(more);
    depth = depth / 2 / (1 + std::sqrt(1 - depth / 2));
  }
  return all;
}

/// The points where chords along a piece end, but for its start.
void flatten(const Piece& piece, double most_error, int halvings, std::vector<Point>& ends) {
  if (piece.turn == Turn::straight || halvings == 0) return ends.push_back(piece.to);
  const double radius = distance_between(piece.centre, piece.from);
  const Point from{piece.from.x - piece.centre.x, piece.from.y - piece.centre.y};
  const Point to{piece.to.x - piece.centre.x, piece.to.y - piece.centre.y};
  const Point chord{(from.x + to.x) / 2, (from.y + to.y) / 2};
  if (radius - distance_between({}, chord) <= most_error) return ends.push_back(piece.to);
  const Point middle = along_ray(piece.centre, halfway(from, to), radius);
  flatten({piece.from, middle, piece.turn, piece.centre}, most_error, halvings - 1, ends);
  flatten({middle, piece.to, piece.turn, piece.centre}, most_error, halvings - 1, ends);
}

/// What is no further than a radius from a segment.
[[nodiscard]] overlay::Ring stadium(Point a, Point b, double radius,
                                    const std::vector<Point>& directions) {
  const double length = distance_between(a, b);
  const Point ahead{(b.x - a.x) / length, (b.y - a.y) / length};
  const auto is_ahead = [&](Point d) { return d.x * ahead.x + d.y * ahead.y > 0; };
  const std::size_t count = directions.size();
  std::size_t first = 0;
  while (is_ahead(directions[first])) ++first;
  while (!is_ahead(directions[first % count])) ++first;

  overlay::Ring ring{along_ray(a, {ahead.y, -ahead.x}, radius),
                     along_ray(b, {ahead.y, -ahead.x}, radius)};
  bool is_at_end = true;
  for (std::size_t k = first; k < first + count; ++k) {
    const Point direction = directions[k % count];
    if (is_at_end && !is_ahead(direction)) {
      ring.push_back(along_ray(b, {-ahead.y, ahead.x}, radius));
      ring.push_back(along_ray(a, {-ahead.y, ahead.x}, radius));
      is_at_end = false;
    }
    ring.push_back(along_ray(is_at_end ? b : a, direction, radius));
  }
  return ring;
}

}  // namespace

overlay::MultiPolygon corridor(const Path& path, double half_width, double most_error) {
  const auto is_size = [](double x) { return x > 0 && std::isfinite(x); };
  if (!is_size(half_width) || !is_size(most_error))
    throw std::invalid_argument("paths: a corridor's width and error are finite and above 0");
  const std::vector<Point> directions = directions_around(half_width, most_error / 2);
  std::vector<overlay::Ring> rings;
  for (const Piece& piece : path.pieces) {
    std::vector<Point> ends;
    flatten(piece, most_error / 2, most_halvings, ends);
    Point from = piece.from;
    for (const Point to : ends) {
      if (from != to) rings.push_back(stadium(from, to, half_width, directions));
      from = to;
    }
  }
  return overlay::fill(rings, overlay::FillRule::nonzero);
}

}  // namespace loft::paths
