// SPDX-License-Identifier: MIT
#include "app/capture/net_change.h"

namespace loft::app {

std::string slab_name(const SlabKey& slab) {
  return std::to_string(slab.first) + '-' + std::to_string(slab.second);
}

std::vector<std::string> slab_names(const std::vector<SlabKey>& slabs) {
  std::vector<std::string> names;
  for (const SlabKey& slab : slabs) names.push_back(slab_name(slab));
  return names;
}

Json to_json(const SlabKey& key, const ShownSlab& slab) {
  return {{"id", slab_name(key)},
          {"low", slab.info.low},
          {"high", slab.info.high},
          {"label", slab.label},
          {"edit", slab.edit}};
}

void NetChange::add(std::size_t part, const std::string& label, const SurfaceChange& change) {
  for (const std::uint32_t id : change.removed) remove({part, id});
  for (const SlabInfo& slab : change.added) added_[{part, slab.id}] = {label, slab};
  for (const Defect& repair : change.repairs) note(describe(repair));
}

void NetChange::add(const NetChange& later) {
  for (const SlabKey& slab : later.removed_) remove(slab);
  for (const auto& [key, slab] : later.added_) added_[key] = slab;
  repairs_.insert(repairs_.end(), later.repairs_.begin(), later.repairs_.end());
}

void NetChange::remove(const SlabKey& slab) {
  if (added_.erase(slab) == 0) removed_.push_back(slab);
}

std::vector<SlabKey> NetChange::added() const {
  std::vector<SlabKey> slabs;
  for (const auto& [key, slab] : added_) slabs.push_back(key);
  return slabs;
}

Json NetChange::added_as_json(std::uint64_t edit) const {
  Json all = Json::array();
  for (const auto& [key, slab] : added_)
    all.push_back(to_json(key, {slab.first, slab.second, edit}));
  return all;
}

void NetChange::bring_up_to_date(std::uint64_t edit, ShownSlabs& slabs) const {
  for (const SlabKey& key : removed_) slabs.erase(key);
  for (const auto& [key, slab] : added_) slabs[key] = {slab.first, slab.second, edit};
}

}  // namespace loft::app
