// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "cdt/point.h"
#include "io/stacks/read_options.h"
#include "io/volumes/volume.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// Where the pixels of a volume come to lie in its slices.
class Placement {
 public:
  /// Throws InputError as trace().
  Placement(const Volume& volume, const ReadOptions& options);

  /// Height of a slice at that place along the slices.
  [[nodiscard]] double z(double slice) const;
  /// A place in pixels, in a slice.
  [[nodiscard]] cdt::Point at(const cdt::Point& pixel, double slice) const;
  /// Distance of neighbouring slices, if evenly spaced.
  [[nodiscard]] double gap() const;
  [[nodiscard]] const std::optional<WorldFrame>& frame() const { return frame_; }

 private:
  using Matrix = std::array<std::array<double, 4>, 3>;

  void tilt(const Matrix& to_world);

  Matrix to_slices_;  ///< from (column, row, slice, 1) to x, y, z
  std::optional<WorldFrame> frame_;
};

}  // namespace loft::io
