// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/volumes/raw_pixels.h"
#include "io/volumes/volume.h"

namespace loft::io {

/// What the header of a MetaImage says.
struct MetaImageHeader {
  enum class Encoding { raw, zlib, text };

  Volume volume;     ///< all but its pixels
  RawPixels pixels;  ///< all but their bytes
  Encoding encoding = Encoding::raw;
  std::optional<std::uint64_t> packed_size;  ///< of pixels by zlib, where it is said
  /// What is in front of the pixels in each file; none: they are the last that is in it.
  std::optional<std::uint64_t> skip = 0;
  std::vector<std::string> files;  ///< beside the header, alike in size; none: pixels follow it
  std::uint64_t size = 0;          ///< of the header
};

/// Throws InputError that names the line or field.
[[nodiscard]] MetaImageHeader read_meta_image_header(std::string_view bytes,
                                                     const std::string& name);

/// The names of `count` files by words `PATTERN FIRST LAST STEP`, of which the pattern has one
/// `%d` or `%03d`, and what is left out counts from 1 on by 1; none where that is no such pattern,
/// or makes another number of them.
[[nodiscard]] std::vector<std::string> names_by_pattern(std::string_view words,
                                                        std::uint64_t count);

}  // namespace loft::io
