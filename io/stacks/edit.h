// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/slice.h"

namespace loft::io {

/// One edit of a stack, as streams and journals know it.
struct Edit {
  enum class Kind { insert, replace, remove };

  Kind kind = Kind::insert;
  Slice slice;  ///< of a removal only its height matters

  friend bool operator==(const Edit&, const Edit&) = default;
};

/// What one line of a stream says, and everything that is wrong with it, as SliceLine.
struct EditLine {
  Edit edit;
  std::vector<std::string> problems;
  std::optional<double> z;
};

/// Reads one line of NDJSON as an edit: a slice as in a stack file (slices_json.h), with
/// `"op": "replace"` or `"op": "remove"` (which needs `z` alone); `"op": "insert"` may be left out.
/// Cost: O(n), no document tree is built.
[[nodiscard]] EditLine parse_edit_line(std::string_view line);

/// The kind's name in a line: `insert`, `replace` or `remove`.
[[nodiscard]] const char* name(Edit::Kind kind);

/// The line, without its end, that parse_edit_line() gives back exactly.
[[nodiscard]] std::string to_line(const Edit& edit);

}  // namespace loft::io
