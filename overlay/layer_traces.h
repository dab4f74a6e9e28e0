// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "overlay/overlay.h"
#include "overlay/trace.h"

namespace loft::overlay {

/// The rings of a layer, edge by edge, polygon by polygon, though no one watches it. Cost: O(covers
/// there are + triangles of the layer).
[[nodiscard]] std::vector<TracedPolygon> layer_traces(const Overlay& overlay, LayerId layer);

}  // namespace loft::overlay
