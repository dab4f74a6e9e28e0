// SPDX-License-Identifier: MIT
#include "io/dicom/dicom_opening.h"

#include <cctype>
#include <cstdint>

#include "io/dicom/dicom.h"
#include "io/dicom/dicom_elements.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr std::size_t preamble = 128;
constexpr std::string_view magic = "DICM";
constexpr std::uint16_t meta_group = 0x0002;
constexpr std::uint16_t first_group = 0x0008;

/// Where meta information or the data set begins.
std::size_t begin_of(std::string_view bytes) {
  if (bytes.substr(0, magic.size()) == magic) return magic.size();
  const bool has_preamble =
      bytes.size() >= preamble + magic.size() && bytes.substr(preamble, magic.size()) == magic;
  return has_preamble ? preamble + magic.size() : 0;
}

/// Whether an element could be the first of its group: one of low number, its value not long.
bool begins_like_group(std::string_view bytes, std::uint16_t group, DicomEncoding encoding) {
  constexpr std::uint16_t largest_number = 0x00ff;
  constexpr std::uint32_t longest = 1024;
  const auto element = dicom_element_at(bytes, 0, encoding);
  return element && element->tag.group == group && element->tag.number <= largest_number &&
         element->length <= longest;
}

/// How the data set is written whose first bytes these are.
DicomEncoding encoding_of(std::string_view bytes) {
  for (const bool is_big_endian : {false, true})
    if (const DicomEncoding encoding{true, is_big_endian};
        dicom_element_at(bytes, 0, encoding).has_value())
      if (begins_like_group(bytes, first_group, encoding)) return encoding;
  return {false, false};
}

/// A UID without what pads it.
std::string uid_in(std::string_view value) {
  while (!value.empty() && (value.back() == '\0' || value.back() == ' ')) value.remove_suffix(1);
  return std::string(value);
}

/// Reads the elements of the group in front; they are written in the same way in every file.
void read_meta(std::string_view bytes, DicomOpening& opening) {
  constexpr DicomTag transfer_syntax{meta_group, 0x0010};
  while (const auto element = dicom_element_at(bytes, opening.begin, {true, false})) {
    if (element->tag.group != meta_group) return;
    if (element->length > bytes.size() - element->value) return;
    if (element->tag == transfer_syntax)
      opening.transfer_syntax = uid_in(bytes.substr(element->value, element->length));
    opening.begin = element->value + element->length;
  }
}

}  // namespace

bool begins_like_data_set(std::string_view bytes) {
  return begins_like_group(bytes, meta_group, {true, false}) ||
         begins_like_group(bytes, first_group, {true, false}) ||
         begins_like_group(bytes, first_group, {true, true}) ||
         begins_like_group(bytes, first_group, {false, false});
}

bool begins_like_dicom(std::string_view bytes) {
  return begin_of(bytes) > 0 || begins_like_data_set(bytes);
}

DicomOpening read_dicom_opening(std::string_view bytes, std::string_view name) {
  DicomOpening opening;
  opening.begin = begin_of(bytes);
  if (opening.begin == 0 && !begins_like_data_set(bytes))
    throw InputError(std::string(name) +
                     ": is no DICOM file: it has neither DICM at byte 128 nor an element of group "
                     "0002 or 0008 in front; export it again, as DICOM");
  read_meta(bytes, opening);
  const std::string& uid = opening.transfer_syntax;
  opening.is_deflated = uid == "1.2.840.10008.1.2.1.99";
  if (uid.empty())
    opening.encoding = encoding_of(bytes.substr(opening.begin));
  else
    opening.encoding = {uid != "1.2.840.10008.1.2", uid == "1.2.840.10008.1.2.2"};
  return opening;
}

}  // namespace loft::io
