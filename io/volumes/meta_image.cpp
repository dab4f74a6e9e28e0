// SPDX-License-Identifier: MIT
#include "io/volumes/meta_image.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes/file.h"
#include "io/volumes/file_beside.h"
#include "io/volumes/meta_image_header.h"
#include "io/volumes/outlines.h"

namespace loft::io {

namespace {

using Encoding = MetaImageHeader::Encoding;

/// A file that pixels are in, from some byte on.
struct PixelFile {
  std::string name;
  std::string_view bytes;
  std::uint64_t offset = 0;
};

/// What is the pixels' of a file, whose offset becomes theirs; `size` bytes once it is unpacked.
void find_pixels(const MetaImageHeader& header, std::uint64_t size, PixelFile& file) {
  std::uint64_t needed = header.encoding == Encoding::raw ? size : 0;
  if (header.encoding == Encoding::zlib) needed = header.packed_size.value_or(0);
  const std::uint64_t there = file.bytes.size();
  const std::uint64_t skip = header.skip ? *header.skip : there - std::min(needed, there);
  if (skip > there || there - skip < needed)
    throw InputError(file.name + ": byte " + std::to_string(file.offset + there) +
                     ": the file ends here, but its header says " + std::to_string(skip) +
                     " bytes in front of " + std::to_string(needed) +
                     " bytes of pixels; it was cut off, get it again");
  file.bytes = file.bytes.substr(skip, needed == 0 ? std::string_view::npos : needed);
  file.offset += skip;
}

/// Gives a volume its pixels, those of a file, or what is put into `made` of them.
void set_pixels(const MetaImageHeader& header, PixelFile file, Volume& volume, std::string& made) {
  const auto size = byte_count(volume, header.pixels.type);
  if (!size) throw InputError(volume.name + ": DimSize: more pixels than any file holds");
  find_pixels(header, *size, file);
  RawPixels pixels = header.pixels;
  pixels.bytes = file.bytes;
  if (header.encoding == Encoding::zlib)
    return set_packed_pixels(volume, pixels, {0, file.name, file.offset});
  if (header.encoding == Encoding::text) {
    made = pixels_in_text(file.bytes, *size / size_of(pixels.type), file.name);
    pixels = {.bytes = made, .type = PixelType::f64, .order = std::endian::native};
  }
  set_pixels(volume, pixels);
}

/// Pixels in files of some slices each, of which one is open.
class PixelFiles {
 public:
  PixelFiles(const StackInput& input, const MetaImageHeader& header)
      : input_(input), header_(header), part_(header.volume) {
    const std::uint64_t slices = std::uint64_t{part_.slices} * part_.layers;
    part_.slices = static_cast<std::uint32_t>(slices / header.files.size());
    part_.layers = 1;
    open(0);  // it may be too short: before memory is taken for slices
  }

  void read(std::uint32_t slice, std::uint32_t layer, std::span<double> pixels) {
    const std::uint64_t place = std::uint64_t{layer} * header_.volume.slices + slice;
    open(place / part_.slices);
    part_.read(static_cast<std::uint32_t>(place % part_.slices), 0, pixels);
  }

 private:
  void open(std::uint64_t number) {
    if (file_ && number == number_) return;
    const std::string& name = header_.files[number];
    file_.reset();
    file_.emplace(read_file_beside(input_, "ElementDataFile", name));
    number_ = number;
    set_pixels(header_, {(input_.folder / name).string(), file_->view(), 0}, part_, made_);
  }

  const StackInput& input_;
  const MetaImageHeader& header_;
  Volume part_;  // what is in one file
  std::optional<FileBytes> file_;
  std::uint64_t number_ = 0;
  std::string made_;
};

}  // namespace

bool begins_like_meta_image(std::string_view bytes) {
  for (const std::string_view field : {"ObjectType", "NDims"})
    if (bytes.starts_with(field))
      return bytes.substr(field.size(), 4).find('=') != std::string_view::npos;
  return false;
}

Stack read_meta_image(const StackInput& input, const ReadOptions& options) {
  const MetaImageHeader header = read_meta_image_header(input.bytes, input.name);
  Volume volume = header.volume;
  std::string made;
  std::optional<FileBytes> file;
  if (header.files.size() > 1) {
    const auto files = std::make_shared<PixelFiles>(input, header);
    volume.read = [files](std::uint32_t slice, std::uint32_t layer, std::span<double> pixels) {
      files->read(slice, layer, pixels);
    };
  } else if (header.files.size() == 1) {
    file.emplace(read_file_beside(input, "ElementDataFile", header.files[0]));
    const std::string name = (input.folder / header.files[0]).string();
    set_pixels(header, {name, file->view(), 0}, volume, made);
  } else {
    set_pixels(header, {input.name, input.bytes.substr(header.size), header.size}, volume, made);
  }
  set_level(volume, options, is_real(header.pixels.type));
  note_world(volume, "LPS");
  return trace(volume, options);
}

}  // namespace loft::io
