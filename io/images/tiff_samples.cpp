// SPDX-License-Identifier: MIT
#include "io/images/tiff_samples.h"

#include <cmath>

#include "io/bytes/little_endian.h"

namespace loft::io {

namespace {

template <class Number>
double number_at(const SampleRow& row, std::size_t index) {
  const auto* const place = reinterpret_cast<const char*>(row.bytes) + index * sizeof(Number);
  return static_cast<double>(get<Number>(place, row.order));
}

double bits_at(const SampleRow& row, std::size_t index) {
  const std::size_t bit = index * row.bits;
  const unsigned shift = 8 - row.bits - static_cast<unsigned>(bit % 8);
  return row.bytes[bit / 8] >> shift & ((1U << row.bits) - 1);
}

using SampleAt = double (*)(const SampleRow&, std::size_t);

SampleAt sample_at(const SampleRow& row) {
  switch (row.bits) {
    case 8:
      return row.is_signed ? number_at<std::int8_t> : number_at<std::uint8_t>;
    case 16:
      return row.is_signed ? number_at<std::int16_t> : number_at<std::uint16_t>;
    case 32:
      if (row.is_real) return number_at<float>;
      return row.is_signed ? number_at<std::int32_t> : number_at<std::uint32_t>;
    case 64:
      if (row.is_real) return number_at<double>;
      return row.is_signed ? number_at<std::int64_t> : number_at<std::uint64_t>;
    default:
      return bits_at;
  }
}

}  // namespace

void take_samples(const SampleRow& row, std::size_t first, SampleRole role,
                  std::span<double> pixels) {
  const SampleAt at = sample_at(row);
  const double white = std::ldexp(1, static_cast<int>(row.bits)) - 1;
  const auto part = [&](double sample) { return std::round(sample / white * 255); };
  std::size_t index = first;
  for (double& pixel : pixels) {
    const double sample = at(row, index);
    index += row.step;
    switch (role) {
      case SampleRole::value:
        pixel = sample;
        break;
      case SampleRole::red:
        pixel = part(sample) * 65536;
        break;
      case SampleRole::green:
        pixel += part(sample) * 256;
        break;
      case SampleRole::blue:
        pixel += part(sample);
        break;
      case SampleRole::alpha:
        if (sample == 0) pixel = 0;
        break;
    }
  }
}

}  // namespace loft::io
