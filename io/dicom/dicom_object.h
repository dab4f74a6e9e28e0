// SPDX-License-Identifier: MIT
// Only for sources that are built with DCMTK.
#pragma once

#include <dcmtk/config/osconfig.h>
//
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcitem.h>
#include <dcmtk/dcmdata/dcsequen.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// A DICOM file in memory, by DCMTK, whose messages are silenced.
class DicomObject {
 public:
  /// Throws InputError for what is no DICOM file, is cut off or claims what it does not have, and
  /// for a transfer syntax that DCMTK does not know. The bytes must be there as long as this is:
  /// long values are taken from them when they are asked for.
  DicomObject(std::string_view bytes, std::string_view name);

  [[nodiscard]] DcmDataset& data_set() { return data_set_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Its UID; empty where the file has none.
  [[nodiscard]] const std::string& transfer_syntax() const { return transfer_syntax_; }

  /// A text of an item, of the file's character set, as UTF-8, on one line and without the blanks
  /// around it; empty where it has none.
  [[nodiscard]] std::string text(DcmItem& item, const DcmTagKey& tag);
  /// What was odd about its texts.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  [[nodiscard]] std::string to_utf8(std::string_view text);
  void note_once(const std::string& note);

  std::string inflated_;  // the bytes that count, where those of the file are compressed
  DcmDataset data_set_;
  std::string name_;
  std::string transfer_syntax_;
  std::string character_set_;
  std::vector<std::string> notes_;
};

/// The bytes of an element of text, also where its kind is unknown, as that of values too long for
/// theirs; empty where there is none. Valid as long as the item is.
[[nodiscard]] std::string_view value_of(DcmItem& item, const DcmTagKey& tag);
/// The same without blanks and padding at its ends.
[[nodiscard]] std::string_view trimmed_value_of(DcmItem& item, const DcmTagKey& tag);
/// An element of an item; null where it has none.
[[nodiscard]] DcmElement* element_of(DcmItem& item, const DcmTagKey& tag);
/// What it holds, as above: until `element.compact()`, which gives back the memory of a long value.
/// Of several elements by several threads at once.
[[nodiscard]] std::string_view value_of(DcmElement& element);
[[nodiscard]] std::string_view trimmed_value_of(DcmElement& element);

/// Takes the next value off a text that has a backslash between values, without blanks around it.
[[nodiscard]] std::string_view next_value(std::string_view& text);
/// A decimal or integer string as a number; none if it is no number.
[[nodiscard]] std::optional<double> to_number(std::string_view text);
/// The number that next_value() would be; takes that, too.
[[nodiscard]] std::optional<double> next_number(std::string_view& text);
/// All numbers of an element of text; none where there is no element, or one is no number.
[[nodiscard]] std::optional<std::vector<double>> numbers_of(DcmItem& item, const DcmTagKey& tag);

/// The sequence in an item; null where it has none.
[[nodiscard]] DcmSequenceOfItems* sequence_of(DcmItem& item, const DcmTagKey& tag);
/// The first item of a sequence in an item; null where it has none.
[[nodiscard]] DcmItem* first_item_of(DcmItem& item, const DcmTagKey& tag);

/// Calls `use(DcmItem&, index)` for the items of a sequence, which may be null.
template <class Use>
void for_each_item(DcmSequenceOfItems* sequence, Use use) {
  if (sequence == nullptr) return;
  std::size_t index = 0;
  DcmObject* object = sequence->nextInContainer(nullptr);
  while (object != nullptr) {
    use(static_cast<DcmItem&>(*object), index++);
    object = sequence->nextInContainer(object);
  }
}

}  // namespace loft::io
