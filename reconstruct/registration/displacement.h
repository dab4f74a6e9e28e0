// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cdt/triangulation.h"
#include "reconstruct/registration/affine.h"

namespace loft {

/// A region whose points have gone their ways.
[[nodiscard]] Region moved(const Region& region, std::span<const cdt::Point> ways);

/// A displacement of the points of a region, smooth over the plane, that leaves it a region: moved,
/// its loops neither cross nor touch in new places, and the region is on their left (exact).
class Displacement {
 public:
  /// The affine map with the least squares of the pulls; what is left by the least squares of pulls
  /// and of the Dirichlet energy over the region's CDT (cotangent weights: Pinkall and Polthier,
  /// 1993), so that what happens over a distance below `softness` is smoothed. That energy is the
  /// same whichever way places on one circle are triangulated. Where loops would cross, the ways
  /// are smoothed further, then shortened; none if that does not help. Cost: that of the CDT, some
  /// times, and of a sparse symmetric system with a row a point.
  [[nodiscard]] static std::optional<Displacement> fit(const Region& region,
                                                       std::span<const Pull> pulls,
                                                       double softness);

  [[nodiscard]] std::span<const cdt::Point> ways() const { return ways_; }

 private:
  std::vector<cdt::Point> ways_;  // of each point
};

/// A function of the plane that has given values at given places and is linear over the triangles
/// of their CDT; beyond them, that of the nearest place of their convex hull.
class Interpolation {
 public:
  /// Places and loops of the region, each place once.
  Interpolation(const Region& region, std::span<const cdt::Point> values);

  /// Cost: to locate a point.
  [[nodiscard]] cdt::Point at(cdt::Point place) const;

 private:
  [[nodiscard]] double share(cdt::EdgeId e, cdt::Point place) const;
  [[nodiscard]] cdt::Point along(cdt::EdgeId e, double share) const;
  [[nodiscard]] cdt::Point inside(cdt::EdgeId e, cdt::Point place) const;
  [[nodiscard]] cdt::Point beyond(cdt::EdgeId e, cdt::Point place) const;

  cdt::Triangulation mesh_;
  std::vector<cdt::Point> values_;  // of each vertex
};

}  // namespace loft
