// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/json.h"
#include "reconstruct/live/surface_change.h"

namespace loft::app {

/// A slab of one of several surfaces: the number of its part, and its id.
using SlabKey = std::pair<std::size_t, std::uint32_t>;

/// A slab as viewers know it.
[[nodiscard]] std::string slab_name(const SlabKey& slab);
[[nodiscard]] std::vector<std::string> slab_names(const std::vector<SlabKey>& slabs);

/// What viewers are told of a slab.
struct ShownSlab {
  std::string label;
  SlabInfo info;
  std::uint64_t edit = 0;  ///< that made it
};
using ShownSlabs = std::map<SlabKey, ShownSlab>;

[[nodiscard]] Json to_json(const SlabKey& key, const ShownSlab& slab);

/// Slabs that came and went in all, over several changes of surfaces: what came and went again is
/// not in it.
class NetChange {
 public:
  void add(std::size_t part, const std::string& label, const SurfaceChange& change);
  /// Another one that came after it.
  void add(const NetChange& later);
  /// Something that was found.
  void note(std::string repair) { repairs_.push_back(std::move(repair)); }

  [[nodiscard]] bool is_empty() const { return removed_.empty() && added_.empty(); }
  [[nodiscard]] const std::vector<SlabKey>& removed() const { return removed_; }
  [[nodiscard]] std::vector<SlabKey> added() const;
  [[nodiscard]] const std::vector<std::string>& repairs() const { return repairs_; }
  /// With `edit` as the edit that made them.
  [[nodiscard]] Json added_as_json(std::uint64_t edit) const;

  /// Brings what viewers are told up to date; `edit` made what is new.
  void bring_up_to_date(std::uint64_t edit, ShownSlabs& slabs) const;

 private:
  void remove(const SlabKey& slab);

  std::map<SlabKey, std::pair<std::string, SlabInfo>> added_;
  std::vector<SlabKey> removed_;
  std::vector<std::string> repairs_;
};

}  // namespace loft::app
