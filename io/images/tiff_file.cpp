// SPDX-License-Identifier: MIT
#include "io/images/tiff_file.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <utility>

#include "io/bytes/text.h"
#include "io/images/tiff_samples.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

struct Compression {
  std::uint16_t number;
  std::string_view name;
};
/// Those that give back what was packed, and never much more than they have.
constexpr std::array lossless{COMPRESSION_NONE,    COMPRESSION_LZW,      COMPRESSION_ADOBE_DEFLATE,
                              COMPRESSION_DEFLATE, COMPRESSION_PACKBITS, COMPRESSION_LZMA,
                              COMPRESSION_ZSTD};
constexpr std::array others{
    Compression{COMPRESSION_JPEG, "JPEG, which changes labels"},
    Compression{COMPRESSION_OJPEG, "JPEG, which changes labels"},
    Compression{COMPRESSION_JP2000, "JPEG 2000"},
    Compression{COMPRESSION_WEBP, "WebP"},
    Compression{COMPRESSION_LERC, "LERC"},
    Compression{COMPRESSION_CCITTFAX3, "fax group 3"},
    Compression{COMPRESSION_CCITTFAX4, "fax group 4"},
};

std::string described(std::uint16_t compression) {
  const auto found = std::ranges::find(others, compression, &Compression::number);
  return found != others.end() ? std::string(found->name) : "number " + std::to_string(compression);
}

SampleRole role_of(const TiffPage& page, std::uint16_t sample) {
  constexpr std::array colours{SampleRole::red, SampleRole::green, SampleRole::blue};
  if (page.has_alpha && sample + 1 == page.used) return SampleRole::alpha;
  return page.image.ink == Ink::colour ? colours[sample] : SampleRole::value;
}

/// Of one plane of samples, or of all.
void take_row(const TiffPage& page, std::uint16_t plane, const std::uint8_t* bytes,
              std::span<double> pixels, std::endian order = std::endian::native) {
  SampleRow row{.bytes = bytes,
                .bits = page.bits,
                .is_signed = page.format == SAMPLEFORMAT_INT,
                .is_real = page.format == SAMPLEFORMAT_IEEEFP,
                .order = order,
                .step = page.is_separate ? 1U : page.samples};
  if (page.is_separate) return take_samples(row, 0, role_of(page, plane), pixels);
  for (std::uint16_t sample = 0; sample < page.used; ++sample)
    take_samples(row, sample, role_of(page, sample), pixels);
}

}  // namespace

TiffFile::TiffFile(std::string_view bytes, std::string name, std::uint64_t most_bytes)
    : bytes_(bytes), name_(std::move(name)), most_bytes_(most_bytes) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(most_bytes));
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), take_error, this);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore, this);
  const auto no_write = [](thandle_t, void*, tmsize_t) -> tmsize_t { return 0; };
  const auto no_close = [](thandle_t) { return 0; };
  tiff_.reset(TIFFClientOpenExt(name_.c_str(), "rm", this, read_bytes, no_write, seek, no_close,
                                size, nullptr, nullptr, options.get()));
  if (!tiff_) fail("is no TIFF that can be read");
  read_distances();
}

tmsize_t TiffFile::read_bytes(thandle_t handle, void* place, tmsize_t size) {
  auto& file = *static_cast<TiffFile*>(handle);
  const std::uint64_t begin = std::min<std::uint64_t>(file.place_, file.bytes_.size());
  const auto count = std::min<std::uint64_t>(
      static_cast<std::uint64_t>(std::max<tmsize_t>(size, 0)), file.bytes_.size() - begin);
  std::copy_n(file.bytes_.data() + begin, count, static_cast<char*>(place));
  file.place_ = begin + count;
  return static_cast<tmsize_t>(count);
}

toff_t TiffFile::seek(thandle_t handle, toff_t offset, int whence) {
  auto& file = *static_cast<TiffFile*>(handle);
  if (whence == SEEK_CUR) offset += file.place_;
  if (whence == SEEK_END) offset += file.bytes_.size();
  file.place_ = offset;
  return offset;
}

toff_t TiffFile::size(thandle_t handle) { return static_cast<TiffFile*>(handle)->bytes_.size(); }

int TiffFile::take_error(TIFF*, void* user, const char*, const char* format, va_list values) {
  auto& file = *static_cast<TiffFile*>(user);
  if (!file.message_.empty()) return 1;  // what follows is of less use
  std::array<char, 200> text{};
  std::vsnprintf(text.data(), text.size(), format, values);
  file.message_ = one_line(text.data());
  return 1;
}

int TiffFile::ignore(TIFF*, void*, const char*, const char*, va_list) { return 1; }

void TiffFile::fail(const std::string& what) const {
  throw InputError(name_ + ": " + what + (message_.empty() ? "" : "; libtiff says: " + message_) +
                   "; the file is damaged or was cut off: get it again");
}

std::string TiffFile::page_name(std::size_t number) const {
  return name_ + ": page " + std::to_string(number + 1);
}

bool TiffFile::is_slice() const {
  std::uint32_t kind = 0;
  static_cast<void>(TIFFGetField(tiff_.get(), TIFFTAG_SUBFILETYPE, &kind));
  return (kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) == 0;
}

std::vector<TiffPage> TiffFile::pages() {
  constexpr std::size_t smallest = 48;  // of directories
  std::vector<TiffPage> pages;
  for (std::size_t number = 0;; ++number) {
    if (number > bytes_.size() / smallest) fail("has more pages than its bytes can hold");
    if (is_slice()) pages.push_back(read_page(number));
    if (TIFFLastDirectory(tiff_.get()) != 0) break;
    message_.clear();
    if (TIFFReadDirectory(tiff_.get()) != 1)
      fail("page " + std::to_string(number + 2) + " cannot be read");
  }
  if (pages.empty()) throw InputError(name_ + ": has previews or masks only; give the whole image");
  return pages;
}

TiffPage TiffFile::read_page(std::size_t number) {
  TiffPage page;
  page.number = number;
  page.offset = TIFFCurrentDirOffset(tiff_.get());
  page.image.name = page_name(number);
  page.image.columns = tag<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
  page.image.rows = tag<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
  page.compression = tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  page.is_separate =
      tag<std::uint16_t>(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
  read_samples(page);
  read_ink(page);
  require_readable(page);
  return page;
}

void TiffFile::read_samples(TiffPage& page) {
  page.bits = tag<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
  page.samples = tag<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
  page.format = tag<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  if (page.format == SAMPLEFORMAT_VOID) page.format = SAMPLEFORMAT_UINT;
  constexpr std::array whole{1, 2, 4, 8, 16, 32, 64};
  const bool is_whole = std::ranges::find(whole, page.bits) != whole.end();
  const bool is_known = (page.format == SAMPLEFORMAT_UINT && is_whole) ||
                        (page.format == SAMPLEFORMAT_INT && is_whole && page.bits >= 8) ||
                        (page.format == SAMPLEFORMAT_IEEEFP && is_whole && page.bits >= 32);
  if (!is_known)
    throw InputError(page.image.name + ": pixels of " + std::to_string(page.bits) +
                     " bits and format " + std::to_string(page.format) +
                     " cannot be read; save labels with 8, 16 or 32 bits");
}

/// What the samples are, and which of them count.
void TiffFile::read_ink(TiffPage& page) {
  const auto ink = tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  std::uint16_t colours = 1;
  if (ink == PHOTOMETRIC_PALETTE) {
    page.image.ink = Ink::palette;
    read_palette(page);
  } else if (ink == PHOTOMETRIC_RGB) {
    page.image.ink = Ink::colour;
    colours = 3;
  } else if (ink != PHOTOMETRIC_MINISBLACK && ink != PHOTOMETRIC_MINISWHITE) {
    throw InputError(page.image.name + ": is neither grey nor of a palette nor RGB (photometric " +
                     std::to_string(ink) + "); save it as one of these");
  }
  std::uint16_t count = 0;
  std::uint16_t* kinds = nullptr;
  if (TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds) != 1) count = 0;
  page.has_alpha = page.samples > colours && count > 0 && kinds != nullptr &&
                   kinds[0] != EXTRASAMPLE_UNSPECIFIED;
  page.used = static_cast<std::uint16_t>(colours + (page.has_alpha ? 1 : 0));
  const bool is_one = page.samples == page.used || (colours == 3 && page.samples > page.used);
  if (!is_one)
    throw InputError(page.image.name + ": pixels have " + std::to_string(page.samples) +
                     " values where " + std::to_string(colours) + (colours == 1 ? " is" : " are") +
                     " read; save one channel of labels");
  if (page.image.ink != Ink::grey && page.format != SAMPLEFORMAT_UINT)
    throw InputError(page.image.name +
                     ": its colours are no whole numbers from 0 on; save it with 8 bits");
}

void TiffFile::read_palette(TiffPage& page) {
  std::array<std::uint16_t*, 3> parts{};
  constexpr std::uint16_t most_bits = 8;
  if (page.bits > most_bits ||
      TIFFGetField(tiff_.get(), TIFFTAG_COLORMAP, &parts[0], &parts[1], &parts[2]) != 1)
    throw InputError(page.image.name +
                     ": its palette is missing, or has more than 256 colours; save it in grey");
  const std::size_t count = std::size_t{1} << page.bits;
  std::uint16_t largest = 0;
  for (const std::uint16_t* const part : parts)
    largest = std::max(largest, *std::max_element(part, part + count));
  // Some programs write 8 bits where there should be 16.
  const unsigned shift = largest > 255 ? 8 : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = [&](std::size_t c) {
      return static_cast<std::uint8_t>(parts[c][i] >> shift);
    };
    page.image.palette.push_back({{part(0), part(1), part(2)}, false});
  }
}

void TiffFile::require_readable(const TiffPage& page) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(page.image.name + ": " + what);
  };
  if (page.image.columns == 0 || page.image.rows == 0) refuse("has no pixels; save it again");
  if (std::ranges::find(lossless, page.compression) == lossless.end())
    refuse("is compressed by " + described(page.compression) +
           "; save it without compression, or with LZW or deflate");
  if (TIFFIsCODECConfigured(page.compression) == 0)
    refuse("is compressed by " + described(page.compression) +
           ", which this build of libtiff cannot unpack; save it with LZW or deflate");
  if (tag<std::uint32_t>(TIFFTAG_IMAGEDEPTH, 1) > 1)
    refuse("has depth in one page; save a page for each slice");
  const std::uint64_t row = (std::uint64_t{page.image.columns} * page.bits * page.samples + 7) / 8;
  const std::uint64_t most = page.compression == COMPRESSION_NONE ? bytes_.size() : most_bytes_;
  if (row > most / page.image.rows)
    refuse("is said to be of " + std::to_string(page.image.columns) + " x " +
           std::to_string(page.image.rows) +
           " pixels, which are more than the file can hold; it "
           "was cut off, or its sizes are wrong");
}

void TiffFile::read_distances() {
  char* text = nullptr;
  if (TIFFGetField(tiff_.get(), TIFFTAG_IMAGEDESCRIPTION, &text) != 1) text = nullptr;
  TiffResolution resolution;
  resolution.x = tag<float>(TIFFTAG_XRESOLUTION, 0);
  resolution.y = tag<float>(TIFFTAG_YRESOLUTION, 0);
  resolution.unit = tag<std::uint16_t>(TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
  distances_ = read_image_distances(text == nullptr ? "" : text, resolution);
}

void TiffFile::go_to(const TiffPage& page) {
  message_.clear();
  if (TIFFCurrentDirOffset(tiff_.get()) == page.offset) return;
  if (TIFFSetSubDirectory(tiff_.get(), page.offset) != 1)
    fail("page " + std::to_string(page.number + 1) + " cannot be read");
}

void TiffFile::require_room(const TiffPage& page, tmsize_t size) {
  if (size <= 0 || static_cast<std::uint64_t>(size) > most_bytes_)
    fail("page " + std::to_string(page.number + 1) +
         " has strips or tiles of more bytes than the file can hold");
  buffer_.resize(static_cast<std::size_t>(size));
}

void TiffFile::read(const TiffPage& page, std::span<double> pixels) {
  go_to(page);
  const std::uint16_t planes = page.is_separate ? page.used : 1;
  for (std::uint16_t plane = 0; plane < planes; ++plane) {
    if (TIFFIsTiled(tiff_.get()) != 0)
      read_tiles(page, plane, pixels);
    else
      read_strips(page, plane, pixels);
  }
}

void TiffFile::read_strips(const TiffPage& page, std::uint16_t plane, std::span<double> pixels) {
  TIFF* const tiff = tiff_.get();
  const std::uint32_t rows = page.image.rows;
  const auto told = tag<std::uint32_t>(TIFFTAG_ROWSPERSTRIP, rows);
  const std::uint32_t step = std::clamp<std::uint32_t>(told, 1, rows);
  const tmsize_t row_size = TIFFScanlineSize(tiff);
  require_room(page, TIFFStripSize(tiff));
  for (std::uint32_t first = 0; first < rows; first += std::min(step, rows - first)) {
    const std::uint32_t count = std::min(step, rows - first);
    const tmsize_t needed = row_size * static_cast<tmsize_t>(count);
    if (needed > static_cast<tmsize_t>(buffer_.size()) ||
        TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, first, plane), buffer_.data(), needed) !=
            needed)
      fail("page " + std::to_string(page.number + 1) + ": row " + std::to_string(first) +
           " and those behind cannot be read");
    for (std::uint32_t row = 0; row < count; ++row)
      take_row(page, plane, buffer_.data() + row * static_cast<std::size_t>(row_size),
               pixels.subspan(std::size_t{first + row} * page.image.columns, page.image.columns));
  }
}

void TiffFile::read_tiles(const TiffPage& page, std::uint16_t plane, std::span<double> pixels) {
  TIFF* const tiff = tiff_.get();
  const auto [columns, rows] = std::pair(page.image.columns, page.image.rows);
  const auto width = tag<std::uint32_t>(TIFFTAG_TILEWIDTH, 0);
  const auto height = tag<std::uint32_t>(TIFFTAG_TILELENGTH, 0);
  const auto row_size = static_cast<std::size_t>(TIFFTileRowSize(tiff));
  const tmsize_t size = TIFFTileSize(tiff);
  require_room(page, size);
  if (width == 0 || height == 0 || row_size * height > buffer_.size())
    fail("page " + std::to_string(page.number + 1) + " has tiles of no size");
  for (std::uint64_t y = 0; y < rows; y += height) {
    for (std::uint64_t x = 0; x < columns; x += width) {
      const std::uint32_t tile = TIFFComputeTile(tiff, static_cast<std::uint32_t>(x),
                                                 static_cast<std::uint32_t>(y), 0, plane);
      if (TIFFReadEncodedTile(tiff, tile, buffer_.data(), size) != size)
        fail("page " + std::to_string(page.number + 1) + ": the tile at (" + std::to_string(x) +
             ", " + std::to_string(y) + ") cannot be read");
      const std::uint64_t count = std::min<std::uint64_t>(width, columns - x);
      for (std::uint64_t row = y; row < std::min<std::uint64_t>(y + height, rows); ++row)
        take_row(page, plane, buffer_.data() + (row - y) * row_size,
                 pixels.subspan(row * columns + x, count));
    }
  }
}

/// In bytes, of one that is not packed.
std::uint64_t TiffFile::image_size(const TiffPage& page) const {
  return std::uint64_t{page.image.columns} * page.image.rows * page.samples * page.bits / 8;
}

std::uint64_t TiffFile::image_count(const TiffPage& page) {
  TIFF* const tiff = tiff_.get();
  go_to(page);
  if (!distances_.is_image_j || distances_.images < 2) return 1;
  if (page.compression != COMPRESSION_NONE || page.is_separate || page.bits < 8 ||
      TIFFIsTiled(tiff) != 0)
    return 1;
  const std::uint32_t strips = TIFFNumberOfStrips(tiff);
  for (std::uint32_t i = 1; i < strips; ++i)
    if (TIFFGetStrileOffset(tiff, i) !=
        TIFFGetStrileOffset(tiff, i - 1) + TIFFGetStrileByteCount(tiff, i - 1))
      return 1;
  const std::uint64_t begin = TIFFGetStrileOffset(tiff, 0);
  if (begin > bytes_.size() || distances_.images > (bytes_.size() - begin) / image_size(page))
    throw InputError(name_ + ": its description says " + std::to_string(distances_.images) +
                     " images, which are " + std::to_string(image_size(page)) +
                     " bytes each from byte " + std::to_string(begin) + " on, but there are " +
                     std::to_string(bytes_.size()) + "; it was cut off, get it again");
  return distances_.images;
}

void TiffFile::read_image(const TiffPage& page, std::uint64_t image, std::span<double> pixels) {
  go_to(page);
  const std::uint64_t begin = TIFFGetStrileOffset(tiff_.get(), 0) + image * image_size(page);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(bytes_.data()) + begin;
  const std::endian order =
      TIFFIsBigEndian(tiff_.get()) != 0 ? std::endian::big : std::endian::little;
  take_row(page, 0, bytes, pixels, order);
}

}  // namespace loft::io
