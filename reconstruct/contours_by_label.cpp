// SPDX-License-Identifier: MIT
#include "reconstruct/contours_by_label.h"

#include <algorithm>
#include <iterator>

#include "reconstruct/usable.h"

namespace loft {

ContoursByLabel::ContoursByLabel(std::span<const Slice> slices) {
  for (std::uint32_t s = 0; s < slices.size(); ++s) {
    const auto& contours = slices[s].contours;
    for (std::uint32_t c = 0; c < contours.size(); ++c)
      contours_[contours[c].label].push_back({s, c});
    std::ranges::move(find_unusable(slices[s], s), std::back_inserter(unusable_));
  }
}

std::vector<std::string> ContoursByLabel::labels() const {
  std::vector<std::string> names;
  for (const auto& [label, contours] : contours_) names.push_back(label);
  return names;
}

std::span<const ContourId> ContoursByLabel::of(const std::string& label) const {
  const auto found = contours_.find(label);
  if (found == contours_.end()) return {};
  return found->second;
}

}  // namespace loft
