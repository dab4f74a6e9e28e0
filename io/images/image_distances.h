// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/stacks/read_options.h"
#include "io/volumes/volume.h"

namespace loft::io {

/// What an image file says of the distances between its pixels and slices, and of how many images
/// there are.
struct ImageDistances {
  std::optional<double> x;
  std::optional<double> y;
  std::optional<double> z;
  std::string unit = {};  ///< `um`, `mm`, ...; empty where it is none of length
  bool is_image_j = false;
  bool is_described = false;  ///< by that or OME-XML, and so is the unit; else by a TIFF's tags
  std::uint64_t images = 0;   ///< 0: it does not say
  std::uint64_t channels = 1;
  std::uint64_t times = 1;
};

/// A TIFF's resolution, pixels in each unit; 0 where it says none.
struct TiffResolution {
  double x = 0;
  double y = 0;
  std::uint16_t unit = 1;  ///< 2: inches, 3: centimetres
};

/// By the description in a TIFF, of ImageJ or in OME-XML, and its resolution. Numbers that are no
/// distances count as not there.
[[nodiscard]] ImageDistances read_image_distances(std::string_view description,
                                                  const TiffResolution& resolution);

/// Gives them to a volume, unless the options have others. Throws InputError that says which are
/// missing.
void set_distances(Volume& volume, const ImageDistances& distances, const ReadOptions& options);

}  // namespace loft::io
