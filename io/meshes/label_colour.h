// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "io/meshes/part.h"

namespace loft::io {

/// The colour of a label, wherever it is shown: linear red, green and blue, as glTF has them. It
/// depends on the name alone, so that a label keeps its colour whatever others there are; names
/// give hues, and tones of them, at random. Nothing and `surface`, as files call it, have that of
/// bone. Characters that some formats cannot hold count as what stands for them there.
[[nodiscard]] std::array<double, 3> label_colour(std::string_view label);

/// A colour of sRGB as a linear one (IEC 61966-2-1), and back.
[[nodiscard]] std::array<double, 3> linear(Colour colour);
[[nodiscard]] Colour srgb(const std::array<double, 3>& linear);

/// As files have it: that of its source, else label_colour().
[[nodiscard]] Colour colour_of(const Part& part);

}  // namespace loft::io
