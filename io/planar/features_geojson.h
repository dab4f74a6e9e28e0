// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string_view>

#include "io/planar/map.h"

namespace loft::io {

/// Reads GeoJSON (RFC 7946) with all that belongs together: a feature collection, a feature or a
/// geometry of any type. Geometries in a collection are taken apart into polygons, lines and points
/// of their feature; altitudes are left out, and the repeated last points of rings.
///
/// Throws InputError that names `name`, feature, part and point of each bad place. Cost: O(n), no
/// document tree is built; however deep the text is nested, the stack is not.
[[nodiscard]] Map read_features_geojson(std::string_view text, std::string_view name);

/// Writes a feature collection, a feature a line, so that read_features_geojson() gives the map
/// back: numbers have as many digits as that takes. The same map gives the same bytes.
/// Precondition: all numbers are finite, every ring and line has a point.
void write_features_geojson(std::ostream& out, const Map& map);

}  // namespace loft::io
