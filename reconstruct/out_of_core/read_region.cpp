// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core/read_region.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/usable.h"

namespace loft {

Region read_region(const SliceSource& source, const Height& height, const Options& options,
                   std::vector<Defect>& repairs, std::set<std::string>& labels,
                   cdt::Triangulation& memory) {
  std::vector<Slice> slices;
  std::vector<const Slice*> parts;
  slices.reserve(height.slices.size());
  for (const std::uint32_t s : height.slices) {
    slices.push_back(source.read(s));
    if (auto fatal = find_unusable(slices.back(), s); !fatal.empty())
      throw InputError(std::move(fatal));
    parts.push_back(&slices.back());
    if (!options.label)
      for (const Contour& contour : slices.back().contours) labels.insert(contour.label);
  }
  return clean(height, parts, options, repairs, memory);
}

std::vector<double> usable_heights(const SliceSource& source) {
  std::vector<double> z;
  std::vector<Defect> fatal;
  for (const SliceSource::Entry& slice : source.slices) {
    const auto index = static_cast<std::uint32_t>(z.size());
    std::ranges::move(find_unusable({slice.z, {}}, index), std::back_inserter(fatal));
    z.push_back(slice.z);
  }
  if (!fatal.empty()) throw InputError(std::move(fatal));
  return z;
}

}  // namespace loft
