// SPDX-License-Identifier: MIT
#include "io/meshes/extent.h"

namespace loft::io {

Box3 extent(std::span<const Part> parts) {
  Box3 box = no_box;
  for (const Part& part : parts) {
    for (const auto vertex : part.surface->vertices()) {
      const auto& point = part.surface->point(vertex);
      box = extended(box, {point[0], point[1], point[2]});
    }
  }
  return box;
}

Vec3 centre_of(const Box3& box) {
  if (!(box.low[0] <= box.high[0])) return {};
  // Halves first: the sum may be too large.
  return {box.low[0] / 2 + box.high[0] / 2, box.low[1] / 2 + box.high[1] / 2,
          box.low[2] / 2 + box.high[2] / 2};
}

}  // namespace loft::io
