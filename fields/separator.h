// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"

namespace loft::fields {

using cdt::Point;

/// On which side of a separator a place is, seen along it.
enum class Sign : std::int8_t { right = -1, on = 0, left = 1 };

/// How a place lies to a separator, in numbers that are sums over its pieces.
struct Standing {
  std::int32_t winding = 0;  ///< of the closed line around the place; where it is on the line,
                             ///< around one hardly to the right of it and still less above
  std::int32_t touches = 0;  ///< how many pieces lead through the place, ends included

  [[nodiscard]] Sign sign() const {
    if (touches > 0) return Sign::on;
    return winding > 0 ? Sign::left : Sign::right;
  }
  Standing& operator+=(Standing other) {
    winding += other.winding;
    touches += other.touches;
    return *this;
  }
  Standing& operator-=(Standing other) {
    winding -= other.winding;
    touches -= other.touches;
    return *this;
  }
  friend bool operator==(Standing, Standing) = default;
};

/// A straight piece of a separator: a part of the line through two points, run from a towards b.
struct SeparatorPiece {
  enum class Part {
    before,   ///< from infinity to a
    between,  ///< from a to b
    beyond,   ///< from b to infinity
  };
  Part part = Part::between;
  Point a;
  Point b;

  /// What it adds to the standing of a place. Exact.
  [[nodiscard]] Standing standing(Point p) const;

  friend bool operator==(const SeparatorPiece&, const SeparatorPiece&) = default;
};

/// A polyline that divides the plane: its first and its last segment go on straight to infinity.
///
/// What is on it is `on`. Elsewhere the winding number says: the line is thought of as closed far
/// out, by the arc that leads counter-clockwise from its last end to its first; what this closed
/// line winds around counter-clockwise (once or more, all in all) is `left`, the rest is `right`.
/// So every place of the plane has a side, and for a line that does not cross itself it is the one
/// that everybody would say. A line that does cross itself may make loops: they change nothing,
/// a loop on the left is left and one on the right is right. Nowhere does one come from the left
/// to the right by crossing the line to its left.
///
/// Laws: the line run the other way has left and right exchanged. Where both ends lie on one
/// another, far out, and run the same way, nothing is between them; what is all around is `right`
/// then, whichever way it is run.
///
/// All sides are exact (cdt::orient); nothing is rounded.
class Separator {
 public:
  /// Throws std::invalid_argument if there are fewer than two points, if a point repeats the one
  /// before it, or if a coordinate is not usable (cdt::Triangulation::is_usable); the message says
  /// which. Cost: O(points).
  explicit Separator(std::vector<Point> points);

  [[nodiscard]] std::span<const Point> points() const { return points_; }
  /// In order: from infinity, between the points, to infinity; one more than there are points.
  [[nodiscard]] std::span<const SeparatorPiece> pieces() const { return pieces_; }

  /// Cost: O(points).
  [[nodiscard]] Sign sign(Point p) const { return standing(p).sign(); }
  [[nodiscard]] Standing standing(Point p) const;
  /// What closing the line far out adds to the winding around a place, above its pieces: 0 or 1.
  [[nodiscard]] std::int32_t closing(Point p) const;

 private:
  [[nodiscard]] bool is_last_end_further() const;

  std::vector<Point> points_;
  std::vector<SeparatorPiece> pieces_;
  bool is_last_end_further_ = false;  // counter-clockwise, where both are on one side of p's ray
};

/// What of a separator is another one's, too, at its beginning and its end: pieces first to last
/// (excluded) of it are its own.
struct OwnPieces {
  std::size_t first = 0;
  std::size_t last = 0;
};
[[nodiscard]] OwnPieces own_pieces(const Separator& one, const Separator& other);

}  // namespace loft::fields
