// SPDX-License-Identifier: MIT
#include "io/volumes/raw_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/bytes/little_endian.h"

namespace loft::io {

namespace {

/// `count` numbers, each `step` bytes behind the one before.
template <class Number>
void decode(const char* place, std::size_t step, std::endian order, std::span<double> out) {
  for (double& value : out) {
    value = static_cast<double>(get<Number>(place, order));
    place += step;
  }
}

using Decode = void (*)(const char*, std::size_t, std::endian, std::span<double>);

Decode decoder(PixelType type) {
  switch (type) {
    case PixelType::u8:
      return decode<std::uint8_t>;
    case PixelType::i8:
      return decode<std::int8_t>;
    case PixelType::u16:
      return decode<std::uint16_t>;
    case PixelType::i16:
      return decode<std::int16_t>;
    case PixelType::u32:
      return decode<std::uint32_t>;
    case PixelType::i32:
      return decode<std::int32_t>;
    case PixelType::u64:
      return decode<std::uint64_t>;
    case PixelType::i64:
      return decode<std::int64_t>;
    case PixelType::f32:
      return decode<float>;
    case PixelType::f64:
      return decode<double>;
  }
  return nullptr;
}

/// Whether all pixels are from 0 to 1, and some in between.
bool are_shares(const Volume& volume) {
  std::vector<double> pixels(std::size_t{volume.columns} * volume.rows);
  bool has_between = false;
  for (std::uint32_t k = 0; k < volume.slices; ++k) {
    for (std::uint32_t layer = 0; layer < volume.layers; ++layer) {
      volume.read(k, layer, pixels);
      for (const double value : pixels) {
        if (value < 0 || value > 1) return false;
        has_between = has_between || (value > 0 && value < 1);
      }
    }
  }
  return has_between;
}

}  // namespace

std::uint64_t size_of(PixelType type) {
  switch (type) {
    case PixelType::u8:
    case PixelType::i8:
      return 1;
    case PixelType::u16:
    case PixelType::i16:
      return 2;
    case PixelType::u32:
    case PixelType::i32:
    case PixelType::f32:
      return 4;
    default:
      return 8;
  }
}

bool is_real(PixelType type) { return type == PixelType::f32 || type == PixelType::f64; }

std::optional<std::uint64_t> byte_count(const Volume& volume, PixelType type) {
  std::uint64_t count = size_of(type);
  for (const std::uint32_t factor : {volume.columns, volume.rows, volume.slices, volume.layers}) {
    if (factor != 0 && count > (std::numeric_limits<std::uint64_t>::max() >> 1) / factor) return {};
    count *= factor;
  }
  return count;
}

void set_pixels(Volume& volume, const RawPixels& pixels) {
  const std::uint64_t size = size_of(pixels.type);
  const std::uint64_t slice_pixels = std::uint64_t{volume.columns} * volume.rows;
  const std::uint64_t step = pixels.layers_first ? size * volume.layers : size;
  const std::uint64_t layer_step = pixels.layers_first ? size : size * slice_pixels * volume.slices;
  const bool is_scaled = pixels.slope != 1 || pixels.intercept != 0;
  volume.read = [=, decode = decoder(pixels.type)](std::uint32_t slice, std::uint32_t layer,
                                                   std::span<double> out) {
    decode(pixels.bytes.data() + layer * layer_step + slice * slice_pixels * step, step,
           pixels.order, out);
    if (!is_scaled) return;
    for (double& value : out) value = value * pixels.slope + pixels.intercept;
  };
}

void set_level(Volume& volume, const ReadOptions& options, bool may_be_shares) {
  volume.level = options.level;
  if (volume.level || !may_be_shares || !are_shares(volume)) return;
  constexpr double half = 0.5;
  volume.level = half;
  volume.notes.push_back(volume.name + ": its pixels are shares from 0 to 1: inside from 0.5 on");
}

void note_world(Volume& volume, std::string_view axes) {
  volume.notes.push_back(volume.name + ": coordinates are " + std::string(axes) +
                         ", as in the file");
}

}  // namespace loft::io
