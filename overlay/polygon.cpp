// SPDX-License-Identifier: MIT
#include "overlay/polygon.h"

namespace loft::overlay {

ExactArea area(const Polygon& polygon) {
  ExactArea result = area(polygon.outer);
  for (const Ring& hole : polygon.holes) result += area(hole);
  return result;
}

ExactArea area(const MultiPolygon& polygons) {
  ExactArea result;
  for (const Polygon& polygon : polygons) result += area(polygon);
  return result;
}

}  // namespace loft::overlay
