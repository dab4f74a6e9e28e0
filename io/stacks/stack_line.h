// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// What the first line of a stack file may say of the whole stack, and everything that is wrong
/// with it.
struct StackLine {
  Stack stack;  ///< without slices
  std::vector<std::string> problems;
};

/// Whether a line begins as one that parse_stack_line() reads. Cost: O(1).
[[nodiscard]] bool begins_like_stack_line(std::string_view line);

/// Reads a line `{"stack": {...}}`; none if the line is no object with that key. See slices_json.h.
[[nodiscard]] std::optional<StackLine> parse_stack_line(std::string_view line);

/// Appends the line, without its end, that parse_stack_line() gives back; nothing where a stack
/// has nothing but its slices. Returns whether there was anything.
bool append_stack_line(std::string& line, const Stack& stack);

/// `#rrggbb`.
[[nodiscard]] std::string to_text(Colour colour);
/// None if it is not written so.
[[nodiscard]] std::optional<Colour> to_colour(std::string_view text);

}  // namespace loft::io
