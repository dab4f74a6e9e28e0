// SPDX-License-Identifier: MIT
#include "paths/directions.h"

#include <array>

namespace loft::paths {

double angle_between(Direction from, Direction to) {
  const double sine = cross(from, to);
  const double cosine = dot(from, to);
  // The tangent of half the angle, or, where that is large, of what is missing to half a turn.
  const bool is_obtuse = cosine < 0;
  const double norm = std::sqrt(sine * sine + cosine * cosine);
  if (norm == 0) return 0;
  double t = is_obtuse ? std::abs(sine) / (norm - cosine) : sine / (norm + cosine);
  // Halved thrice, it is below 0.1: the series ends soon.
  constexpr int halvings = 3;
  for (int i = 0; i < halvings; ++i) t = t / (1 + std::sqrt(1 + t * t));
  constexpr int last = 17;
  const double square = t * t;
  double sum = 0;
  for (int k = last; k >= 1; k -= 2) sum = ((k % 4 == 1) ? 1.0 : -1.0) / k + square * sum;
  const double angle = 2 * (1 << halvings) * t * sum;
  constexpr double half_turn = 3.14159265358979323846;
  if (!is_obtuse) return angle;
  return sine < 0 ? angle - half_turn : half_turn - angle;
}

}  // namespace loft::paths
