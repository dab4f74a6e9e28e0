// SPDX-License-Identifier: MIT
// Only for sources that are built with libtiff.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/images/image_distances.h"
#include "io/images/label_images.h"

namespace loft::io {

/// How the pixels of a page are written.
struct TiffPage {
  std::uint64_t offset = 0;  ///< of its directory
  std::size_t number = 0;    ///< from 0
  LabelImage image;
  std::uint16_t bits = 1;  ///< of a sample
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t samples = 1;  ///< of a pixel
  std::uint16_t used = 1;     ///< of these, the first ones
  bool has_alpha = false;     ///< the last one used
  bool is_separate = false;   ///< samples are in images of their own
  std::uint16_t compression = COMPRESSION_NONE;
};

/// A TIFF in memory, by libtiff, whose messages go into errors.
class TiffFile {
 public:
  /// Throws InputError for what is no TIFF or is damaged. `most_bytes` is what a page may take once
  /// it is unpacked, and libtiff at a time.
  TiffFile(std::string_view bytes, std::string name, std::uint64_t most_bytes);
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;

  /// All but previews and masks. Throws InputError for those that cannot be read.
  [[nodiscard]] std::vector<TiffPage> pages();
  /// What the first page says of distances.
  [[nodiscard]] const ImageDistances& distances() const { return distances_; }

  /// A page's pixels as label images have them.
  void read(const TiffPage& page, std::span<double> pixels);

  /// The images that follow the only page of a file of ImageJ without pages of their own; 1 if that
  /// is all.
  [[nodiscard]] std::uint64_t image_count(const TiffPage& page);
  /// One of those.
  void read_image(const TiffPage& page, std::uint64_t image, std::span<double> pixels);

 private:
  struct Close {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  };

  static tmsize_t read_bytes(thandle_t handle, void* place, tmsize_t size);
  static toff_t seek(thandle_t handle, toff_t offset, int whence);
  static toff_t size(thandle_t handle);
  static int take_error(TIFF* tiff, void* user, const char* module, const char* format,
                        va_list values);
  static int ignore(TIFF* tiff, void* user, const char* module, const char* format, va_list values);

  [[noreturn]] void fail(const std::string& what) const;
  [[nodiscard]] std::string page_name(std::size_t number) const;
  [[nodiscard]] bool is_slice() const;
  [[nodiscard]] TiffPage read_page(std::size_t number);
  void read_ink(TiffPage& page);
  void read_samples(TiffPage& page);
  void read_palette(TiffPage& page);
  void require_readable(const TiffPage& page);
  void read_distances();
  void go_to(const TiffPage& page);
  void read_strips(const TiffPage& page, std::uint16_t plane, std::span<double> pixels);
  void read_tiles(const TiffPage& page, std::uint16_t plane, std::span<double> pixels);
  void require_room(const TiffPage& page, tmsize_t size);
  [[nodiscard]] std::uint64_t image_size(const TiffPage& page) const;

  template <class Number>
  [[nodiscard]] Number tag(std::uint32_t name, Number otherwise) {
    Number value = otherwise;
    return TIFFGetFieldDefaulted(tiff_.get(), name, &value) == 1 ? value : otherwise;
  }

  std::string_view bytes_;
  std::string name_;
  std::uint64_t most_bytes_;
  std::uint64_t place_ = 0;  ///< in the bytes
  std::string message_;      ///< libtiff's first of those since the last failure
  std::unique_ptr<TIFF, Close> tiff_;
  std::vector<std::uint8_t> buffer_;
  ImageDistances distances_;
};

}  // namespace loft::io
