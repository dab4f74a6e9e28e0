// SPDX-License-Identifier: MIT
#include "io/images/png_write.h"

#include <png.h>

#include <stdexcept>

namespace loft::io {

std::string to_png(std::span<const std::uint8_t> pixels, std::size_t columns) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = PNG_FORMAT_RGBA;
  image.width = static_cast<png_uint_32>(columns);
  image.height = static_cast<png_uint_32>(pixels.size() / columns / 4);
  std::string bytes;
  png_alloc_size_t size = 0;
  for (int round = 0; round < 2; ++round) {  // the first tells how long it gets
    bytes.resize(size);
    if (png_image_write_to_memory(&image, round == 0 ? nullptr : bytes.data(), &size, 0,
                                  pixels.data(), 0, nullptr) == 0)
      throw std::runtime_error(std::string("libpng: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

bool writes_png() { return true; }

}  // namespace loft::io
