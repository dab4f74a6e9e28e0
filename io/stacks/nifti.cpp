// SPDX-License-Identifier: MIT
#include "io/stacks/nifti.h"

#include <algorithm>
#include <string>
#include <utility>

#include "io/bytes/file.h"
#include "io/bytes/inflate.h"
#include "io/stacks/nifti_header.h"
#include "io/volumes/outlines.h"

namespace loft::io {

namespace {

/// A file's bytes up to some place, unpacked where they are packed.
class Unpacked {
 public:
  Unpacked(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  /// The first ones; fewer if there are no more.
  std::string_view first(std::uint64_t count) {
    if (!is_gzip(bytes_)) return bytes_.substr(0, count);
    unpacked_ = inflate_first(bytes_, count, name_);
    return unpacked_;
  }
  /// All up to there.
  std::string_view all(std::uint64_t count) {
    if (is_gzip(bytes_)) {
      unpacked_ = inflate_all(bytes_, count, name_);
      return unpacked_;
    }
    if (bytes_.size() < count)
      throw InputError(std::string(name_) + ": byte " + std::to_string(bytes_.size()) +
                       ": the file ends here, but its header says that pixels go on up to byte " +
                       std::to_string(count) + "; it was cut off, get it again");
    return bytes_.substr(0, count);
  }

 private:
  std::string_view bytes_;
  std::string_view name_;
  std::string unpacked_;
};

/// The file with the pixels of a pair, which is named as the header.
std::pair<std::string, std::string> read_pixel_file(const StackInput& input) {
  std::string stem = std::filesystem::path(input.name).filename().string();
  for (const std::string_view end : {".gz", ".hdr"})
    if (stem.ends_with(end)) stem.resize(stem.size() - end.size());
  for (const std::string_view end : {".img", ".img.gz"}) {
    const std::filesystem::path path = input.folder / (stem + std::string(end));
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return {read_file(path), path.string()};
  }
  throw InputError(input.name + ": its pixels are in a file beside it, " + stem +
                   ".img, which is not there");
}

std::uint64_t end_of_pixels(const NiftiHeader& header) {
  const auto size = byte_count(header.volume, header.pixels.type);
  if (!size || *size > std::numeric_limits<std::uint64_t>::max() / 2 - header.offset)
    throw InputError(header.volume.name + ": dim: more pixels than any file holds; save it again");
  return header.offset + *size;
}

}  // namespace

bool begins_like_nifti(std::string_view bytes) {
  if (!is_gzip(bytes)) return is_nifti_header(bytes);
  try {
    return is_nifti_header(inflate_first(bytes, nifti_header_size, ""));
  } catch (const InputError&) {
    return false;
  }
}

Stack read_nifti(const StackInput& input, const ReadOptions& options) {
  Unpacked file(input.bytes, input.name);
  NiftiHeader header = read_nifti_header(file.first(nifti_header_size), input.name);
  const std::uint64_t end = end_of_pixels(header);

  std::pair<std::string, std::string> pixel_file;
  if (header.is_pair) pixel_file = read_pixel_file(input);
  Unpacked pixels(pixel_file.first, pixel_file.second);
  const std::string_view bytes = header.is_pair ? pixels.all(end) : file.all(end);
  header.pixels.bytes = bytes.substr(header.offset);
  set_pixels(header.volume, header.pixels);
  if (!header.is_pair && header.has_extensions)
    header.volume.labels = labels_in_xml(bytes.substr(header.size, header.offset - header.size));
  const bool is_scaled = header.pixels.slope != 1 || header.pixels.intercept != 0;
  set_level(header.volume, options, is_real(header.pixels.type) || is_scaled);
  note_world(header.volume, "RAS");
  return trace(header.volume, options);
}

}  // namespace loft::io
