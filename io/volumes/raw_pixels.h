// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/stacks/read_options.h"
#include "io/volumes/volume.h"

namespace loft::io {

/// How a pixel is written.
enum class PixelType { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

[[nodiscard]] std::uint64_t size_of(PixelType type);
[[nodiscard]] bool is_real(PixelType type);

/// Pixels as files have them, x first, then y, then z.
struct RawPixels {
  std::string_view bytes;  ///< those of columns * rows * slices * layers pixels
  PixelType type = PixelType::u8;
  std::endian order = std::endian::little;
  bool layers_first =
      false;         ///< a pixel's layers side by side, else whole layers behind each other
  double slope = 1;  ///< of values, by what is written
  double intercept = 0;
};

/// What a format calls a type.
struct PixelTypeName {
  std::string_view name;
  PixelType type;
};

/// Headers in text that are longer are none. Bytes.
inline constexpr std::size_t longest_header = std::size_t{16} << 20U;

/// The bytes that pixels of the volume's sizes take; none if 2^63 are not enough.
[[nodiscard]] std::optional<std::uint64_t> byte_count(const Volume& volume, PixelType type);

/// So many numbers of a text with blanks, ends of lines or commas between them, as doubles of the
/// machine. Throws InputError, with `name`, where there are fewer.
[[nodiscard]] std::string pixels_in_text(std::string_view text, std::uint64_t count,
                                         const std::string& name);

/// Makes them the volume's pixels; the bytes must outlive it.
void set_pixels(Volume& volume, const RawPixels& pixels);

/// Where pixels are in what gzip or zlib has packed.
struct PixelPacking {
  std::uint64_t before = 0;  ///< bytes in front of them, unpacked
  std::string name;          ///< of the file, for messages
  std::uint64_t offset = 0;  ///< of the packed bytes in it, for messages
};

/// The same for pixels whose bytes are packed. They are unpacked slice by slice, as these are asked
/// for, but for whole layers behind each other, which are in memory. Throws InputError where the
/// packed bytes cannot hold so many; Volume::read does where they do not.
void set_packed_pixels(Volume& volume, const RawPixels& pixels, const PixelPacking& packing);

/// Decides what the values are, once all else is there: the options' level counts, then pixels that
/// are no whole numbers but from 0 to 1 are shares, of which half is inside; else they are labels.
/// Cost: O(pixels) where `may_be_shares`, reading them all.
void set_level(Volume& volume, const ReadOptions& options, bool may_be_shares);

/// Appends to the volume's notes what its world is: `RAS`, `LPS`, ...
void note_world(Volume& volume, std::string_view axes);

}  // namespace loft::io
