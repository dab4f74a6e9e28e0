// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Whether bytes begin as a PNG does.
[[nodiscard]] inline bool begins_like_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n");
}

/// Reads PNGs as slices, one behind the other, by libpng: labels (label_images.h) as grey of 1 to
/// 16 bits, by palette or as colours. Rows run along y. A PNG does not say how far slices are
/// apart, so the options must have the spacing.
///
/// Throws InputError that names the file. Memory: an image, beside the files. In a build without
/// libpng always InputError that says so.
[[nodiscard]] Stack read_png_series(std::span<const StackInput> inputs, const ReadOptions& options);

/// A series of one.
[[nodiscard]] Stack read_png(const StackInput& input, const ReadOptions& options);

}  // namespace loft::io
