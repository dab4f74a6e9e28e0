// SPDX-License-Identifier: MIT
#include "io/dicom/dicom_elements.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr std::array<std::string_view, 34> kinds{
    "AE", "AS", "AT", "CS", "DA", "DS", "DT", "FD", "FL", "IS", "LO", "LT",
    "OB", "OD", "OF", "OL", "OV", "OW", "PN", "SH", "SL", "SQ", "SS", "ST",
    "SV", "TM", "UC", "UI", "UL", "UN", "UR", "US", "UT", "UV"};
/// Those whose length has four bytes, behind two that are reserved.
constexpr std::array<std::string_view, 13> long_kinds{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                      "SV", "UC", "UN", "UR", "UT", "UV"};

constexpr std::uint16_t delimiters = 0xfffe;
constexpr DicomTag item_begin{delimiters, 0xe000};
constexpr DicomTag item_end{delimiters, 0xe00d};
constexpr DicomTag sequence_end{delimiters, 0xe0dd};
constexpr DicomTag pixels{0x7fe0, 0x0010};

/// The number in the next `count` bytes. Precondition: they are there.
std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t count,
                        bool is_big_endian) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = is_big_endian ? at + i : at + count - 1 - i;
    number = number << 8U | static_cast<unsigned char>(bytes[place]);
  }
  return number;
}

}  // namespace

std::string to_text(DicomTag tag) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "(%04x,%04x)", unsigned{tag.group}, unsigned{tag.number});
  return text.data();
}

std::optional<DicomElement> dicom_element_at(std::string_view bytes, std::size_t at,
                                             DicomEncoding encoding) {
  constexpr std::size_t shortest = 8;
  constexpr std::size_t longest = 12;
  if (at > bytes.size() || bytes.size() - at < shortest) return {};
  const auto number = [&](std::size_t offset, std::size_t count) {
    return number_at(bytes, at + offset, count, encoding.is_big_endian);
  };
  DicomElement element;
  element.tag = {static_cast<std::uint16_t>(number(0, 2)),
                 static_cast<std::uint16_t>(number(2, 2))};
  element.value = at + shortest;
  if (!encoding.is_explicit || element.tag.group == delimiters) {
    element.length = number(4, 4);
    return element;
  }
  element.kind = bytes.substr(at + 4, 2);
  if (std::ranges::find(kinds, element.kind) == kinds.end()) return {};
  if (std::ranges::find(long_kinds, element.kind) == long_kinds.end()) {
    element.length = number(6, 2);
    return element;
  }
  if (bytes.size() - at < longest) return {};
  element.length = number(8, 4);
  element.value = at + longest;
  return element;
}

namespace {

/// Walks once through all elements.
class Walk {
 public:
  Walk(std::string_view bytes, std::size_t base, std::string_view name)
      : bytes_(bytes), base_(base), name_(name) {}

  /// Elements up to `end`, or, where that of the item is not known, up to its delimiter.
  void elements(std::size_t end, bool has_end, DicomEncoding encoding) {
    const std::size_t depth = path_.size();
    while (at_ < end) {
      const DicomElement element = head(end, encoding);
      if (!has_end && element.tag == item_end) return;
      path_ += (depth > 0 ? "/" : "") + to_text(element.tag);
      value(element, end, encoding);
      path_.resize(depth);
    }
    if (!has_end) fail("the item has no end");
  }

 private:
  DicomElement head(std::size_t end, DicomEncoding encoding) {
    const auto element = dicom_element_at(bytes_.substr(0, end), at_, encoding);
    if (!element) fail("here is no element");
    at_ = element->value;
    return *element;
  }

  void value(const DicomElement& element, std::size_t end, DicomEncoding encoding) {
    const bool has_end = element.length != undefined_length;
    if (has_end && element.length > end - at_)
      fail("claims " + std::to_string(element.length) + " bytes where " +
           std::to_string(end - at_) + " are left");
    const std::size_t value_end = has_end ? at_ + element.length : end;
    if (!has_end && element.tag == pixels) {
      fragments(end);
    } else if (is_sequence(element, value_end, encoding)) {
      // What is of unknown kind and length is written in the way that needs no kinds.
      items(value_end, has_end, element.kind == "UN" ? DicomEncoding{false, false} : encoding);
    } else {
      at_ = value_end;
    }
  }

  /// Whether a reader would look for items in it. Where kinds are not written a dictionary tells
  /// him; what begins like an item may be one of them.
  [[nodiscard]] bool is_sequence(const DicomElement& element, std::size_t end,
                                 DicomEncoding encoding) const {
    if (element.length == undefined_length || element.kind == "SQ") return true;
    if (encoding.is_explicit || element.tag == pixels) return false;
    const auto first = dicom_element_at(bytes_.substr(0, end), at_, encoding);
    return first && first->tag == item_begin;
  }

  void items(std::size_t end, bool has_end, DicomEncoding encoding) {
    constexpr std::size_t deepest = 64;
    if (++depth_ > deepest) fail("more than " + std::to_string(deepest) + " sequences deep");
    const std::size_t length = path_.size();
    for (std::size_t i = 0; at_ < end; ++i) {
      const DicomElement item = head(end, encoding);
      if (!has_end && item.tag == sequence_end) {
        --depth_;
        return;
      }
      path_ += '[' + std::to_string(i) + ']';
      if (item.tag != item_begin) fail("has " + to_text(item.tag) + " where an item must be");
      one_item(item, end, encoding);
      path_.resize(length);
    }
    if (!has_end) fail("the sequence has no end");
    --depth_;
  }

  void one_item(const DicomElement& item, std::size_t end, DicomEncoding encoding) {
    const bool has_end = item.length != undefined_length;
    if (has_end && item.length > end - at_)
      fail("claims " + std::to_string(item.length) + " bytes where " + std::to_string(end - at_) +
           " are left");
    elements(has_end ? at_ + item.length : end, has_end, encoding);
  }

  /// Compressed pixels: items that have bytes in them.
  void fragments(std::size_t end) {
    for (std::size_t i = 0; at_ < end; ++i) {
      const DicomElement item = head(end, {true, false});
      if (item.tag == sequence_end) return;
      path_ += '[' + std::to_string(i) + ']';
      if (item.tag != item_begin || item.length > end - at_)
        fail("claims " + std::to_string(item.length) + " bytes where " + std::to_string(end - at_) +
             " are left");
      at_ += item.length;
      path_.resize(path_.rfind('['));
    }
    fail("the pixels have no end");
  }

  [[noreturn]] void fail(const std::string& message) const {
    std::string text(name_);
    text += ": byte " + std::to_string(base_ + at_);
    if (!path_.empty()) text += ", " + path_;
    throw InputError(text + ": " + message +
                     "; the file is cut off or damaged: copy or export it again");
  }

  std::string_view bytes_;
  std::size_t base_;
  std::string_view name_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
  std::string path_;
};

}  // namespace

void check_lengths(std::string_view data_set, DicomEncoding encoding, std::size_t base,
                   std::string_view name) {
  Walk(data_set, base, name).elements(data_set.size(), true, encoding);
}

}  // namespace loft::io
