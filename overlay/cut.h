// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "overlay/overlay.h"

namespace loft::overlay {

/// A stretch of a line with the same layers all along.
struct LinePiece {
  std::vector<Point> points;  ///< two at least
  Cover cover;                ///< what it is inside of, and on whose border it runs
  double length = 0;

  friend bool operator==(const LinePiece&, const LinePiece&) = default;
};

/// A line or ring that is in an overlay, cut where layers begin and end, in its order. Its points
/// are kept, others are only where it is cut. Cost: its edges, and what they are covered by.
[[nodiscard]] std::vector<LinePiece> pieces(const Overlay& overlay, RingId line);

/// The lengths by cover, which sum to the line's, in the order of the covers' lists.
[[nodiscard]] std::vector<std::pair<Cover, double>> lengths(std::span<const LinePiece> pieces);

/// The covers on the left and on the right of an edge.
[[nodiscard]] std::pair<CoverId, CoverId> covers_beside(const Overlay& overlay, EdgeId edge);
/// The layers on both sides of an edge, and on one side only.
[[nodiscard]] Cover cover_along(const Overlay& overlay, EdgeId edge);

}  // namespace loft::overlay
