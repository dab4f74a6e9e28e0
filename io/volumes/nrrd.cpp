// SPDX-License-Identifier: MIT
#include "io/volumes/nrrd.h"

#include <optional>
#include <string>

#include "io/volumes/file_beside.h"
#include "io/volumes/nrrd_header.h"
#include "io/volumes/outlines.h"

namespace loft::io {

namespace {

/// The file with the pixels, which is beside the header.
FileBytes read_data_file(const StackInput& input, const std::string& name) {
  if (name == "LIST" || name.find('%') != std::string::npos)
    throw InputError(input.name +
                     ": data file: pixels in several files cannot be read; save it as one");
  return read_file_beside(input, "data file", name);
}

/// What is behind some lines and bytes.
std::string_view skipped(std::string_view bytes, const NrrdHeader& header) {
  for (std::uint64_t i = 0; i < header.line_skip; ++i) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos)
      throw InputError(header.volume.name + ": line skip: the data have fewer lines");
    bytes.remove_prefix(end + 1);
  }
  if (header.byte_skip > bytes.size())
    throw InputError(header.volume.name + ": byte skip: the data have fewer bytes");
  return bytes.substr(header.byte_skip);
}

/// Gives the volume its pixels: those of the file, or what is put into `made`.
void set_pixels(NrrdHeader& header, std::string_view data, const std::string& data_name,
                std::uint64_t offset, std::string& made) {
  const std::string& name = header.volume.name;
  const auto size = byte_count(header.volume, header.pixels.type);
  if (!size) throw InputError(name + ": sizes: more pixels than any file holds");
  if (header.encoding == NrrdHeader::Encoding::text) {
    made = pixels_in_text(data, *size / size_of(header.pixels.type), name);
    header.pixels.type = PixelType::f64;
    header.pixels.order = std::endian::native;
    data = made;
  } else if (header.encoding == NrrdHeader::Encoding::gzip) {
    header.pixels.bytes = data;
    return set_packed_pixels(header.volume, header.pixels, {0, data_name, offset});
  } else if (data.size() < *size) {
    throw InputError(name + ": sizes: pixels take " + std::to_string(*size) + " bytes, but only " +
                     std::to_string(data.size()) +
                     " are there; the file was cut off, get it again");
  }
  header.pixels.bytes = data;
  set_pixels(header.volume, header.pixels);
}

}  // namespace

bool begins_like_nrrd(std::string_view bytes) { return bytes.starts_with("NRRD000"); }

Stack read_nrrd(const StackInput& input, const ReadOptions& options) {
  if (!begins_like_nrrd(input.bytes))
    throw InputError(input.name + ": byte 0: does not begin with NRRD000; save it again as .nrrd");
  NrrdHeader header = read_nrrd_header(input.bytes, input.name);
  std::optional<FileBytes> data_file;
  std::string_view data = input.bytes.substr(header.size);
  std::uint64_t offset = header.size;
  std::string data_name = input.name;
  if (!header.data_file.empty()) {
    data_file.emplace(read_data_file(input, header.data_file));
    data = data_file->view();
    data_name = (input.folder / header.data_file).string();
    offset = 0;
  }
  const std::string_view behind = skipped(data, header);
  offset += data.size() - behind.size();
  std::string made;
  const bool is_real_type = is_real(header.pixels.type);
  set_pixels(header, behind, data_name, offset, made);
  header.volume.labels = segments_of(header);
  set_level(header.volume, options, is_real_type);
  if (!header.space.empty()) note_world(header.volume, header.space);
  return trace(header.volume, options);
}

}  // namespace loft::io
