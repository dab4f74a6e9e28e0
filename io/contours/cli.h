// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads the Common Layer Interface 2.0 of printers, ASCII and binary: what is inside is wound
/// around (Fill::nonzero), by the direction that the file gives each outline, whatever the order of
/// its points. Heights and coordinates are multiples of `$$UNITS`, in mm. A part's name is the
/// label of its outlines.
///
/// Short binary coordinates are unsigned by the standard, but signed in all files that are known:
/// `$$DIMENSION` decides, or else the smaller extent. Open polylines and hatches are left out, and
/// counted. Every layer is a slice, empty ones too. Unknown commands are ignored in ASCII, where
/// they have an end, and errors in binary.
[[nodiscard]] Stack read_cli(const StackInput& input, const ReadOptions& options);

/// Whether a file begins as CLI does.
[[nodiscard]] bool begins_like_cli(std::string_view bytes);

}  // namespace loft::io
