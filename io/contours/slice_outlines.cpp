// SPDX-License-Identifier: MIT
#include "io/contours/slice_outlines.h"

#include <map>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/defect.h"
#include "reconstruct/usable.h"

namespace loft::io {

std::vector<LabelRegion> slice_outlines(const Stack& stack, std::uint32_t slice) {
  const Slice& from = stack.slices[slice];
  if (auto defects = find_unusable(from, slice); !defects.empty())
    throw InputError(std::move(defects));
  std::map<std::string, std::vector<ContourSource>> by_label;
  for (std::uint32_t c = 0; c < from.contours.size(); ++c)
    by_label[from.contours[c].label].push_back({from.contours[c].points, slice, c});
  const Filling filling{stack.fill.value_or(Fill::even_odd), stack.keyhole_width};
  std::vector<LabelRegion> result;
  std::vector<Defect> repairs;
  for (const auto& [label, contours] : by_label)
    result.push_back({label, clean(contours, from.z, filling, repairs)});
  return result;
}

}  // namespace loft::io
