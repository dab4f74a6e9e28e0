// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "mesh/mesh.h"

namespace loft::io {

/// An affine map of space: the upper three rows of a 4 x 4 matrix. By default the identity.
struct Affine {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Vec3 operator()(const Vec3& p) const {
    Vec3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = rows[i][0] * p[0] + rows[i][1] * p[1] + rows[i][2] * p[2] + rows[i][3];
    }
    return result;
  }
};

/// The map that applies b, then a.
inline Affine operator*(const Affine& a, const Affine& b) {
  Affine result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? a.rows[row][3] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += a.rows[row][k] * b.rows[k][column];
      result.rows[row][column] = sum;
    }
  }
  return result;
}

/// The factor by which the map changes volumes; negative if it mirrors.
inline double determinant(const Affine& map) {
  const auto& m = map.rows;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// The rotation of a unit quaternion.
inline Affine rotation(double x, double y, double z, double w) {
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}}};
}

}  // namespace loft::io
