// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Whether bytes begin as a TIFF or BigTIFF does.
[[nodiscard]] inline bool begins_like_tiff(std::string_view bytes) {
  for (const std::string_view begin : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4),
                                       std::string_view("II+\0", 4), std::string_view("MM\0+", 4)})
    if (bytes.starts_with(begin)) return true;
  return false;
}

/// Reads the pages of a TIFF as slices, by libtiff: labels (label_images.h) as whole numbers, by
/// palette or as colours, or shares; in strips or tiles, as they are or packed without loss. Rows
/// run along y. Distances are those of ImageJ's description or of OME-XML, else the options must
/// have them. Values stay as they are also where 0 is white; of ImageJ's files of more than 4 GB
/// all images count, of which there is one page. Previews and masks of pages are left out.
///
/// Throws InputError that names page and tag, and for several channels or points of time. Memory:
/// a page, beside the file. In a build without libtiff always InputError that says so.
[[nodiscard]] Stack read_tiff(const StackInput& input, const ReadOptions& options);

/// The same for files of one page each.
[[nodiscard]] Stack read_tiff_series(std::span<const StackInput> inputs,
                                     const ReadOptions& options);

}  // namespace loft::io
