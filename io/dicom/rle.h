// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace loft::io {

/// How many bytes RLE Lossless makes of one at most: runs of 128 take two.
inline constexpr std::size_t most_by_rle = 64;

/// The bytes of a frame by RLE Lossless (DICOM PS3.5, annex G): `segments` of them behind each
/// other, of `segment_size` bytes each; the first has the highest bytes of pixels. Throws
/// InputError that begins with `where`, and has the byte of the fragment.
[[nodiscard]] std::string unpack_rle(std::string_view fragment, std::size_t segments,
                                     std::size_t segment_size, const std::string& where);

}  // namespace loft::io
