// SPDX-License-Identifier: MIT
#include "io/images/png_image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "io/bytes/little_endian.h"
#include "io/bytes/text.h"
#include "io/images/png.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

struct Handles {
  Handles() = default;
  ~Handles() { png_destroy_read_struct(&png, &info, nullptr); }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  png_structp png = nullptr;
  png_infop info = nullptr;
};

/// A PNG in memory, by libpng. Its errors come by longjmp, which must pass nothing that has to be
/// destroyed: what calls libpng is in steps that have none of it.
class PngFile {
 public:
  PngFile(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    if (!begins_like_png(bytes)) fail("byte 0: is no PNG");
    handles_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, take_error, ignore);
    if (png() != nullptr) handles_.info = png_create_info_struct(png());
    if (info() == nullptr) fail("libpng has no memory left");
    attempt([](PngFile& file) {
      constexpr png_uint_32 most = 1U << 28U;
      png_set_user_limits(file.png(), most, most);
      png_set_chunk_malloc_max(file.png(), std::max<std::size_t>(file.bytes_.size(), 1U << 16U));
      png_set_read_fn(file.png(), &file, read_bytes);
      png_read_info(file.png(), file.info());
    });
  }
  [[nodiscard]] PngHeader header() {
    PngHeader header;
    header.image.name = name_;
    header.image.columns = png_get_image_width(png(), info());
    header.image.rows = png_get_image_height(png(), info());
    require_room();
    const unsigned colours = png_get_color_type(png(), info());
    if (colours == PNG_COLOR_TYPE_PALETTE) {
      header.image.ink = Ink::palette;
      header.image.palette = palette();
    } else if ((colours & PNG_COLOR_MASK_COLOR) != 0) {
      header.image.ink = Ink::colour;
    } else {
      header.image.white = static_cast<double>((1U << png_get_bit_depth(png(), info())) - 1);
    }
    set_distances(header);
    return header;
  }

  void read(const LabelImage& image, std::span<double> pixels) {
    find_clear_grey();
    attempt([](PngFile& file) {
      png_set_packing(file.png());  // a byte for each, as it is
      if (file.is_colour()) {
        png_set_scale_16(file.png());
        png_set_tRNS_to_alpha(file.png());
      }
      png_set_interlace_handling(file.png());
      png_read_update_info(file.png(), file.info());
      file.row_size_ = png_get_rowbytes(file.png(), file.info());
      file.channels_ = png_get_channels(file.png(), file.info());
      file.sample_size_ = png_get_bit_depth(file.png(), file.info()) == 16 ? 2 : 1;
    });
    const std::size_t needed = std::size_t{image.columns} * channels_ * sample_size_;
    if (row_size_ < needed) fail("its rows are shorter than its pixels");
    content_.resize(row_size_ * image.rows);
    rows_.resize(image.rows);
    for (std::size_t y = 0; y < rows_.size(); ++y) rows_[y] = content_.data() + y * row_size_;
    attempt([](PngFile& file) {
      png_read_image(file.png(), file.rows_.data());
      png_read_end(file.png(), nullptr);
    });
    for (std::size_t y = 0; y < rows_.size(); ++y)
      take_row(rows_[y], pixels.subspan(y * image.columns, image.columns));
  }

 private:
  [[noreturn]] static void take_error(png_structp png, png_const_charp message) {
    auto& file = *static_cast<PngFile*>(png_get_error_ptr(png));
    std::strncpy(file.message_.data(), message, file.message_.size() - 1);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}

  static void read_bytes(png_structp png, png_bytep place, std::size_t size) {
    auto& file = *static_cast<PngFile*>(png_get_io_ptr(png));
    if (size > file.bytes_.size() - file.place_) png_error(png, "the file ends too early");
    std::memcpy(place, file.bytes_.data() + file.place_, size);
    file.place_ += size;
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  void attempt(void (*step)(PngFile&)) {
    if (setjmp(png_jmpbuf(png())) != 0)
      fail("byte " + std::to_string(place_) + ": libpng says: " + one_line(message_.data()) +
           "; the file is damaged or was cut off: get it again");
    step(*this);
  }

  [[nodiscard]] png_structp png() const { return handles_.png; }
  [[nodiscard]] png_infop info() const { return handles_.info; }

  [[nodiscard]] bool is_colour() const {
    const unsigned colours = png_get_color_type(png(), info());
    return colours != PNG_COLOR_TYPE_PALETTE && (colours & PNG_COLOR_MASK_COLOR) != 0;
  }

  /// As many pixels as claimed can be in a file of that size.
  void require_room() const {
    constexpr std::uint64_t best = 1100;  // deflate cannot pack more into a byte
    const std::uint64_t row = png_get_rowbytes(png(), info());
    const std::uint64_t rows = png_get_image_height(png(), info());
    if (row > best * bytes_.size() / std::max<std::uint64_t>(rows, 1))
      fail("byte 16: is said to be of " + std::to_string(png_get_image_width(png(), info())) +
           " x " + std::to_string(rows) +
           " pixels, which so small a file cannot hold; it was cut off, or its sizes are wrong");
  }

  [[nodiscard]] std::vector<PaletteColour> palette() const {
    png_colorp colours = nullptr;
    int count = 0;
    png_get_PLTE(png(), info(), &colours, &count);
    png_bytep alphas = nullptr;
    int alpha_count = 0;
    png_get_tRNS(png(), info(), &alphas, &alpha_count, nullptr);
    std::vector<PaletteColour> palette;
    for (int i = 0; i < count; ++i)
      palette.push_back({{colours[i].red, colours[i].green, colours[i].blue},
                         alphas != nullptr && i < alpha_count && alphas[i] == 0});
    return palette;
  }

  void set_distances(PngHeader& header) const {
    png_uint_32 x = 0;
    png_uint_32 y = 0;
    int unit = 0;
    if (png_get_pHYs(png(), info(), &x, &y, &unit) == 0 || unit != PNG_RESOLUTION_METER) return;
    constexpr double mm = 1000;
    if (x > 0 && y > 0) {
      header.x_distance = mm / x;
      header.y_distance = mm / y;
    }
  }

  /// The one value of grey that is clear, if there is one.
  void find_clear_grey() {
    png_color_16p clear = nullptr;
    const bool is_grey = png_get_color_type(png(), info()) == PNG_COLOR_TYPE_GRAY;
    if (is_grey && png_get_tRNS(png(), info(), nullptr, nullptr, &clear) != 0 && clear != nullptr)
      clear_grey_ = clear->gray;
  }

  [[nodiscard]] double sample(const png_byte* row, std::size_t index) const {
    if (sample_size_ == 1) return row[index];
    return get<std::uint16_t>(reinterpret_cast<const char*>(row) + 2 * index, std::endian::big);
  }

  void take_row(const png_byte* row, std::span<double> pixels) const {
    const bool has_alpha = channels_ % 2 == 0;
    std::size_t index = 0;
    for (double& pixel : pixels) {
      pixel = sample(row, index);
      if (channels_ >= 3)
        pixel = pixel * 65536 + sample(row, index + 1) * 256 + sample(row, index + 2);
      if (has_alpha && sample(row, index + channels_ - 1) == 0) pixel = 0;
      if (pixel == clear_grey_) pixel = 0;
      index += channels_;
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  Handles handles_;
  std::size_t place_ = 0;
  std::array<char, 100> message_{};
  std::size_t row_size_ = 0;
  std::size_t channels_ = 1;
  std::size_t sample_size_ = 1;
  std::optional<double> clear_grey_;
  std::vector<png_byte> content_;
  std::vector<png_bytep> rows_;
};

}  // namespace

PngHeader read_png_header(std::string_view bytes, const std::string& name) {
  return PngFile(bytes, name).header();
}

void read_png_pixels(std::string_view bytes, const PngHeader& header, std::span<double> pixels) {
  PngFile(bytes, header.image.name).read(header.image, pixels);
}

}  // namespace loft::io
