// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/volumes/raw_pixels.h"
#include "io/volumes/volume.h"

namespace loft::io {

/// What the header of an NRRD file says.
struct NrrdHeader {
  enum class Encoding { raw, gzip, text };

  Volume volume;     ///< all but its pixels and labels
  RawPixels pixels;  ///< all but their bytes
  Encoding encoding = Encoding::raw;
  std::string data_file;  ///< beside the header; empty: pixels follow it
  std::uint64_t line_skip = 0;
  std::uint64_t byte_skip = 0;
  std::uint64_t size = 0;  ///< of the header
  std::string space;       ///< `LPS`, `RAS`, ...; empty where it does not say
  std::map<std::string, std::string> pairs = {};  ///< of the lines `key:=value`
};

/// Throws InputError that names the line or field.
[[nodiscard]] NrrdHeader read_nrrd_header(std::string_view bytes, const std::string& name);

/// The segments that 3D Slicer has written into a header's pairs, for a volume of so many layers.
[[nodiscard]] std::vector<VolumeLabel> segments_of(const NrrdHeader& header);

}  // namespace loft::io
