// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Whether bytes begin as the header of a MetaImage does.
[[nodiscard]] bool begins_like_meta_image(std::string_view bytes);

/// Reads a label volume, or one of shares or grey, of ITK's MetaImage (.mha, .mhd): pixels raw, by
/// zlib or as text, behind the header, in a file beside it, or in one for each slice, by a list or
/// a pattern of names. Rows of TransformMatrix are the directions of the axes; the world is LPS.
/// Throws InputError that names field or byte.
[[nodiscard]] Stack read_meta_image(const StackInput& input, const ReadOptions& options);

}  // namespace loft::io
