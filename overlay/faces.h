// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "overlay/overlay.h"

namespace loft::overlay {

/// A part of the plane that is joined by edges and has the same cover everywhere.
struct Face {
  std::vector<LayerId> layers;  ///< sorted; never empty
  Polygon polygon;

  friend bool operator==(const Face&, const Face&) = default;
};

/// All faces that have a layer, each once: what the plane falls into. Sorted by their outlines'
/// smallest points. Cost: O(triangles).
[[nodiscard]] std::vector<Face> faces(const Overlay& overlay, Vertices vertices = Vertices::needed);

/// The parts of a result between lines, which may be lines or rings of any layer: a polygon that is
/// cut. What does not cut through cuts nothing off. Sorted, as polygons() are. Cost: O(triangles).
[[nodiscard]] MultiPolygon parts_between(const Overlay& overlay, ResultId result,
                                         std::span<const RingId> lines,
                                         Vertices vertices = Vertices::needed);

}  // namespace loft::overlay
