// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/ids.h"
#include "cdt/triangulation.h"

namespace loft::overlay {

using cdt::closed;
using cdt::EdgeId;
using cdt::Ends;
using cdt::open;
using cdt::Point;

struct LayerTag {
  static constexpr char prefix = 'l';
};
struct CoverTag {
  static constexpr char prefix = 'k';
};
struct ResultTag {
  static constexpr char prefix = 'r';
};

/// Shapes that belong together: a country, the parks of a town, one operand.
using LayerId = cdt::Id<LayerTag>;
/// A ring or a line of a layer; the constraint that it is in the triangulation.
using RingId = cdt::ConstraintId;
/// A set of layers: those that cover a place.
using CoverId = cdt::Id<CoverTag>;
/// An expression whose result is kept up to date.
using ResultId = cdt::Id<ResultTag>;

/// Which places rings enclose, by how often they wind around them, counter-clockwise positive.
enum class FillRule {
  even_odd,  ///< odd: directions do not matter
  nonzero,   ///< not 0
  positive,  ///< above 0
  negative,  ///< below 0
};

[[nodiscard]] constexpr bool is_inside(FillRule rule, int winding) {
  switch (rule) {
    case FillRule::even_odd:
      return winding % 2 != 0;
    case FillRule::nonzero:
      return winding != 0;
    case FillRule::positive:
      return winding > 0;
    case FillRule::negative:
      return winding < 0;
  }
  return false;
}

/// A map of the plane: (x, y) goes to (xx x + xy y + x0, yx x + yy y + y0), each rounded as
/// written.
struct Affine {
  double xx = 1, xy = 0, x0 = 0;
  double yx = 0, yy = 1, y0 = 0;

  [[nodiscard]] constexpr Point operator()(Point p) const {
    return {xx * p.x + xy * p.y + x0, yx * p.x + yy * p.y + y0};
  }
  /// First `inner`, then `outer`.
  friend constexpr Affine operator*(const Affine& outer, const Affine& inner) {
    return {.xx = outer.xx * inner.xx + outer.xy * inner.yx,
            .xy = outer.xx * inner.xy + outer.xy * inner.yy,
            .x0 = outer.xx * inner.x0 + outer.xy * inner.y0 + outer.x0,
            .yx = outer.yx * inner.xx + outer.yy * inner.yx,
            .yy = outer.yx * inner.xy + outer.yy * inner.yy,
            .y0 = outer.yx * inner.x0 + outer.yy * inner.y0 + outer.y0};
  }
  friend bool operator==(const Affine&, const Affine&) = default;
};

}  // namespace loft::overlay
