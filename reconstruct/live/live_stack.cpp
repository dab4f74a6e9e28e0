// SPDX-License-Identifier: MIT
#include "reconstruct/live/live_stack.h"

#include <algorithm>
#include <iterator>

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

}  // namespace loft
