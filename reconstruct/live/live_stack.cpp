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
  const auto above = slabs.find(z);
  const auto first_above = slabs.lower_bound(z);
  const Pieces* below = nullptr;
  if (first_above != slabs.begin() && std::prev(first_above)->second.frozen->info.high == z)
    below = std::prev(first_above)->second.frozen->pieces.get();
  return unused_lines(region, below,
                      above == slabs.end() ? nullptr : above->second.frozen->pieces.get());
}

}  // namespace loft
