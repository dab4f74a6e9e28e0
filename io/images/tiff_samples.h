// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace loft::io {

/// Samples of a row of an image, as they are side by side in memory; those of less than a byte
/// begin with its highest bits.
struct SampleRow {
  const std::uint8_t* bytes;
  unsigned bits;  ///< of a sample: 1, 2, 4, 8, 16, 32, 64
  bool is_signed;
  bool is_real;
  std::endian order = std::endian::native;
  std::size_t step;  ///< samples from one pixel to the next
};

/// What a sample is of its pixel.
enum class SampleRole { value, red, green, blue, alpha };

/// Puts what one sample of each pixel says into the row's pixels, those that came before in the
/// order of roles included; pixels without any alpha become 0. Colours are brought to 8 bits.
void take_samples(const SampleRow& row, std::size_t first, SampleRole role,
                  std::span<double> pixels);

}  // namespace loft::io
