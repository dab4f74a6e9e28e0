// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Whether bytes begin as an NRRD file.
[[nodiscard]] bool begins_like_nrrd(std::string_view bytes);

/// Reads a label volume, or one of shares or grey, of NRRD (http://teem.sourceforge.net/nrrd):
/// pixels raw, gzip or as text, in the file or in one beside it; the segments of 3D Slicer's
/// seg.nrrd, in several layers, with names and colours, and those of old SlicerRT. Coordinates are
/// in the file's space. Throws InputError that names field or byte.
[[nodiscard]] Stack read_nrrd(const StackInput& input, const ReadOptions& options);

}  // namespace loft::io
