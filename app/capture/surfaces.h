// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <span>
#include <vector>

#include "app/capture/capture.h"
#include "io/meshes/part.h"

namespace loft::app {

/// The surfaces of a capture, as files have them: those that have faces.
class Surfaces {
 public:
  /// `about`: what their source tells of labels.
  Surfaces(const CaptureView& view, std::span<const StackLabel> about) {
    for (const auto& [label, snapshot] : view.parts) {
      if (snapshot.slab_count() == 0) continue;
      surfaces_.emplace_back(snapshot);
      parts_.push_back(io::part_of(about, label));
      parts_.back().surface = &surfaces_.back().surface;
    }
  }

  [[nodiscard]] std::span<const io::Part> parts() const { return parts_; }

 private:
  /// Made in its place: an OpenMesh mesh cannot be moved, only copied.
  struct Made {
    explicit Made(const Snapshot& snapshot) : surface(snapshot.surface(1)) {}
    Surface surface;
  };

  std::list<Made> surfaces_;
  std::vector<io::Part> parts_;
};

}  // namespace loft::app
