// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fields/field.h"

namespace loft::fields {

/// A place on a line over a field.
struct ProfilePoint {
  Point place;
  double distance = 0;           ///< along the line
  std::optional<double> before;  ///< as one comes there; none beyond the hull
  std::optional<double> after;   ///< as one goes on; another one where a wall is crossed

  friend bool operator==(const ProfilePoint&, const ProfilePoint&) = default;
};

/// What is below a line: its points, and each place where it crosses an edge or comes to a vertex
/// of the triangulation (KBT, section 7), so that a linear surface is straight between them. Where
/// it runs along a wall, it is on that one's left. Law: the same as the values along the line once
/// it is inserted as a soft one, within rounding. Cost: that of locating each point of the line,
/// then the edges crossed. Precondition: the points are finite.
[[nodiscard]] std::vector<ProfilePoint> profile(const Field& field, std::span<const Point> line,
                                                Smoothness smoothness = Smoothness::linear);

/// How far a profile goes up and down in all; jumps at walls count.
struct Climb {
  double up = 0;
  double down = 0;
};
[[nodiscard]] Climb climb(std::span<const ProfilePoint> profile);

}  // namespace loft::fields
