// SPDX-License-Identifier: MIT
#include "reconstruct/fair.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "reconstruct/clean/heights.h"
#include "reconstruct/fair/fair_contours.h"
#include "reconstruct/parallel.h"
#include "reconstruct/usable.h"

namespace loft {

std::vector<Slice> fair(std::span<const Slice> slices, double distance, double height_tolerance,
                        unsigned threads) {
  std::vector<double> z;
  for (const Slice& slice : slices) z.push_back(slice.z);
  std::vector<Defect> merged;  // whoever reconstructs finds them again
  const std::vector<Height> heights = find_heights(z, height_tolerance, merged);
  std::vector<Slice> result(slices.begin(), slices.end());
  for_each_index(heights.size(), threads, [&](std::size_t i, unsigned) {
    std::vector<Slice*> parts;
    for (const std::uint32_t s : heights[i].slices) parts.push_back(&result[s]);
    make_fair(parts, distance);
  });
  return result;
}

Stack fair(const Stack& stack, double distance, double height_tolerance, unsigned threads) {
  require_usable(stack.slices);
  Stack result = stack;
  result.slices = fair(stack.slices, distance, height_tolerance, threads);
  for (Slice& slice : result.slices)
    for (Contour& contour : slice.contours) contour.places.clear();
  return result;
}

}  // namespace loft
