// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "reconstruct/stack.h"

namespace loft::app {

/// How large a label is, in the cubed unit of its stack.
struct LabelVolume {
  double surface = 0;        ///< what its flat surface encloses
  double slabs = 0;          ///< of each slice its area times its thickness; see Reconstructed
  std::string problem = {};  ///< why there is no surface, and neither volume; empty otherwise
};

/// Of every label that has contours. Cost: that of reconstructing them.
[[nodiscard]] std::map<std::string, LabelVolume> label_volumes(const Stack& stack);

/// `volume 433.7 cm^3, as slabs 439.7`, or `no surface: ...`.
[[nodiscard]] std::string describe(const LabelVolume& volume, const std::string& unit);

/// cm^3 of a volume in the cubed unit; of one that is no length as if that were mm.
[[nodiscard]] double cubic_centimetres(double volume, const std::string& unit);

}  // namespace loft::app
