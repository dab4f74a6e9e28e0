// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include "reconstruct/plane/nearest.h"
#include "reconstruct/tile/slab.h"

namespace loft {

/// The share of a slab's height at which the surface is over a place with these distances from
/// contours of the lower and of the upper slice, strictly between 0 and 1; see SheetHeights.
[[nodiscard]] double height_share(double to_lower, double to_upper);
/// The same in a slab of that height: where the contours of one slice are much farther away than
/// those of the other, as in a spur, its surface is as round as an end's.
[[nodiscard]] double height_share(double to_lower, double to_upper, double height);

/// Triangles of a sheet with corners on one circle: but for rounding, any other diagonals are as
/// good.
struct CircleCell {
  std::vector<cdt::TriangleId> triangles;
  cdt::Point centre;    ///< centroid of their area
  double diameter = 0;  ///< of the circle
};

/// Where the surface is over the inside of a slab's sheets, by the distances to the contours that
/// bound them. Looks at the slab's triangles as they are when asked
/// first; make a new one after splits. Distances are prepared only for the sheets asked about.
class SheetHeights {
 public:
  explicit SheetHeights(const Slab& slab);

  /// Whether the sheet left of e touches the contours of one slice only: something ends there.
  [[nodiscard]] bool is_end(cdt::EdgeId e) { return sheet_at(e).is_end(); }
  /// How far a point in the sheet left of e is from its nearest contour.
  [[nodiscard]] double depth(cdt::EdgeId e, cdt::Point p);
  /// The height of the surface over a point in the sheet left of e, strictly between the slices.
  ///
  /// Between contours of both slices, their distances a and b share the slab: a^k / (a^k + b^k).
  /// k = 1 is shape-based interpolation (Raya and Udupa, 1990). With k = 0.7 the surface leaves
  /// the contours more steeply, as round forks do: on 11 stacks cut from known shapes it came 0 to
  /// 3% nearer to them. In spurs, far from the other slice's contours, what is d away from their
  /// own is at least as high as it is deep, up to 0.7 of the slab, as in an end; times (1 - d /
  /// D)^3, D the larger distance, so that this ends where the other contour begins. On 40 stacks,
  /// sparse ones foremost, that took up to 4% off the distance to the shape, and added 1.2% on one.
  /// In an end it is a paraboloid, as high as the sheet is deep, from 0.05 to at most 0.7 of the
  /// slab: a smooth shape's last slice is as likely to be at any height below its top, and the
  /// area of what is beyond grows with that height, so that half of all such area is in ends
  /// higher than 0.71 of the gap.
  [[nodiscard]] double height(cdt::EdgeId e, cdt::Point p);

  /// The cell that an edge of a sheet is a diagonal of; null if it is none.
  [[nodiscard]] const CircleCell* cell(cdt::EdgeId e);

 private:
  struct Sheet {
    std::size_t first = 0;  // its triangles, in triangles_
    std::size_t last = 0;
    bool touches_lower = false;
    bool touches_upper = false;
    bool is_measured = false;  // what follows is known
    NearestSegment lower;
    NearestSegment upper;
    double radius = 0;  // of an end: the largest depth of the middle of an edge or cell

    [[nodiscard]] bool is_end() const { return !touches_lower || !touches_upper; }
    [[nodiscard]] double depth(cdt::Point p) const {
      return std::min(lower.distance(p), upper.distance(p));
    }
  };

  Sheet& sheet_at(cdt::EdgeId e);
  const Sheet& measured(cdt::EdgeId e);
  void explore(cdt::TriangleId start);
  void measure(Sheet& sheet) const;
  void find_cells(const Sheet& sheet);
  void find_centre(CircleCell& cell) const;
  [[nodiscard]] bool is_diagonal(cdt::EdgeId e) const;
  [[nodiscard]] cdt::Point centroid(cdt::TriangleId t) const;
  [[nodiscard]] double end_share(const Sheet& sheet, cdt::Point p) const;

  const Slab& slab_;
  std::vector<Sheet> sheets_;
  std::vector<cdt::TriangleId> triangles_;  // sheet by sheet
  std::vector<cdt::TriangleId> front_;
  std::vector<std::uint32_t> sheet_of_;  // of each triangle; Origin::none where not yet explored
  std::deque<CircleCell> cells_;         // which stay where they are
  std::vector<std::uint32_t> cell_of_;   // of each triangle
};

}  // namespace loft
