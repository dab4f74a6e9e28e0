// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "reconstruct/stack.h"

namespace loft::io {

/// A colour as DICOM has it, L*, a* and b* of white D50 over the range of 16 bits (PS3.3,
/// C.10.7.1.1), in sRGB; what no screen shows is clamped.
[[nodiscard]] Colour from_cielab(const std::array<std::uint16_t, 3>& scaled);

}  // namespace loft::io
