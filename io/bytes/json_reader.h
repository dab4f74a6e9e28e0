// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace loft::io {

/// A text is no JSON; what() says why.
class JsonError : public std::runtime_error {
 public:
  JsonError(std::size_t column, const std::string& what)
      : std::runtime_error(what), column_(column) {}

  [[nodiscard]] std::size_t column() const { return column_; }  ///< byte in the text, from 1

 private:
  std::size_t column_;
};

/// What a JSON value is. `not_finite` is beyond JSON: NaN, Infinity and the like, which many
/// programs write; they are told apart from other mistakes so that a message can name them.
enum class JsonKind { object, list, string, number, boolean, null, not_finite };

/// Reads JSON (RFC 8259) value by value, in the order of the text, without building a document.
/// The caller says what it wants:
///
///     json.begin_list();
///     while (json.next_item()) sum += json.number();
///
/// Every function throws JsonError where the text is no JSON. Numbers are correctly rounded and do
/// not depend on the locale. The text must outlive the reader. A copy of a reader is a bookmark: it
/// goes on from where the reader was.
class JsonReader {
 public:
  /// `unit` is what messages call the text.
  explicit JsonReader(std::string_view text, std::string_view unit = "line")
      : text_(text), unit_(unit) {}

  /// What the value that comes next is.
  [[nodiscard]] JsonKind peek();

  /// Reads the value that comes next. Precondition of each: peek() is that kind.
  void begin_object();
  void begin_list();
  [[nodiscard]] double number();  ///< an infinity where the text is too large for `double`
  [[nodiscard]] std::string string();

  /// Leaves out the value that comes next, whatever it is.
  void skip();
  /// Leaves it out, too: as it is written.
  [[nodiscard]] std::string_view text();

  /// The key of an object's next member, whose value comes next; none at the object's end.
  [[nodiscard]] std::optional<std::string> next_key();
  /// Whether another value of the list comes next; false at the list's end.
  [[nodiscard]] bool next_item();

  /// Checks that only blanks are left; else the message ends in `hint`.
  void end(const char* hint = "");

  /// Where it is: the byte of the text that comes next.
  [[nodiscard]] std::size_t place() const { return place_; }

  /// The number or word that was read or left out last, as it is written.
  [[nodiscard]] std::string_view last_word() const { return last_word_; }

 private:
  [[noreturn]] void fail(const std::string& what) const;
  [[nodiscard]] char look() const { return place_ < text_.size() ? text_[place_] : '\0'; }
  void skip_blanks();
  void expect(char wanted);
  bool next_of(char closing);
  void skip_digits();
  std::string_view scan_number();
  std::string_view scan_word();
  void append_escape(std::string& result);
  char32_t read_hex();
  [[nodiscard]] JsonKind kind_of_word();

  std::string_view text_;
  std::string_view unit_;
  std::string_view last_word_;
  std::size_t place_ = 0;
  bool is_fresh_ = false;  // just behind an opening bracket
};

/// Leaves out the value that comes next and says what should have been there:
/// `expected a list, found null`, `NaN is not a number; write a list`.
[[nodiscard]] std::string reject(JsonReader& json, const std::string& wanted);

/// A value without the blanks around its parts; null instead of what is beyond JSON (NaN ...).
/// Precondition: a JsonReader has read it.
[[nodiscard]] std::string compact_json(std::string_view value);

/// Appends text as a JSON string, quotes and escapes included. Precondition: UTF-8.
void append_json_string(std::string& json, std::string_view text);

}  // namespace loft::io
