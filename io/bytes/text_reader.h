// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace loft::io {

/// Reads a text word by word, and knows its line for messages. The text must outlive it.
class TextReader {
 public:
  TextReader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  /// Goes to the next line that has a word; false at the end. `#` begins a comment where
  /// set_comments() was called.
  bool next_line();
  void set_comments() { comments_ = true; }

  /// The next word of the line, if any is left.
  [[nodiscard]] std::optional<std::string_view> word();
  /// The next word, on this line or a later one. Throws InputError at the end of the text.
  [[nodiscard]] std::string_view any_word(std::string_view wanted);
  /// The rest of the line, without blanks at its ends.
  [[nodiscard]] std::string_view rest() const;

  /// The next word of the line as a number. Throws InputError if it is none.
  [[nodiscard]] double number(std::string_view wanted);
  /// The same for the next word, on this line or a later one.
  [[nodiscard]] double any_number(std::string_view wanted);
  /// A word as a number, an index or a count. Throws InputError if it is none.
  [[nodiscard]] double to_number(std::string_view word, std::string_view wanted) const;
  [[nodiscard]] std::int64_t to_integer(std::string_view word, std::string_view wanted) const;

  /// Place in the text behind the line.
  [[nodiscard]] std::size_t next_line_begin() const { return next_; }

  /// Throws InputError `name:line: message`.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view text_;
  std::string_view name_;
  std::string_view line_;  // what is left of the line
  std::size_t next_ = 0;
  std::size_t number_ = 0;
  bool comments_ = false;
};

}  // namespace loft::io
