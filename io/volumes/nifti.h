// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Label volumes of NIfTI-1 and -2, gzipped or not, in one file or with their pixels beside the
/// header. Names and colours come from a label table in the header's extensions. The pixels' place
/// is that of the sform, else the qform, else their spacing alone; the world is RAS.
///
/// Throws InputError with byte offset or field. Cost: O(pixels), which are in memory once.
[[nodiscard]] Stack read_nifti(const StackInput& input, const ReadOptions& options);

[[nodiscard]] bool begins_like_nifti(std::string_view bytes);

}  // namespace loft::io
