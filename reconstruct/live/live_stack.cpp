// SPDX-License-Identifier: MIT
#include "reconstruct/live/live_stack.h"

#include <algorithm>
#include <iterator>

#include "reconstruct/link/tips.h"

namespace loft {

std::optional<std::pair<Stations::iterator, Stations::iterator>> LiveStack::range() {
  const auto is_filled = [](const auto& station) { return !station.second.region->is_empty(); };
  auto first = std::find_if(stations.begin(), stations.end(), is_filled);
  if (first == stations.end()) return {};
  auto last = std::prev(stations.end());
  while (!is_filled(*last)) --last;
  if (first != stations.begin()) --first;
  if (std::next(last) != stations.end()) ++last;
  if (first == last) return {};
  return std::pair{first, last};
}

std::vector<std::uint32_t> LiveStack::unused_lines_at(double z) const {
  const Region& region = *stations.at(z).region;
  if (region.line_count() == 0) return {};
  const auto from_here = slabs.lower_bound(z);
  const bool is_lower = from_here != slabs.end() && from_here->first == z;
  const bool is_upper =
      from_here != slabs.begin() && std::prev(from_here)->second.frozen->info.high == z;
  const auto pieces = [](const auto& slab) { return slab->second.frozen->pieces.get(); };
  return unused_lines(region, is_upper ? pieces(std::prev(from_here)) : nullptr,
                      is_lower ? pieces(from_here) : nullptr);
}

}  // namespace loft
