// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/predicates.h"

namespace loft {

/// A surface that is asked whether it covers triangles within a distance: whether each point of a
/// triangle has one of the surface over or under it, along the triangle's normal.
///
/// The faces seen from there are found by going from neighbour to neighbour. If each has its front
/// to the triangle, and each edge that is seen within the triangle has a face on either side, then
/// they leave no gap; and what lies between a face and the triangle is thickest at a corner of
/// their common part. That takes time in proportion to these faces. A "no" may have other reasons,
/// such as a face that is seen from its side, or rounding; a "yes" holds up to rounding.
class Cover {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  /// Of a face: across the edge from corner i to the next; none on a rim.
  using Neighbours = std::array<std::uint32_t, 3>;

  /// `faces` are kept by reference.
  Cover(std::span<const Corners> faces, std::vector<Neighbours> neighbours, double distance)
      : faces_(faces),
        neighbours_(std::move(neighbours)),
        distance_(distance),
        seen_(faces.size(), 0) {}

  /// Whether the surface covers a triangle. One of the faces `among` is to be seen at its middle.
  [[nodiscard]] bool covers(const Corners& triangle, std::span<const std::uint32_t> among);

 private:
  /// A place as it is seen: x and y from the triangle's first corner, and z along its normal.
  using Seen = std::array<Vec3, 3>;

  /// Whether there is a direction to look along.
  bool look_at(const Corners& triangle);
  [[nodiscard]] Seen seen(std::uint32_t face) const;
  [[nodiscard]] std::uint32_t face_at_middle(std::span<const std::uint32_t> among) const;

  /// How far inside edge i of the triangle a place is seen.
  [[nodiscard]] double depth(std::size_t i, const Vec3& p) const {
    return inwards_[i][0] * p[0] + inwards_[i][1] * p[1] + inwards_[i][2];
  }
  /// Whether what is seen of a face within the triangle is within the distance.
  [[nodiscard]] bool is_near(const Seen& face) const;
  /// Whether some of an edge is seen within the triangle, and not on its edges.
  [[nodiscard]] bool enters(const Vec3& from, const Vec3& to) const;

  std::span<const Corners> faces_;
  std::vector<Neighbours> neighbours_;
  double distance_;

  // Of the triangle at hand.
  Vec3 start_{};
  std::array<Vec3, 3> axes_{};
  std::array<Vec3, 3> inwards_{};  // of each edge: a unit vector from it, and its share
  Vec3 middle_{};
  double rounding_ = 0;
  std::uint32_t look_ = 0;
  std::vector<std::uint32_t> seen_;  // of each face: the last triangle that it was seen from
  std::vector<std::uint32_t> front_;
};

}  // namespace loft
