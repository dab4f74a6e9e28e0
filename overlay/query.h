// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "overlay/overlay.h"

namespace loft::overlay {

/// A place on a border.
struct BorderPlace {
  EdgeId edge;  ///< valid until the next edit; the layers on both sides: cover_along()
  Point place;
  double distance = 0;
};

/// The nearest place on the border of any layer, where who covers the plane changes; none if there
/// is no such border. Of several as near, any. Rounded in distances only. Cost: to locate the
/// point, then the triangles nearer than the answer; outside of the hull, the hull, too.
[[nodiscard]] std::optional<BorderPlace> nearest_border(const Overlay& overlay, Point p);
/// The same of one layer.
[[nodiscard]] std::optional<BorderPlace> nearest_border(const Overlay& overlay, Point p,
                                                        LayerId layer);

/// The layers of which some area is inside a box: exact, sorted. A border along the box's side does
/// not count, nor do lines. Cost: to locate its middle, then the triangles that it touches.
[[nodiscard]] std::vector<LayerId> layers_in(const Overlay& overlay, const cdt::Box& box);

/// The layers of which some area is nearer to a point than `radius`, sorted. Cost: as above.
[[nodiscard]] std::vector<LayerId> layers_near(const Overlay& overlay, Point p, double radius);

}  // namespace loft::overlay
