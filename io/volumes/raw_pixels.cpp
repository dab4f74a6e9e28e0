// SPDX-License-Identifier: MIT
#include "io/volumes/raw_pixels.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes/inflate.h"
#include "io/bytes/little_endian.h"
#include "reconstruct/defect.h"

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

std::string pixels_in_text(std::string_view text, std::uint64_t count, const std::string& name) {
  if (count > text.size()) throw InputError(name + ": sizes: more pixels than the file has bytes");
  std::string bytes(count * sizeof(double), '\0');
  std::size_t at = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    at = std::min(text.find_first_not_of(" \t\r\n,", at), text.size());
    double value = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc())
      throw InputError(name + ": pixel " + std::to_string(i) + ": no number is there");
    std::memcpy(bytes.data() + i * sizeof(double), &value, sizeof(double));
    at = static_cast<std::size_t>(end - text.data());
  }
  return bytes;
}

namespace {

/// Turns bytes into the pixels of a slice.
class Decoding {
 public:
  Decoding(const Volume& volume, const RawPixels& pixels)
      : decode_(decoder(pixels.type)),
        order_(pixels.order),
        slope_(pixels.slope),
        intercept_(pixels.intercept),
        size_(size_of(pixels.type)),
        step_(pixels.layers_first ? size_ * volume.layers : size_),
        slice_step_(std::uint64_t{volume.columns} * volume.rows * step_),
        layer_step_(pixels.layers_first ? size_ : slice_step_ * volume.slices) {}

  /// Where a slice of a layer begins.
  [[nodiscard]] std::uint64_t place(std::uint32_t slice, std::uint32_t layer) const {
    return layer * layer_step_ + slice * slice_step_;
  }
  /// The bytes of a slice, with those of the layers that are side by side with it.
  [[nodiscard]] std::uint64_t slice_size() const { return slice_step_; }

  void operator()(const char* bytes, std::span<double> out) const {
    decode_(bytes, step_, order_, out);
    if (slope_ == 1 && intercept_ == 0) return;
    for (double& value : out) value = value * slope_ + intercept_;
  }

 private:
  Decode decode_;
  std::endian order_;
  double slope_;
  double intercept_;
  std::uint64_t size_;
  std::uint64_t step_;
  std::uint64_t slice_step_;
  std::uint64_t layer_step_;
};

/// Unpacks slice after slice.
class SliceUnpacker {
 public:
  SliceUnpacker(std::string_view bytes, PixelPacking packing, std::uint64_t slices,
                std::uint64_t slice_size)
      : bytes_(bytes),
        packing_(std::move(packing)),
        size_(slices * slice_size),
        slice_(slice_size) {}

  /// The bytes of slice k, until another one is asked for. Going back begins anew.
  const char* operator()(std::uint32_t k) {
    if (!stream_ || k + 1 < count_) begin();
    for (; count_ <= k; ++count_) {
      const std::size_t found = stream_->read(slice_);
      if (found < slice_.size())
        throw too_few_packed(size_, count_ * slice_.size() + found, packing_.name, packing_.offset);
    }
    return slice_.data();
  }

 private:
  void begin() {
    stream_.emplace(bytes_, packing_.name, packing_.offset);
    count_ = 0;
    std::array<char, 1 << 16> skipped;
    for (std::uint64_t left = packing_.before; left > 0;) {
      const std::size_t room =
          static_cast<std::size_t>(std::min<std::uint64_t>(left, skipped.size()));
      if (stream_->read(std::span(skipped).first(room)) < room)
        throw too_few_packed(size_, 0, packing_.name, packing_.offset);
      left -= room;
    }
  }

  std::string_view bytes_;
  PixelPacking packing_;
  std::uint64_t size_;
  std::vector<char> slice_;  // the last one that was unpacked
  std::optional<InflateStream> stream_;
  std::uint32_t count_ = 0;  // of slices unpacked
};

}  // namespace

void set_pixels(Volume& volume, const RawPixels& pixels) {
  volume.read = [decoding = Decoding(volume, pixels), bytes = pixels.bytes](
                    std::uint32_t slice, std::uint32_t layer, std::span<double> out) {
    decoding(bytes.data() + decoding.place(slice, layer), out);
  };
}

void set_packed_pixels(Volume& volume, const RawPixels& pixels, const PixelPacking& packing) {
  const Decoding decoding(volume, pixels);
  const std::uint64_t size = byte_count(volume, pixels.type).value();
  if (volume.layers > 1 && !pixels.layers_first) {
    const auto all = std::make_shared<const std::string>(
        inflate_all(pixels.bytes, packing.before + size, packing.name, packing.offset));
    volume.read = [=](std::uint32_t slice, std::uint32_t layer, std::span<double> out) {
      decoding(all->data() + packing.before + decoding.place(slice, layer), out);
    };
    return;
  }
  require_room_for(packing.before + size, pixels.bytes, packing.name, packing.offset);
  const auto unpack =
      std::make_shared<SliceUnpacker>(pixels.bytes, packing, volume.slices, decoding.slice_size());
  volume.read = [=](std::uint32_t slice, std::uint32_t layer, std::span<double> out) {
    decoding((*unpack)(slice) + decoding.place(0, layer), out);
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
