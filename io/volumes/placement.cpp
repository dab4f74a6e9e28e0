// SPDX-License-Identifier: MIT
#include "io/volumes/placement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "mesh/admitted.h"
#include "mesh/vec3.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

using Matrix = std::array<std::array<double, 4>, 3>;

Vec3 column(const Matrix& matrix, std::size_t axis) {
  return {matrix[0][axis], matrix[1][axis], matrix[2][axis]};
}

double length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }

Vec3 times(const Vec3& a, double factor) { return {a[0] * factor, a[1] * factor, a[2] * factor}; }

/// 0 for what rounding has left.
double without_traces(double number) {
  return std::abs(number) < admitted::slice.smallest ? 0 : number;
}

bool is_distance(double number) { return std::isfinite(number) && number > 0; }

/// With the spacing that the user says; directions stay.
Matrix with_spacing(Matrix matrix, const Vec3& spacing) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double old = length(column(matrix, axis));
    for (std::size_t row = 0; row < 3; ++row) {
      const double along = old > 0 ? matrix[row][axis] / old : (row == axis ? 1.0 : 0.0);
      matrix[row][axis] = along == 0 ? 0 : along * spacing[axis];
    }
  }
  return matrix;
}

/// The one world axis that an axis of the pixels runs along, but for rounding; 3 if there is none.
std::size_t world_axis(const Matrix& matrix, std::size_t axis) {
  constexpr double rounding = 1e-6;
  const Vec3 direction = column(matrix, axis);
  for (std::size_t row = 0; row < 3; ++row) {
    const double off = std::hypot(direction[(row + 1) % 3], direction[(row + 2) % 3]);
    if (off <= rounding * std::abs(direction[row])) return row;
  }
  return 3;
}

/// Whether slices are level and their pixels' axes those of the world, in either order.
bool is_aligned(const Matrix& matrix) {
  const std::size_t columns = world_axis(matrix, 0);
  const std::size_t rows = world_axis(matrix, 1);
  return world_axis(matrix, 2) == 2 && columns < 2 && rows == 1 - columns;
}

/// Without what rounding left of other axes.
Matrix aligned(Matrix matrix) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t row = 0; row < 3; ++row)
      if (row != world_axis(matrix, axis)) matrix[row][axis] = 0;
  return matrix;
}

void require_usable(const Matrix& matrix, const Volume& volume) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(volume.name + ": the matrix from its pixels to the world " + what +
                     "; mend the file's header, or save it again with the program it is from");
  };
  for (const auto& row : matrix)
    for (const double number : row)
      if (!admitted::slice.admits(number)) refuse("has a number that is none, or far too large");
  const std::array axes{column(matrix, 0), column(matrix, 1), column(matrix, 2)};
  constexpr std::array names{"columns", "rows", "slices"};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!is_distance(length(axes[axis])))
      throw InputError(volume.name + ": the distance between its " + names[axis] +
                       " is 0; say it with --spacing x,y,z");
  constexpr double flattest = 1e-6;
  const double volume_of_unit =
      dot(cross(times(axes[0], 1 / length(axes[0])), times(axes[1], 1 / length(axes[1]))),
          times(axes[2], 1 / length(axes[2])));
  if (!(std::abs(volume_of_unit) > flattest)) refuse("is singular");
}

Matrix world_matrix(const Volume& volume, const ReadOptions& options) {
  if (options.spacing && !std::ranges::all_of(*options.spacing, is_distance))
    throw InputError(volume.name +
                     ": the spacing must be three positive numbers, as --spacing x,y,z");
  if (!volume.has_spacing && !options.spacing)
    throw InputError(volume.name +
                     ": it does not say the distances between columns, rows and slices; give them "
                     "with --spacing x,y,z");
  Matrix matrix =
      options.spacing ? with_spacing(volume.to_world, *options.spacing) : volume.to_world;
  for (auto& row : matrix)
    for (double& number : row) number = without_traces(number);
  require_usable(matrix, volume);
  return matrix;
}

}  // namespace

Placement::Placement(const Volume& volume, const ReadOptions& options) {
  const Matrix matrix = world_matrix(volume, options);
  if (is_aligned(matrix)) {
    to_slices_ = aligned(matrix);
  } else {
    tilt(matrix);
  }
}

/// x runs along the rows, y across them, z along their normal, from where the first pixel is.
void Placement::tilt(const Matrix& to_world) {
  const Vec3 along_row = column(to_world, 0);
  const Vec3 x = times(along_row, 1 / length(along_row));
  const Vec3 normal = cross(x, column(to_world, 1));
  const Vec3 z = times(normal, 1 / length(normal));
  const std::array axes{x, cross(z, x), z};
  frame_.emplace();
  to_slices_ = {};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame_->rows[row][axis] = without_traces(axes[axis][row]);
      // Columns run along x, rows in the plane, by construction.
      to_slices_[row][axis] =
          row > axis ? 0 : without_traces(dot(axes[row], column(to_world, axis)));
    }
    frame_->rows[row][3] = to_world[row][3];
  }
}

double Placement::z(double slice) const { return to_slices_[2][3] + to_slices_[2][2] * slice; }

cdt::Point Placement::at(const cdt::Point& pixel, double slice) const {
  const auto place = [&](const std::array<double, 4>& row) {
    return row[3] + row[0] * pixel.x + row[1] * pixel.y + row[2] * slice;
  };
  return {place(to_slices_[0]), place(to_slices_[1])};
}

double Placement::gap() const { return std::abs(to_slices_[2][2]); }

}  // namespace loft::io
