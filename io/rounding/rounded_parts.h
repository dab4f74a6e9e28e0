// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <span>
#include <vector>

#include "io/meshes/part.h"
#include "io/rounding/float_frame.h"
#include "io/rounding/rounding.h"

namespace loft::io {

/// Surfaces that are solids still when a format has rounded their coordinates to `float`.
///
/// The rounded surfaces are tested exactly, each by itself, mended (mender.h), and tested again.
/// Where `are_one`, vertices of different surfaces do not share a place, either: for formats that
/// know triangles only. Where there are too many faults they are counted only: coordinates far from
/// the origin, say. Same surfaces, same result, whatever the number of threads, of which 0 are
/// all there are. Cost: O(n log n), as check(); only surfaces with faults are copied.
class RoundedParts {
 public:
  RoundedParts(std::span<const Part> parts, const FloatFrame& frame, bool are_one,
               unsigned threads = 1);

  /// As good as they could be made; as the frame rounds them they were tested.
  [[nodiscard]] std::span<const Part> parts() const { return parts_; }
  [[nodiscard]] const Rounding& rounding() const { return rounding_; }

 private:
  std::vector<Part> parts_;
  std::list<Surface> mended_;  // where they differ
  Rounding rounding_;
};

}  // namespace loft::io
