// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "reconstruct/registration/outline.h"

namespace loft {

/// Where a stretch of a loop should go.
struct Pull {
  Stretch stretch;
  cdt::Point way;     ///< of its middle
  double weight = 1;  ///< how sure that is, times its length
};

/// An affine map, as the way that it moves a place.
struct Affine {
  cdt::Point centre;
  cdt::Point shift;
  cdt::Point along_x;  // change of the way with x
  cdt::Point along_y;

  [[nodiscard]] cdt::Point way(cdt::Point p) const {
    const double x = p.x - centre.x;
    const double y = p.y - centre.y;
    return {shift.x + x * along_x.x + y * along_y.x, shift.y + x * along_x.y + y * along_y.y};
  }
  /// A stretch where the map puts it, turned as it is there.
  [[nodiscard]] Stretch moved(Stretch stretch) const;
};

/// The least squares of the pulls; a shift alone where they are on one line.
[[nodiscard]] Affine fit_affine(std::span<const Pull> pulls);

/// How far pulls turn what they pull, if they are gone `times` times: by least squares, of what is
/// as rigid as it can be (Kabsch, 1976).
[[nodiscard]] double turn(std::span<const Pull> pulls, double times);

}  // namespace loft
