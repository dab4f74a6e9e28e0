// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/box3.h"
#include "mesh/predicates.h"

namespace loft {

/// The square of the distance from a point to the nearest point of the segment from a to b.
[[nodiscard]] double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b);
/// The square of the distance from a point to the nearest point of a triangle.
[[nodiscard]] double squared_distance(const Vec3& p, const Corners& triangle);

/// Whether every point of a triangle is within a distance of some of other triangles.
///
/// What is near one triangle is convex, so a piece is near it when its corners are. A piece with
/// corners near different triangles is cut where an edge goes from one to the other, until each
/// piece has one that is near all of it. So "yes" is proven, up to rounding; "no" also comes when
/// the number of pieces runs out, which is in proportion to the number of triangles.
class Nearness {
 public:
  explicit Nearness(double distance) : distance_(distance) {}

  /// Laws: the answer, and what used() tells, depend on the places and the order of the triangles.
  [[nodiscard]] bool all_near(const Corners& whole, std::span<const Corners> others);

  /// After a "yes": triangles that are together near all of the whole, in order.
  [[nodiscard]] std::span<const std::uint32_t> used() const { return used_; }

 private:
  /// A triangle that may be near a piece, and which of the piece's corners it is near: a bit each.
  struct Candidate {
    std::uint32_t triangle;
    unsigned near;
  };
  struct Piece {
    Corners corners;
    std::size_t first;  // of its candidates
    std::size_t last;
  };

  [[nodiscard]] std::span<const Candidate> candidates(const Piece& piece) const {
    return std::span(candidates_).subspan(piece.first, piece.last - piece.first);
  }
  [[nodiscard]] bool is_near(const Vec3& p, const Corners& triangle, const Box3& around) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (around.low[axis] - p[axis] > distance_ || p[axis] - around.high[axis] > distance_)
        return false;
    return squared_distance(p, triangle) <= distance_ * distance_;
  }

  /// The whole, with all candidates within reach.
  void start(const Corners& whole, std::span<const Corners> others);

  /// Two pieces in the place of one: cut from a corner to the opposite edge.
  void cut(const Piece& piece, std::span<const Corners> others);

  /// Adds a piece; `near` tells which of its corners a candidate of the old piece is near.
  template <class Near>
  void push(const Piece& old, const Corners& corners, Near near);

  /// The corner whose opposite edge is cut: the longest edge without one triangle near both ends.
  [[nodiscard]] std::size_t corner_of_cut(const Piece& piece) const;

  /// Where the edge from corner a to the next is cut, as a share of it: between the farthest that
  /// what is near its start reaches, and the farthest that what is near its end reaches back.
  [[nodiscard]] double share_of_cut(const Piece& piece, std::size_t a,
                                    std::span<const Corners> others) const;

  double distance_;
  std::vector<Piece> pieces_;
  std::vector<Candidate> candidates_;
  std::vector<Box3> boxes_;     // around the other triangles
  std::vector<bool> near_cut_;  // of each candidate of the piece that is cut
  std::vector<std::uint32_t> used_;
};

}  // namespace loft
