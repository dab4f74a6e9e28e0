// SPDX-License-Identifier: MIT
#include "io/planar/path_points.h"

#include <cmath>

namespace loft::io {

namespace {

using cdt::Point;

constexpr double sagitta_bound = 1e-3;  // in radii

double length_of(Point v) { return std::sqrt(v.x * v.x + v.y * v.y); }

/// Appends the ends of the chords of an arc, the first one left out.
class ArcChords {
 public:
  ArcChords(std::vector<Point>& points, const paths::Piece& arc)
      : points_(points),
        centre_(arc.centre),
        radius_(length_of({arc.from.x - centre_.x, arc.from.y - centre_.y})) {}

  /// An arc of less than half a turn is halved by what lies between its ends.
  void append(Point from, Point to, int halvings = 0) {
    constexpr int enough = 8;  // chords of 1/512 of a turn: half of the bound's are wider
    const Point between{(from.x - centre_.x) / 2 + (to.x - centre_.x) / 2,
                        (from.y - centre_.y) / 2 + (to.y - centre_.y) / 2};
    const double distance = length_of(between);
    if (halvings == enough || distance == 0 || radius_ - distance <= sagitta_bound * radius_) {
      points_.push_back(to);
      return;
    }
    const Point middle{centre_.x + between.x / distance * radius_,
                       centre_.y + between.y / distance * radius_};
    append(from, middle, halvings + 1);
    append(middle, to, halvings + 1);
  }

 private:
  std::vector<Point>& points_;
  Point centre_;
  double radius_;
};

}  // namespace

std::vector<Point> points_along(const paths::Path& path, Point from) {
  std::vector<Point> points;
  if (path.status != paths::Status::found) return points;
  points.push_back(from);
  for (const paths::Piece& piece : path.pieces) {
    if (piece.turn == paths::Turn::straight)
      points.push_back(piece.to);
    else
      ArcChords(points, piece).append(piece.from, piece.to);
  }
  return points;
}

}  // namespace loft::io
