// SPDX-License-Identifier: MIT
#include "io/bytes/text_reader.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "io/bytes/text.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

template <class Number>
bool parse(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

bool TextReader::next_line() {
  while (next_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', next_), text_.size());
    line_ = text_.substr(next_, end - next_);
    next_ = std::min(end + 1, text_.size());
    ++number_;
    if (comments_) line_ = line_.substr(0, line_.find('#'));
    if (line_.find_first_not_of(blanks) != std::string_view::npos) return true;
  }
  line_ = {};
  return false;
}

std::optional<std::string_view> TextReader::word() {
  const std::size_t begin = line_.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = std::min(line_.find_first_of(blanks, begin), line_.size());
  const std::string_view result = line_.substr(begin, end - begin);
  line_.remove_prefix(end);
  return result;
}

std::string_view TextReader::any_word(std::string_view wanted) {
  while (true) {
    if (const auto found = word()) return *found;
    if (!next_line()) fail("the file ends where " + std::string(wanted) + " should be");
  }
}

std::string_view TextReader::rest() const {
  const std::size_t begin = line_.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return line_.substr(begin, line_.find_last_not_of(blanks) - begin + 1);
}

double TextReader::number(std::string_view wanted) {
  const auto found = word();
  if (!found) fail("the line ends where " + std::string(wanted) + " should be");
  return to_number(*found, wanted);
}

double TextReader::any_number(std::string_view wanted) {
  return to_number(any_word(wanted), wanted);
}

double TextReader::to_number(std::string_view word, std::string_view wanted) const {
  double number = 0;
  if (!parse(word, number)) fail("expected " + std::string(wanted) + ", found " + in_quotes(word));
  return number;
}

std::int64_t TextReader::to_integer(std::string_view word, std::string_view wanted) const {
  std::int64_t number = 0;
  if (!parse(word, number)) fail("expected " + std::string(wanted) + ", found " + in_quotes(word));
  return number;
}

void TextReader::fail(const std::string& message) const {
  throw InputError(std::string(name_) + ":" + std::to_string(number_) + ": " + message);
}

}  // namespace loft::io
