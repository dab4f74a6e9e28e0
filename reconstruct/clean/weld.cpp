// SPDX-License-Identifier: MIT
#include "reconstruct/clean/weld.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace loft {

std::vector<std::uint32_t> weld(const Region& region, double least_distance,
                                std::vector<Defect>& repairs) {
  const auto& points = region.points;
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::uint32_t> target = order;
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return points[i]; });
  const auto is_crossing = [&](std::uint32_t i) {
    return region.origins[i].kind == VertexKind::cleaning;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const cdt::Point p = points[order[i]];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const cdt::Point q = points[order[j]];
      if (q.x - p.x > 2 * least_distance) break;
      if (std::abs(q.y - p.y) > 2 * least_distance) continue;
      if (is_crossing(order[j])) {
        target[order[j]] = target[order[i]];
      } else if (is_crossing(order[i])) {
        target[order[i]] = order[j];
      } else if (target[order[j]] == order[j]) {
        const Origin& origin = region.origins[order[j]];
        repairs.push_back({DefectKind::repeated_point, region.z, origin.slice, origin.contour,
                           origin.point, q, 0,
                           "is nearer to another point than can be told apart; one kept"});
        target[order[j]] = target[order[i]];
      }
    }
  }
  for (std::uint32_t& i : target) i = target[i];
  return target;
}

}  // namespace loft
