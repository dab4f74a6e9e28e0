// SPDX-License-Identifier: MIT
// Only for sources that are built with DCMTK.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/dicom/dicom_object.h"

namespace loft::io {

/// The pixels of a Segmentation, as they are or by RLE Lossless, frame by frame.
class SegPixels {
 public:
  /// For `count` frames of pixels with 1, 8 or 16 bits. Throws InputError with paths of tags where
  /// there are not so many, and for pixels that are packed in another way, by its name. Refers to
  /// the object's.
  SegPixels(DicomObject& object, std::uint16_t bits, std::uint64_t frame_pixels, std::size_t count);

  /// The values of a frame. Throws InputError where it is damaged.
  void read(std::size_t frame, std::span<double> values) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void find_fragments(std::size_t count);
  void find_bytes(std::size_t count);
  [[nodiscard]] double value(std::string_view bytes, std::uint64_t bit) const;

  DicomObject& object_;
  std::uint16_t bits_;
  std::uint64_t frame_pixels_;
  std::string_view bytes_;                   ///< those of all frames, without any between
  std::vector<std::string_view> fragments_;  ///< instead of these, one a frame
};

}  // namespace loft::io
