// SPDX-License-Identifier: MIT
#include "paths/walk.h"

#include <cmath>

#include "paths/distance.h"

namespace loft::paths {

namespace {

/// By how much an arc turns, counter-clockwise.
double turning_angle(const Piece& arc) {
  const Point a{arc.from.x - arc.centre.x, arc.from.y - arc.centre.y};
  const Point b{arc.to.x - arc.centre.x, arc.to.y - arc.centre.y};
  return std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
}

}  // namespace

double length(const Piece& piece) {
  if (piece.turn == Turn::straight) return distance_between(piece.from, piece.to);
  return std::abs(turning_angle(piece)) * distance_between(piece.centre, piece.from);
}

Point point_on(const Piece& piece, double part) {
  const Point a = piece.from;
  if (piece.turn == Turn::straight)
    return {a.x + part * (piece.to.x - a.x), a.y + part * (piece.to.y - a.y)};
  const Point m = piece.centre;
  const double angle = part * turning_angle(piece);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {m.x + c * (a.x - m.x) - s * (a.y - m.y), m.y + s * (a.x - m.x) + c * (a.y - m.y)};
}

Point point_along(const Path& path, Point from, double distance) {
  if (!(distance > 0)) return from;
  for (const Piece& piece : path.pieces) {
    const double here = length(piece);
    if (distance < here) return point_on(piece, distance / here);
    distance -= here;
    from = piece.to;
  }
  return from;
}

}  // namespace loft::paths
