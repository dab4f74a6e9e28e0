// SPDX-License-Identifier: MIT
#include "app/server/shown_contours.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace loft::app {

ShownContours::ShownContours(std::vector<Slice> slices) {
  for (Slice& slice : slices) {
    Slice& there = slices_[slice.z];
    there.z = slice.z;
    std::ranges::move(slice.contours, std::back_inserter(there.contours));
  }
}

std::optional<Slice> ShownContours::slice(double z) const {
  const auto found = slices_.find(z);
  if (found == slices_.end()) return {};
  return found->second;
}

std::vector<double> ShownContours::heights() const {
  std::vector<double> heights;
  for (const auto& [z, slice] : slices_) heights.push_back(z);
  return heights;
}

std::size_t ShownContours::count(std::string_view label) const {
  const auto has_label = [&](const Contour& contour) { return contour.label == label; };
  return static_cast<std::size_t>(std::ranges::count_if(slices_, [&](const auto& one) {
    return std::ranges::any_of(one.second.contours, has_label);
  }));
}

}  // namespace loft::app
