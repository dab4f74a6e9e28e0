// SPDX-License-Identifier: MIT
#include "overlay/windings.h"

#include <algorithm>

namespace loft::overlay {

void Windings::forget() {
  lists_ = {};
  covers_of_.clear();
  covers_ = {};
  for (auto& covers : by_layer_) covers.clear();
  crossings_.clear();
  changed_.clear();
  (void)number_of_changed();
}

std::vector<CoverId> Windings::covers_with(std::span<const LayerId> layers) const {
  std::vector<CoverId> result;
  for (const LayerId layer : layers) {
    const std::vector<CoverId>& more = by_layer_[layer.index()];
    result.insert(result.end(), more.begin(), more.end());
  }
  return result;
}

std::vector<CoverId> Windings::all_covers() const {
  std::vector<CoverId> result;
  for (std::uint32_t c = 0; c < cover_count(); ++c) result.emplace_back(c);
  return result;
}

WindingId Windings::crossed(WindingId here, LayerId layer, int step) {
  const std::uint64_t key =
      std::uint64_t{here.index()} << 32 | layer.index() << 1 | static_cast<unsigned>(step > 0);
  if (const std::uint32_t known = crossings_.find(key); known != FlatMap::none)
    return WindingId(known);
  const WindingId beyond = with(here, layer, step);
  crossings_.set(key, beyond.index());
  return beyond;
}

WindingId Windings::with(WindingId here, LayerId layer, int step) {
  const auto list = lists_[here.index()];
  changed_.assign(list.begin(), list.end());
  const auto at = std::lower_bound(changed_.begin(), changed_.end(), layer,
                                   [](const Turns& turns, LayerId l) { return turns.layer < l; });
  if (at == changed_.end() || at->layer != layer)
    changed_.insert(at, {layer, turned(layer, 0, step)});
  else if (const int times = turned(layer, at->times, step); times != 0)
    at->times = times;
  else
    changed_.erase(at);
  return number_of_changed();
}

int Windings::turned(LayerId layer, int times, int step) const {
  if (rules_[layer.index()] == FillRule::even_odd) return 1 - times;
  return times + step;
}

WindingId Windings::number_of_changed() {
  const WindingId result(lists_.number_of(changed_));
  if (result.index() == covers_of_.size()) {
    inside_.clear();
    for (const Turns& turns : changed_)
      if (is_inside(rules_[turns.layer.index()], turns.times)) inside_.push_back(turns.layer);
    const std::uint32_t known = covers_.size();
    const CoverId cover(covers_.number_of(inside_));
    covers_of_.push_back(cover);
    if (cover.index() == known)
      for (const LayerId layer : inside_) by_layer_[layer.index()].push_back(cover);
  }
  return result;
}

}  // namespace loft::overlay
