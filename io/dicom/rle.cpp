// SPDX-License-Identifier: MIT
#include "io/dicom/rle.h"

#include <algorithm>
#include <cstdint>

#include "io/bytes/little_endian.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr std::size_t header_size = 64;

/// Appends what runs make until there are `size` bytes more; the place where they end too early
/// otherwise.
std::size_t unpack_runs(std::string_view packed, std::size_t size, std::string& out) {
  const std::size_t end = out.size() + size;
  std::size_t at = 0;
  while (out.size() < end && at < packed.size()) {
    const auto code = static_cast<std::uint8_t>(packed[at++]);
    constexpr std::uint8_t nothing = 128;
    const std::size_t left = end - out.size();
    if (code < nothing) {
      const std::size_t count = std::min({code + std::size_t{1}, left, packed.size() - at});
      out.append(packed.substr(at, count));
      at += count;
    } else if (code > nothing && at < packed.size()) {
      out.append(std::min<std::size_t>(257U - code, left), packed[at++]);
    }
  }
  return at;
}

}  // namespace

std::string unpack_rle(std::string_view fragment, std::size_t segments, std::size_t segment_size,
                       const std::string& where) {
  const auto fail = [&](std::size_t place, const std::string& what) {
    throw InputError(where + ", byte " + std::to_string(place) + ": " + what +
                     "; the file is damaged, export it again");
  };
  if (fragment.size() < header_size) fail(0, "there is no header of 64 bytes");
  const auto number = [&](std::size_t i) { return get<std::uint32_t>(fragment.data() + 4 * i); };
  if (number(0) != segments)
    fail(0, "has " + std::to_string(number(0)) + " segments where pixels need " +
                std::to_string(segments));
  std::string frame;
  frame.reserve(segments * segment_size);
  for (std::size_t i = 1; i <= segments; ++i) {
    const std::size_t begin = number(i);
    const std::size_t end = i < segments ? number(i + 1) : fragment.size();
    if (begin < header_size || begin > end || end > fragment.size())
      fail(4 * i, "a segment from " + std::to_string(begin) + " to " + std::to_string(end) +
                      " is not in it");
    const std::size_t at = unpack_runs(fragment.substr(begin, end - begin), segment_size, frame);
    if (frame.size() != i * segment_size) fail(begin + at, "the runs end too early");
  }
  return frame;
}

}  // namespace loft::io
