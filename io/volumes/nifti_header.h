// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "io/volumes/raw_pixels.h"
#include "io/volumes/volume.h"

namespace loft::io {

/// How many bytes tell all of a header of either version, and whether extensions follow.
inline constexpr std::size_t nifti_header_size = 544;

/// What a NIfTI header says.
struct NiftiHeader {
  Volume volume;         ///< all but its pixels and labels
  RawPixels pixels;      ///< all but their bytes
  std::uint64_t offset;  ///< of the pixels, in their file
  std::uint64_t size;    ///< of the header itself
  bool is_pair;          ///< pixels are in a file beside it
  bool has_extensions;
};

/// Whether bytes begin with a header of NIfTI.
[[nodiscard]] bool is_nifti_header(std::string_view bytes);

/// Throws InputError that names field and byte offset. `bytes` are the file's first.
[[nodiscard]] NiftiHeader read_nifti_header(std::string_view bytes, std::string_view name);

/// Labels of the tables in a header's extensions, which are XML.
[[nodiscard]] std::vector<VolumeLabel> labels_in_xml(std::string_view xml);

}  // namespace loft::io
