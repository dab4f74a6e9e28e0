// SPDX-License-Identifier: MIT
#include "app/live/walk.h"

#include <cmath>

#include "paths/distance.h"

namespace loft::app {

namespace {

using cdt::Point;
using paths::distance_between;
using paths::Piece;
using paths::Turn;

/// By how much an arc turns.
double turn_of(const Piece& arc) {
  const Point a{arc.from.x - arc.centre.x, arc.from.y - arc.centre.y};
  const Point b{arc.to.x - arc.centre.x, arc.to.y - arc.centre.y};
  return std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
}

double length_of(const Piece& piece) {
  if (piece.turn == Turn::straight) return distance_between(piece.from, piece.to);
  return std::abs(turn_of(piece)) * distance_between(piece.centre, piece.from);
}

/// The point that has that part of a piece behind it.
Point point_on(const Piece& piece, double part) {
  const Point a = piece.from;
  if (piece.turn == Turn::straight)
    return {a.x + part * (piece.to.x - a.x), a.y + part * (piece.to.y - a.y)};
  const Point m = piece.centre;
  const double c = std::cos(part * turn_of(piece));
  const double s = std::sin(part * turn_of(piece));
  return {m.x + c * (a.x - m.x) - s * (a.y - m.y), m.y + s * (a.x - m.x) + c * (a.y - m.y)};
}

}  // namespace

Point point_along(const paths::Path& path, Point from, double distance) {
  if (!(distance > 0)) return from;
  for (const Piece& piece : path.pieces) {
    const double length = length_of(piece);
    if (distance < length) return point_on(piece, distance / length);
    distance -= length;
    from = piece.to;
  }
  return from;
}

}  // namespace loft::app
