// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "reconstruct/stack.h"

namespace loft::io {

/// A colour as DICOM has it, L*, a* and b* over the range of 16 bits, in sRGB; what no screen shows
/// is clamped. White is D65: PS3.3, C.10.7.1.1 asks for D50, but programs write D65, dcmqi for one,
/// whose colours come out exactly by it.
[[nodiscard]] Colour from_cielab(const std::array<std::uint16_t, 3>& scaled);

}  // namespace loft::io
