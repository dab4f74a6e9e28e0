// SPDX-License-Identifier: MIT
#include "io/bytes/json_reader.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <limits>
#include <system_error>

#include "io/bytes/text.h"
#include "io/bytes/utf8.h"

namespace loft::io {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_not_finite(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  constexpr std::array<std::string_view, 8> names{"NaN", "nan", "NAN",      "Inf",
                                                  "inf", "INF", "Infinity", "infinity"};
  return std::ranges::find(names, word) != names.end();
}

/// What a number in JSON's grammar stands for that is too small or too large for `double`.
double beyond_range(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eE");
  const bool is_tiny = exponent == std::string_view::npos ? number.find("0.") <= 1
                                                          : number.substr(exponent + 1, 1) == "-";
  const double size = is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
  return number.starts_with('-') ? -size : size;
}

}  // namespace

void JsonReader::fail(const std::string& what) const { throw JsonError(place_ + 1, what); }

void JsonReader::skip_blanks() {
  constexpr std::string_view blanks = " \t\r\n";
  while (place_ < text_.size() && blanks.find(text_[place_]) != std::string_view::npos) ++place_;
}

void JsonReader::expect(char wanted) {
  if (look() != wanted) {
    std::string what = "expected ";
    what += wanted;
    fail(place_ < text_.size() ? what : what + ", but the " + std::string(unit_) + " ends");
  }
  ++place_;
}

JsonKind JsonReader::peek() {
  skip_blanks();
  const char next = look();
  if (is_digit(next)) return JsonKind::number;
  switch (next) {
    case '{':
      return JsonKind::object;
    case '[':
      return JsonKind::list;
    case '"':
      return JsonKind::string;
    case '-':
      return place_ + 1 < text_.size() && is_digit(text_[place_ + 1]) ? JsonKind::number
                                                                      : kind_of_word();
    default:
      return kind_of_word();
  }
}

JsonKind JsonReader::kind_of_word() {
  const std::size_t before = place_;
  const std::string_view word = scan_word();
  place_ = before;
  if (word == "null") return JsonKind::null;
  if (word == "true" || word == "false") return JsonKind::boolean;
  if (is_not_finite(word)) return JsonKind::not_finite;
  if (place_ >= text_.size()) fail("expected a value, but the " + std::string(unit_) + " ends");
  fail("expected a value, found " + in_quotes(word.empty() ? text_.substr(place_, 1) : word));
}

void JsonReader::begin_object() {
  expect('{');
  is_fresh_ = true;
}

void JsonReader::begin_list() {
  expect('[');
  is_fresh_ = true;
}

/// Goes on to the next member or item, over a comma, or out of the brackets.
bool JsonReader::next_of(char closing) {
  skip_blanks();
  const bool is_first = is_fresh_;
  is_fresh_ = false;
  if (look() == closing) {
    ++place_;
    return false;
  }
  if (!is_first) expect(',');
  return true;
}

bool JsonReader::next_item() { return next_of(']'); }

std::optional<std::string> JsonReader::next_key() {
  if (!next_of('}')) return std::nullopt;
  skip_blanks();
  if (look() != '"') fail("expected a key in quotes");
  std::string key = string();
  skip_blanks();
  expect(':');
  return key;
}

void JsonReader::skip_digits() {
  if (!is_digit(look())) fail("expected a digit");
  while (is_digit(look())) ++place_;
}

/// A number as JSON spells it: no plus sign, no leading zero, digits on both sides of a point.
std::string_view JsonReader::scan_number() {
  const std::size_t begin = place_;
  if (look() == '-') ++place_;
  if (look() == '0') {
    ++place_;
  } else {
    skip_digits();
  }
  if (look() == '.') {
    ++place_;
    skip_digits();
  }
  if (look() == 'e' || look() == 'E') {
    ++place_;
    if (look() == '+' || look() == '-') ++place_;
    skip_digits();
  }
  return text_.substr(begin, place_ - begin);
}

double JsonReader::number() {
  last_word_ = scan_number();
  double value = 0;
  const auto [end, error] =
      std::from_chars(last_word_.data(), last_word_.data() + last_word_.size(), value);
  return error == std::errc::result_out_of_range ? beyond_range(last_word_) : value;
}

std::string_view JsonReader::scan_word() {
  const std::size_t begin = place_;
  if (look() == '-' || look() == '+') ++place_;
  while (is_letter(look())) ++place_;
  return text_.substr(begin, place_ - begin);
}

std::string JsonReader::string() {
  expect('"');
  std::string result;
  while (look() != '"') {
    if (place_ >= text_.size()) fail("a string without its closing quote");
    if (static_cast<unsigned char>(look()) < 0x20) fail("a control character in a string");
    if (look() == '\\') {
      append_escape(result);
    } else {
      result += text_[place_++];
    }
  }
  ++place_;
  if (!is_utf8(result)) fail("a string that is not UTF-8");
  return result;
}

char32_t JsonReader::read_hex() {
  char32_t value = 0;
  for (int i = 0; i < 4; ++i, ++place_) {
    const char c = look();
    if (!is_digit(c) && !(is_letter(c) && (c | 0x20) <= 'f')) fail("expected a hexadecimal digit");
    value = value << 4 | static_cast<char32_t>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
  }
  return value;
}

void JsonReader::append_escape(std::string& result) {
  constexpr std::string_view names = "\"\\/bfnrt";
  constexpr std::string_view characters = "\"\\/\b\f\n\r\t";
  ++place_;
  const std::size_t known = names.find(look());
  if (known != std::string_view::npos && look() != '\0') {
    result += characters[known];
    ++place_;
    return;
  }
  expect('u');
  char32_t character = read_hex();
  if (character >= 0xdc00 && character < 0xe000) fail("half a surrogate pair");
  if (character >= 0xd800 && character < 0xdc00) {
    expect('\\');
    expect('u');
    const char32_t low = read_hex();
    if (low < 0xdc00 || low >= 0xe000) fail("half a surrogate pair");
    character = 0x10000 + ((character - 0xd800) << 10) + (low - 0xdc00);
  }
  append_utf8(result, character);
}

void JsonReader::skip() {
  std::string open;  // the brackets we are in; not the call stack, which the text could exhaust
  do {
    switch (peek()) {
      case JsonKind::object:
        begin_object();
        open += '{';
        break;
      case JsonKind::list:
        begin_list();
        open += '[';
        break;
      case JsonKind::string:
        static_cast<void>(string());
        break;
      case JsonKind::number:
        last_word_ = scan_number();
        break;
      default:
        last_word_ = scan_word();
    }
    while (!open.empty() && !(open.back() == '[' ? next_item() : next_key().has_value())) {
      open.pop_back();
    }
  } while (!open.empty());
}

std::string_view JsonReader::text() {
  skip_blanks();
  const std::size_t begin = place_;
  skip();
  return text_.substr(begin, place_ - begin);
}

void JsonReader::end(const char* hint) {
  skip_blanks();
  if (place_ < text_.size()) fail(std::string("something behind the closing bracket") + hint);
}

namespace {

const char* name(JsonKind kind) {
  switch (kind) {
    case JsonKind::object:
      return "an object";
    case JsonKind::list:
      return "a list";
    case JsonKind::string:
      return "a string";
    case JsonKind::number:
      return "a number";
    case JsonKind::boolean:
      return "true or false";
    case JsonKind::null:
      return "null";
    case JsonKind::not_finite:
      break;
  }
  return "NaN";
}

}  // namespace

std::string reject(JsonReader& json, const std::string& wanted) {
  const JsonKind kind = json.peek();
  json.skip();
  if (kind != JsonKind::not_finite) return "expected " + wanted + ", found " + name(kind);
  return std::string(json.last_word()) + " is not a number; write " + wanted;
}

namespace {

/// How much of a text that begins with a quote is a string.
std::size_t string_size(std::string_view text) {
  std::size_t size = 1;
  while (text[size] != '"') size += text[size] == '\\' ? 2U : 1U;
  return size + 1;
}

/// Where what is no string, bracket, comma or colon ends.
std::size_t word_size(std::string_view text) {
  return std::min(text.find_first_of("\"[]{},: \t\r\n"), text.size());
}

}  // namespace

std::string compact_json(std::string_view value) {
  std::string result;
  while (!value.empty()) {
    std::size_t size = value.front() == '"' ? string_size(value) : word_size(value);
    const bool is_blank = std::string_view(" \t\r\n").find(value.front()) != std::string_view::npos;
    const std::string_view word = value.substr(0, size);
    if (size == 0 && !is_blank) {
      result += value.front();
    } else if (!is_blank) {
      result += is_not_finite(word) ? "null" : word;
    }
    value.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

void append_json_string(std::string& json, std::string_view text) {
  constexpr std::string_view hex = "0123456789abcdef";
  json += '"';
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') json += '\\';
    if (code >= 0x20) {
      json += c;
    } else {
      json += "\\u00";
      json += hex[code >> 4U];
      json += hex[code & 0xfU];
    }
  }
  json += '"';
}

}  // namespace loft::io
