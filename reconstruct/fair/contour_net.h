// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/fair/edge_meetings.h"
#include "reconstruct/fair/outline_net.h"

namespace loft {

/// The contours of a slice as a net: equal points are one. Laws: points ascend, and so do loops,
/// each of which begins and turns so that it is least; so the net depends neither on the order of
/// the contours nor on where their points begin, which way they go round, or what is repeated.
struct ContourNet {
  OutlineNet net;
  std::vector<std::vector<std::uint32_t>> numbers;  ///< of the points of each contour
  /// Edges of contours that enclose nothing, for a part to end in; of a single point one to itself.
  std::vector<NetEdge> flat_edges;
};

[[nodiscard]] ContourNet make_net(std::span<const std::span<const cdt::Point>> contours);

}  // namespace loft
