// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads a DICOM file: the structures of an RT Structure Set (rtstruct.h) or the segments of a
/// Segmentation (seg.h), whatever its transfer syntax, with or without what should be in front of
/// its data set. Throws InputError that names tags by their path, items counted from 0:
/// `(3006,0039)[2]/(3006,0040)[5]/(3006,0050)`. A build without DCMTK throws one that says so.
[[nodiscard]] Stack read_dicom(const StackInput& input, const ReadOptions& options);

/// Whether bytes are those that a DICOM file begins with, also one without preamble or without meta
/// information.
[[nodiscard]] bool begins_like_dicom(std::string_view bytes);

}  // namespace loft::io
