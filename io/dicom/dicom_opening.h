// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace loft::io {

/// How the elements of a DICOM data set are written.
struct DicomEncoding {
  bool is_explicit = true;  ///< each says what kind of value it has
  bool is_big_endian = false;
};

/// What is in front of the data set of a DICOM file.
struct DicomOpening {
  std::size_t begin = 0;        ///< where the data set is
  std::string transfer_syntax;  ///< its UID; empty where the file has none
  DicomEncoding encoding;       ///< as the transfer syntax says, or else as the first element looks
  bool is_deflated = false;     ///< the data set is a raw deflate stream
};

/// Reads preamble and meta information, as far as there are any. Throws InputError `name: ...` for
/// what is no DICOM file.
[[nodiscard]] DicomOpening read_dicom_opening(std::string_view bytes, std::string_view name);

/// Whether bytes are those that a data set or meta information begins with.
[[nodiscard]] bool begins_like_data_set(std::string_view bytes);

}  // namespace loft::io
