// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/json.h"
#include "app/server/shown_label.h"
#include "app/server/slab_ranges.h"
#include "reconstruct/slice.h"

namespace loft::app {

/// What viewers see: a surface in pieces. For any number of threads.
class Shown {
 public:
  virtual ~Shown() = default;

  /// All that there is, as an event for a viewer that starts, and the number of the event after it:
  /// kind (file, session, capture), name (of the file; may be empty), is_patient (whether the
  /// frame is a patient's), slabs (id, low, high, label), slices, counts, volume, unit,
  /// metres_per_unit, downloads; edits where these change the surface.
  [[nodiscard]] virtual std::pair<std::string, std::uint64_t> reset_event() const = 0;
  [[nodiscard]] virtual Json status() const = 0;
  /// The edits (History::to_json()); none where the surface does not come of any.
  [[nodiscard]] virtual std::optional<Json> history() const { return {}; }
  /// In the order in which parts are counted; one of each name.
  [[nodiscard]] virtual std::vector<ShownLabel> labels() = 0;

  /// A slab as GLB (io/gltf/slab_glb.h); none where it is gone, or never was.
  [[nodiscard]] virtual std::optional<std::string> slab(std::size_t part, std::uint32_t id) = 0;
  /// Slabs as GLBs one behind the other (io::bundle_glb; each says its length), as many as fit into
  /// so many bytes: at least one, if there is any of them. Empty where all are gone, or never were.
  [[nodiscard]] virtual std::string slabs(std::span<const SlabRange> ranges,
                                          std::size_t most_bytes) = 0;
  /// The file to download with that extension, `.ply`; none where there is no surface yet. Throws
  /// io::UnknownFormat.
  [[nodiscard]] virtual std::optional<std::string> surface(std::string_view extension) = 0;

  /// The slice at a height as it came in, or none.
  [[nodiscard]] virtual std::optional<Slice> slice(double z) const = 0;
  [[nodiscard]] virtual std::vector<double> heights() const = 0;

 protected:
  Shown() = default;
  Shown(const Shown&) = default;
  Shown& operator=(const Shown&) = default;
};

}  // namespace loft::app
