// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/json.h"
#include "reconstruct/slice.h"

namespace loft::app {

/// What a Server shows: a surface in pieces, and the slices that it goes through. For any number of
/// threads.
class Exhibit {
 public:
  Exhibit() = default;
  virtual ~Exhibit() = default;
  Exhibit(const Exhibit&) = delete;
  Exhibit& operator=(const Exhibit&) = delete;

  /// All that there is, as an event for a viewer that starts, and the number of the event after it.
  [[nodiscard]] virtual std::pair<std::string, std::uint64_t> reset_event() const = 0;
  /// A slab as GLB (io/slab_glb.h); none if it is gone.
  [[nodiscard]] virtual std::optional<std::string> slab_file(std::size_t part,
                                                             std::uint32_t id) = 0;
  /// The surface as a file with that extension (`.glb`); none as long as there is no surface.
  /// Throws io::UnknownFormat.
  [[nodiscard]] virtual std::optional<std::string> surface_file(const std::string& extension) = 0;
  /// The slice at a height as it came in, if there is one.
  [[nodiscard]] virtual std::optional<Slice> slice(double z) const = 0;
  [[nodiscard]] virtual std::vector<double> heights() const = 0;
  [[nodiscard]] virtual Json status() const = 0;
};

}  // namespace loft::app
