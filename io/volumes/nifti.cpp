// SPDX-License-Identifier: MIT
#include "io/volumes/nifti.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes/file.h"
#include "io/bytes/inflate.h"
#include "io/volumes/nifti_header.h"
#include "io/volumes/outlines.h"

namespace loft::io {

namespace {

/// The first bytes of a file, unpacked into `made` where they are packed; fewer if there are no
/// more.
std::string_view first_bytes(std::string_view bytes, std::uint64_t count, std::string_view name,
                             std::string& made) {
  if (!is_gzip(bytes)) return bytes.substr(0, count);
  made = inflate_first(bytes, count, name);
  return made;
}

/// The file with the pixels of a pair, which is named as the header.
std::pair<FileBytes, std::string> read_pixel_file(const StackInput& input) {
  std::string stem = std::filesystem::path(input.name).filename().string();
  for (const std::string_view end : {".gz", ".hdr"})
    if (stem.ends_with(end)) stem.resize(stem.size() - end.size());
  for (const std::string_view end : {".img", ".img.gz"}) {
    const std::filesystem::path path = input.folder / (stem + std::string(end));
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return {FileBytes(path), path.string()};
  }
  throw InputError(input.name + ": its pixels are in a file beside it, " + stem +
                   ".img, which is not there");
}

/// Gives the volume its pixels, those of a file.
void set_pixels(NiftiHeader& header, std::string_view bytes, const std::string& name) {
  const auto size = byte_count(header.volume, header.pixels.type);
  if (!size || *size > std::numeric_limits<std::uint64_t>::max() / 2 - header.offset)
    throw InputError(header.volume.name + ": dim: more pixels than any file holds; save it again");
  if (is_gzip(bytes)) {
    header.pixels.bytes = bytes;
    return set_packed_pixels(header.volume, header.pixels, {header.offset, name, 0});
  }
  if (bytes.size() < header.offset + *size)
    throw InputError(name + ": byte " + std::to_string(bytes.size()) +
                     ": the file ends here, but its header says that pixels go on up to byte " +
                     std::to_string(header.offset + *size) + "; it was cut off, get it again");
  header.pixels.bytes = bytes.substr(header.offset);
  set_pixels(header.volume, header.pixels);
}

/// What the extensions behind a header say of labels.
std::vector<VolumeLabel> labels_behind(const NiftiHeader& header, const StackInput& input) {
  constexpr std::uint64_t enough = std::uint64_t{1} << 26;
  std::string made;
  const std::string_view bytes =
      first_bytes(input.bytes, std::min(header.offset, enough), input.name, made);
  return labels_in_xml(bytes.substr(std::min<std::uint64_t>(header.size, bytes.size())));
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
  std::string made;
  NiftiHeader header =
      read_nifti_header(first_bytes(input.bytes, nifti_header_size, input.name, made), input.name);
  std::optional<std::pair<FileBytes, std::string>> pixel_file;
  if (header.is_pair) {
    pixel_file.emplace(read_pixel_file(input));
    set_pixels(header, pixel_file->first.view(), pixel_file->second);
  } else {
    set_pixels(header, input.bytes, input.name);
    if (header.has_extensions) header.volume.labels = labels_behind(header, input);
  }
  const bool is_scaled = header.pixels.slope != 1 || header.pixels.intercept != 0;
  set_level(header.volume, options, is_real(header.pixels.type) || is_scaled);
  note_world(header.volume, "RAS");
  return trace(header.volume, options);
}

}  // namespace loft::io
