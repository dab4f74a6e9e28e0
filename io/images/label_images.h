// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/stacks/read_options.h"
#include "io/volumes/volume.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// What the numbers of an image's pixels are.
enum class Ink {
  grey,     ///< values
  palette,  ///< places in a list of colours
  colour,   ///< 0xRRGGBB; pixels that are clear are black
};

struct PaletteColour {
  Colour colour;
  bool is_clear = false;

  friend bool operator==(const PaletteColour&, const PaletteColour&) = default;
};

/// An image that is a slice, but for its pixels.
struct LabelImage {
  std::string name;  ///< of its file, and its page there; for messages
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  Ink ink = Ink::grey;
  /// The value of white, for images of different depths whose values are to be brought to one; 0:
  /// they stay as they are.
  double white = 0;
  std::vector<PaletteColour> palette = {};
};

/// Fills in the pixels of the image at that place, row by row.
using ReadImage = std::function<void(std::size_t image, std::span<double> pixels)>;

/// The outlines (outlines.h) of a series of images of one size, the slices of `volume`, which has
/// all else: place, spacing, unit, notes.
///
/// Values of grey are labels, 0 is none. So are places in a palette, whose colours the labels have;
/// clear ones are none. In images of colours, or of palettes that are not the same, each colour is
/// a label, named `#rrggbb`, and what is black or clear is none. Where a program that saves space
/// has written images of fewer bits among others, their values mean the same share of white.
///
/// A level counts for images of grey only. Throws InputError as trace(), and for images that differ
/// in size. Cost: O(pixels).
[[nodiscard]] Stack trace_images(Volume volume, const std::vector<LabelImage>& images,
                                 const ReadImage& read, const ReadOptions& options,
                                 bool may_be_shares);

}  // namespace loft::io
