// SPDX-License-Identifier: MIT
#include "io/dicom/dicom_object.h"

#include <dcmtk/dcmdata/dcdict.h>
#include <dcmtk/dcmdata/dcistrmb.h>
#include <dcmtk/dcmdata/dcspchrs.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmdata/dcxfer.h>
#include <dcmtk/oflog/oflog.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/bytes/decimal.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/dicom/dicom_elements.h"
#include "io/dicom/dicom_inflate.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

/// What DCMTK would print says less than the errors here.
void silence() {
  static const bool is_done = [] {
    for (const char* const part : {"dcmtk.dcmdata", "dcmtk.ofstd"})
      OFLog::getLogger(part).setLogLevel(OFLogger::OFF_LOG_LEVEL);
    return true;
  }();
  static_cast<void>(is_done);
}

/// What a UID is called, and itself.
std::string described(const std::string& uid) {
  if (uid == "1.2.840.10008.1.2.8.1") return "Deflated Image Frame Compression (" + uid + ")";
  const char* const words = dcmFindNameOfUID(uid.c_str());
  return words != nullptr ? words + (" (" + uid + ")") : uid;
}

/// By the encoding if the file does not say it.
E_TransferSyntax syntax_of(const DicomOpening& opening, std::string_view name) {
  if (opening.is_deflated) return EXS_LittleEndianExplicit;  // once inflated
  if (opening.transfer_syntax.empty()) {
    if (!opening.encoding.is_explicit) return EXS_LittleEndianImplicit;
    return opening.encoding.is_big_endian ? EXS_BigEndianExplicit : EXS_LittleEndianExplicit;
  }
  const bool is_uid = opening.transfer_syntax.find_first_not_of("0123456789.") == std::string::npos;
  const DcmXfer xfer(is_uid ? opening.transfer_syntax.c_str() : "none");
  const E_TransferSyntax syntax = xfer.getXfer();
  // Lengths are checked as the opening takes the file to be written: DCMTK must do the same.
  const bool is_same = xfer.isExplicitVR() == opening.encoding.is_explicit &&
                       xfer.isBigEndian() == opening.encoding.is_big_endian;
  if (syntax == EXS_Unknown || !is_same)
    throw InputError(
        std::string(name) + ": its transfer syntax " +
        (is_uid ? described(opening.transfer_syntax) : in_quotes(opening.transfer_syntax)) +
        " cannot be read; convert it to Explicit VR Little Endian");
  return syntax;
}

/// Implicit encodings name no kinds: without its dictionary DCMTK would see no sequences.
void require_dictionary(std::string_view name) {
  if (dcmDataDict.isDictionaryLoaded()) return;
  throw InputError(std::string(name) +
                   ": DCMTK does not find its data dictionary; install it, or name dicom.dic in "
                   "the environment variable DCMDICTPATH");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view padding("\0 \t\r\n", 5);
  const std::size_t begin = text.find_first_not_of(padding);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(padding) + 1 - begin);
}

/// A buffer from which DCMTK takes long values when they are asked for, not all at once.
class LazyBuffer final : public DcmInputBufferStream {
 public:
  /// The bytes must be there as long as what is read from them.
  explicit LazyBuffer(std::string_view bytes) : bytes_(bytes) {
    setBuffer(bytes.data(), static_cast<offile_off_t>(bytes.size()));
    setEos();
  }

  [[nodiscard]] DcmInputStreamFactory* newFactory() const override {
    return new Rest(bytes_.substr(static_cast<std::size_t>(tell())));
  }

 private:
  /// What was left when DCMTK came to a value.
  class Rest final : public DcmInputStreamFactory {
   public:
    explicit Rest(std::string_view bytes) : bytes_(bytes) {}
    [[nodiscard]] DcmInputStream* create() const override { return new LazyBuffer(bytes_); }
    [[nodiscard]] DcmInputStreamFactory* clone() const override { return new Rest(*this); }
    [[nodiscard]] DcmInputStreamFactoryType ident() const override {
      return DFT_DcmInputTempFileStreamFactory;  // the nearest: asked for when files are written
    }

   private:
    std::string_view bytes_;
  };

  std::string_view bytes_;
};

}  // namespace

DicomObject::DicomObject(std::string_view bytes, std::string_view name) : name_(name) {
  silence();
  const DicomOpening opening = read_dicom_opening(bytes, name);
  transfer_syntax_ = opening.transfer_syntax;
  const E_TransferSyntax syntax = syntax_of(opening, name);
  if (!opening.encoding.is_explicit) require_dictionary(name);
  std::string_view content = bytes.substr(opening.begin);
  if (opening.is_deflated) {
    inflated_ = inflate(content, name);
    content = inflated_;
  }
  check_lengths(content, opening.encoding, opening.is_deflated ? 0 : opening.begin, name);
  LazyBuffer stream(content);
  data_set_.transferInit();
  const OFCondition read = data_set_.read(stream, syntax);
  data_set_.transferEnd();
  if (read.bad())
    throw InputError(name_ + ": byte " +
                     std::to_string(opening.begin + static_cast<std::size_t>(stream.tell())) +
                     ": DCMTK says: " + read.text() + "; the file is damaged: export it again");
  character_set_ = trimmed_value_of(data_set_, DCM_SpecificCharacterSet);
}

std::string DicomObject::text(DcmItem& item, const DcmTagKey& tag) {
  return one_line(trimmed(to_utf8(trimmed_value_of(item, tag))));
}

std::string DicomObject::to_utf8(std::string_view text) {
  const auto is_ascii = [](char c) { return c > 0x1f && c < 0x7f; };
  if (std::ranges::all_of(text, is_ascii)) return std::string(text);
  OFString converted;
  DcmSpecificCharacterSet sets;
  if (!character_set_.empty() && DcmSpecificCharacterSet::isConversionAvailable() &&
      sets.selectCharacterSet(character_set_.c_str(), "ISO_IR 192").good() &&
      sets.convertString(text.data(), text.size(), converted, "\\^=").good() &&
      is_utf8({converted.data(), converted.size()}))
    return {converted.data(), converted.size()};
  if (is_utf8(text)) {
    note_once("texts are no " + (character_set_.empty() ? "ASCII" : in_quotes(character_set_)) +
              ", as the file says; they were read as UTF-8");
    return std::string(text);
  }
  note_once("texts are no " + (character_set_.empty() ? "ASCII" : in_quotes(character_set_)) +
            ", as the file says; they were read as Latin-1");
  std::string result;
  for (const char c : text) append_utf8(result, static_cast<unsigned char>(c));
  return result;
}

void DicomObject::note_once(const std::string& note) {
  if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
}

std::string_view value_of(DcmItem& item, const DcmTagKey& tag) {
  DcmElement* const element = element_of(item, tag);
  return element == nullptr ? std::string_view() : value_of(*element);
}

DcmElement* element_of(DcmItem& item, const DcmTagKey& tag) {
  DcmElement* element = nullptr;
  return item.findAndGetElement(tag, element).good() ? element : nullptr;
}

std::string_view value_of(DcmElement& element) {
  char* text = nullptr;
  Uint32 length = 0;
  if (element.getString(text, length).good())
    return text == nullptr ? std::string_view() : std::string_view(text, length);
  Uint8* bytes = nullptr;
  if (element.getUint8Array(bytes).good() && bytes != nullptr)
    return {reinterpret_cast<const char*>(bytes), element.getLength()};
  return {};
}

std::string_view trimmed_value_of(DcmItem& item, const DcmTagKey& tag) {
  return trimmed(value_of(item, tag));
}

std::string_view trimmed_value_of(DcmElement& element) { return trimmed(value_of(element)); }

std::string_view next_value(std::string_view& text) {
  const std::size_t end = std::min(text.find('\\'), text.size());
  const std::string_view value = trimmed(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return value;
}

std::optional<double> to_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return {};
  return number;
}

std::optional<double> next_number(std::string_view& text) {
  std::string_view left = text;
  const std::optional<double> number = take_short_decimal(left);
  if (!number || !(left.empty() || left.front() == '\\')) return to_number(next_value(text));
  text = left.substr(std::min<std::size_t>(1, left.size()));
  return number;
}

std::optional<std::vector<double>> numbers_of(DcmItem& item, const DcmTagKey& tag) {
  std::string_view text = trimmed_value_of(item, tag);
  if (text.empty()) return {};
  std::vector<double> numbers;
  while (!text.empty()) {
    const auto number = next_number(text);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

DcmSequenceOfItems* sequence_of(DcmItem& item, const DcmTagKey& tag) {
  DcmSequenceOfItems* sequence = nullptr;
  return item.findAndGetSequence(tag, sequence).good() ? sequence : nullptr;
}

DcmItem* first_item_of(DcmItem& item, const DcmTagKey& tag) {
  DcmSequenceOfItems* const sequence = sequence_of(item, tag);
  return sequence == nullptr ? nullptr : static_cast<DcmItem*>(sequence->nextInContainer(nullptr));
}

}  // namespace loft::io
