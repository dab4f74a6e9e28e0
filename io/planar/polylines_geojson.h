// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "io/planar/polyline.h"

namespace loft::io {

/// Reads GeoJSON (RFC 7946): a feature collection, a feature or a geometry of any type.
///
/// Every point, line and ring becomes a polyline; the rings of a polygon are closed, and their
/// repeated last point is left out. A feature's property `name` names all of its polylines.
/// Altitudes, further properties and members, null and empty geometries are ignored.
///
/// Throws InputError that names `name`, feature, part and point of each bad place. Cost: O(n), no
/// document tree is built; however deep the text is nested, the stack is not.
[[nodiscard]] std::vector<Polyline> read_polylines_geojson(std::string_view text,
                                                           std::string_view name);

}  // namespace loft::io
