// SPDX-License-Identifier: MIT
// Only for sources that are built with libpng.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/images/label_images.h"

namespace loft::io {

/// What a PNG says before its pixels.
struct PngHeader {
  LabelImage image;
  std::optional<double> x_distance;  ///< of pixels, in mm
  std::optional<double> y_distance;
};

/// Throws InputError that names the file, for sizes larger than what its bytes can hold, too.
[[nodiscard]] PngHeader read_png_header(std::string_view bytes, const std::string& name);

/// The pixels as label images have them: precondition, the header is that of these bytes.
void read_png_pixels(std::string_view bytes, const PngHeader& header, std::span<double> pixels);

}  // namespace loft::io
