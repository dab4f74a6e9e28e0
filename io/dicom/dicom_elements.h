// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/dicom/dicom_opening.h"

namespace loft::io {

/// What names an element of a DICOM data set.
struct DicomTag {
  std::uint16_t group = 0;
  std::uint16_t number = 0;

  friend bool operator==(const DicomTag&, const DicomTag&) = default;
};

/// `(3006,0050)`.
[[nodiscard]] std::string to_text(DicomTag tag);

/// The head of an element, and where its value begins.
struct DicomElement {
  DicomTag tag;
  std::string_view kind;     ///< its two letters, `SQ`; empty where the encoding has none
  std::uint32_t length = 0;  ///< as it claims, or undefined_length
  std::size_t value = 0;     ///< byte offset
};

/// Up to a delimiter.
inline constexpr std::uint32_t undefined_length = 0xffffffff;

/// The head of the element at a byte offset; none where there is not enough for one, or its kind is
/// none that there is.
[[nodiscard]] std::optional<DicomElement> dicom_element_at(std::string_view bytes, std::size_t at,
                                                           DicomEncoding encoding);

/// Walks through a data set, its sequences and their items, and throws InputError where a length is
/// larger than what is there, an end is missing, or sequences are in each other without end: with
/// byte offset and path. What passes asks a reader for no more memory than there are bytes.
/// `base` is where the data set begins in its file. Cost: O(elements).
void check_lengths(std::string_view data_set, DicomEncoding encoding, std::size_t base,
                   std::string_view name);

}  // namespace loft::io
