// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cdt/ids.h"
#include "cdt/passages.h"

namespace loft::cdt {

// Four archives, to write and to read text and bytes. All have the same members, so that one
// description of a state serves them all; those that read assign to the fields, and fail() where
// they cannot:
//
//   line(name, fields...)        single fields
//   table(name, count, row)      calls row(i) for as many rows as there are, which uses one of
//     row(id, is_there, fields...)  a row that may be free: then the fields mean nothing
//     entry(fields...)              a row that is just its fields
//     list(id, items)               a row as long as it likes
//   end()
//
// Fields are double, bool, std::uint32_t, Id, Passage.

inline constexpr std::string_view text_name = "loft-cdt";
inline constexpr std::string_view binary_magic = "\x89lftcdt\n";
inline constexpr std::uint32_t format_version = 1;

/// Remembers where the rows of each table are, all being equally long.
class Places {
 public:
  void start(std::string_view table, std::size_t place) { places_[table] = {place, 1}; }
  void set_stride(std::string_view table, std::size_t stride) { places_[table].stride = stride; }
  [[nodiscard]] std::size_t of(std::string_view table, std::size_t row) const {
    const auto known = places_.find(table);
    if (known == places_.end()) return 0;
    return known->second.first + row * known->second.stride;
  }

 private:
  struct Rows {
    std::size_t first = 0;
    std::size_t stride = 1;
  };
  std::map<std::string_view, Rows> places_;
};

// --- Text ---

class TextWriter {
 public:
  static constexpr bool is_reading = false;

  explicit TextWriter(std::ostream& out) : out_(out) {
    line(text_name, format_version, std::string_view("text"));
  }

  template <class... Fields>
  void line(std::string_view name, const Fields&... fields) {
    text_ += name;
    (put(fields), ...);
    end_line();
  }

  template <class Row>
  void table(std::string_view name, std::size_t count, Row row) {
    line(name, static_cast<std::uint32_t>(count));
    for (std::uint32_t i = 0; i < count; ++i) row(i);
  }

  template <class Tag, class... Fields>
  void row(Id<Tag> id, bool is_there, const Fields&... fields) {
    put(id);
    if (is_there) {
      (put(fields), ...);
    } else {
      text_ += " free";
    }
    end_line();
  }

  template <class... Fields>
  void entry(const Fields&... fields) {
    (put(fields), ...);
    end_line();
  }

  template <class Head, class Item>
  void list(const Head& head, const std::vector<Item>& items) {
    put(head);
    for (const Item& item : items) put(item);
    end_line();
  }

  void end() {
    line("end");
    flush();
  }

 private:
  static constexpr std::size_t block = 1 << 16;

  void put(std::string_view word) { (separate(), text_ += word); }
  void put(bool truth) { (separate(), text_ += truth ? "yes" : "no"); }
  void put(double x) { (separate(), append(x)); }
  void put(std::uint32_t n) { (separate(), append(n)); }
  template <class Tag>
  void put(Id<Tag> id) {
    separate();
    if (id.is_none()) {
      text_ += '-';
    } else {
      text_ += Tag::prefix;
      append(id.index());
    }
  }
  void put(Passage passage) {
    put(passage.segment());
    text_ += passage.is_upward() ? '+' : '-';
  }

  template <class Number>
  void append(Number number) {
    std::array<char, 32> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text_.append(digits.data(), end);
  }
  void separate() {
    if (!text_.empty() && text_.back() != '\n') text_ += ' ';
  }
  void end_line() {
    text_ += '\n';
    if (text_.size() >= block) flush();
  }
  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  std::ostream& out_;
  std::string text_;
};

class TextReader {
 public:
  static constexpr bool is_reading = true;

  explicit TextReader(std::istream& in) : in_(in) {
    begin_line(text_name);
    std::uint32_t version = 0;
    take(version);
    if (version != format_version) fail("version ", version, " is not known, only 1 is");
    take_word("text");
    end_line();
  }

  template <class... Fields>
  void line(std::string_view name, Fields&... fields) {
    begin_line(name);
    places_.start(name, number_);
    (take(fields), ...);
    end_line();
  }

  template <class Row>
  void table(std::string_view name, std::size_t, Row row) {
    std::uint32_t count = 0;
    line(name, count);
    places_.start(name, number_ + 1);
    for (std::uint32_t i = 0; i < count; ++i) row(i);
  }

  template <class Tag, class... Fields>
  void row(Id<Tag> id, bool& is_there, Fields&... fields) {
    next_line();
    Id<Tag> label;
    take(label);
    if (label != id) fail("this should be ", Tag::prefix, id.index());
    is_there = rest_ != "free";
    if (is_there) {
      (take(fields), ...);
    } else {
      rest_ = {};
    }
    end_line();
  }

  template <class... Fields>
  void entry(Fields&... fields) {
    next_line();
    (take(fields), ...);
    end_line();
  }

  template <class Head, class Item>
  void list(Head& head, std::vector<Item>& items) {
    next_line();
    take(head);
    items.clear();
    while (!rest_.empty()) take(items.emplace_back());
  }

  void end() { line("end"); }

  template <class... Words>
  [[noreturn]] void fail(const Words&... words) const {
    fail_at(number_, words...);
  }
  /// About a row that was read before.
  template <class... Words>
  [[noreturn]] void fail_in(std::string_view table, std::size_t row, const Words&... words) const {
    fail_at(places_.of(table, row), words...);
  }

 private:
  template <class... Words>
  [[noreturn]] static void fail_at(std::size_t number, const Words&... words);

  void next_line() {
    ++number_;
    if (!std::getline(in_, line_)) fail("this is missing");
    rest_ = line_;
  }
  void begin_line(std::string_view name) {
    next_line();
    take_word(name);
  }
  void end_line() const {
    if (!rest_.empty()) fail("there is more than expected: ", rest_);
  }

  [[nodiscard]] std::string_view word() {
    const std::string_view word = rest_.substr(0, rest_.find(' '));
    if (word.empty()) fail("something is missing");
    rest_.remove_prefix(word.size());
    if (rest_.size() > 1) rest_.remove_prefix(1);  // a blank at the end of the line stays
    return word;
  }
  void take_word(std::string_view expected) {
    if (word() != expected) fail("this should be \"", expected, "\"");
  }
  void take(bool& truth) {
    const std::string_view given = word();
    if (given != "yes" && given != "no") fail(given, " is neither yes nor no");
    truth = given == "yes";
  }
  void take(double& x) { parse(word(), x); }
  void take(std::uint32_t& n) { parse(word(), n); }
  template <class Tag>
  void take(Id<Tag>& id) {
    id = identified<Tag>(word());
  }
  void take(Passage& passage) {
    const std::string_view given = word();
    const char direction = given.back();
    const SegmentId s = identified<SegmentTag>(given.substr(0, given.size() - 1));
    if ((direction != '+' && direction != '-') || s.index() >= PassageSets::most_segments)
      fail(given, " is no passage");
    passage = Passage(s, direction == '+');
  }

  template <class Tag>
  [[nodiscard]] Id<Tag> identified(std::string_view given) const {
    if (given == "-") return {};
    std::uint32_t index = 0;
    if (given.empty() || given[0] != Tag::prefix) fail(given, " is no id with ", Tag::prefix);
    parse(given.substr(1), index);
    return Id<Tag>(index);
  }
  template <class Number>
  void parse(std::string_view digits, Number& number) const {
    const char* const last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, number);
    if (error != std::errc() || end != last) fail(digits, " is no number that fits here");
  }

  std::istream& in_;
  std::string line_;
  std::string_view rest_;
  std::size_t number_ = 0;
  Places places_;
};

// --- Bytes ---

/// FNV-1a: differs whenever one byte does.
class Checksum {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      hash_ = (hash_ ^ static_cast<unsigned char>(bytes[i])) * 0x0000'0100'0000'01b3U;
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf2'9ce4'8422'2325U;
};

/// What stands for a field: an unsigned number of its size.
inline std::uint64_t as_bits(double x) { return std::bit_cast<std::uint64_t>(x); }
inline std::uint32_t as_bits(std::uint32_t n) { return n; }
inline std::uint8_t as_bits(bool truth) { return truth ? 1 : 0; }
template <class Tag>
std::uint32_t as_bits(Id<Tag> id) {
  return id.index();
}
inline std::uint32_t as_bits(Passage passage) {
  return passage.segment().index() << 1 | (passage.is_upward() ? 1U : 0U);
}

class BinaryWriter {
 public:
  static constexpr bool is_reading = false;

  explicit BinaryWriter(std::ostream& out) : out_(out) {
    bytes_ += binary_magic;
    put(format_version);
  }

  template <class... Fields>
  void line(std::string_view, const Fields&... fields) {
    entry(fields...);
  }

  template <class Row>
  void table(std::string_view, std::size_t count, Row row) {
    put(static_cast<std::uint32_t>(count));
    for (std::uint32_t i = 0; i < count; ++i) row(i);
  }

  template <class Tag, class... Fields>
  void row(Id<Tag>, bool is_there, const Fields&... fields) {
    put(is_there);
    if (is_there) {
      (put(fields), ...);
    } else {
      (put(Fields()), ...);
    }
    if (bytes_.size() >= block) flush();
  }

  template <class... Fields>
  void entry(const Fields&... fields) {
    (put(fields), ...);
    if (bytes_.size() >= block) flush();
  }

  template <class Head, class Item>
  void list(const Head& head, const std::vector<Item>& items) {
    entry(head, static_cast<std::uint32_t>(items.size()));
    for (const Item& item : items) entry(item);
  }

  void end() {
    flush();
    put(sum_.value());
    flush();
  }

 private:
  static constexpr std::size_t block = 1 << 16;

  template <class Field>
  void put(const Field& field) {
    if constexpr (std::same_as<Field, std::uint64_t>) {
      put_bits(field);
    } else {
      put_bits(as_bits(field));
    }
  }
  template <std::unsigned_integral Bits>
  void put_bits(Bits bits) {
    for (unsigned shift = 0; shift < 8 * sizeof(Bits); shift += 8)
      bytes_ += static_cast<char>(static_cast<unsigned char>(bits >> shift & 0xff));
  }
  void flush() {
    sum_.add(bytes_.data(), bytes_.size());
    out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }

  std::ostream& out_;
  std::string bytes_;
  Checksum sum_;
};

class BinaryReader {
 public:
  static constexpr bool is_reading = true;

  explicit BinaryReader(std::istream& in) : in_(in) {
    for (const char expected : binary_magic)
      if (static_cast<char>(take_bits<std::uint8_t>()) != expected)
        fail("this is not how a triangulation begins");
    std::uint32_t version = 0;
    take(version);
    if (version != format_version) fail("version ", version, " is not known, only 1 is");
  }

  template <class... Fields>
  void line(std::string_view name, Fields&... fields) {
    places_.start(name, offset_);
    entry(fields...);
  }

  template <class Row>
  void table(std::string_view name, std::size_t, Row row) {
    std::uint32_t count = 0;
    take(count);
    const std::size_t start = offset_;
    places_.start(name, start);
    for (std::uint32_t i = 0; i < count; ++i) {
      row(i);
      if (i == 0) places_.set_stride(name, offset_ - start);
    }
  }

  template <class Tag, class... Fields>
  void row(Id<Tag>, bool& is_there, Fields&... fields) {
    take(is_there);
    const std::size_t start = offset_;
    (take(fields), ...);
    if (!is_there && !(... && (as_bits(fields) == as_bits(Fields()))))
      fail_at(start, "a row that is free should be empty");
  }

  template <class... Fields>
  void entry(Fields&... fields) {
    (take(fields), ...);
  }

  template <class Head, class Item>
  void list(Head& head, std::vector<Item>& items) {
    std::uint32_t count = 0;
    entry(head, count);
    items.clear();
    for (std::uint32_t i = 0; i < count; ++i) take(items.emplace_back());
  }

  void end() {
    const std::uint64_t sum = sum_.value();
    if (take_bits<std::uint64_t>() != sum) fail("the checksum is wrong");
  }

  template <class... Words>
  [[noreturn]] void fail(const Words&... words) const {
    fail_at(field_, words...);
  }
  template <class... Words>
  [[noreturn]] void fail_in(std::string_view table, std::size_t row, const Words&... words) const {
    fail_at(places_.of(table, row), words...);
  }

 private:
  template <class... Words>
  [[noreturn]] static void fail_at(std::size_t offset, const Words&... words);

  template <std::unsigned_integral Bits>
  [[nodiscard]] Bits take_bits() {
    field_ = offset_;
    std::array<char, sizeof(Bits)> bytes;
    const std::streamsize got = in_.rdbuf()->sgetn(bytes.data(), bytes.size());
    if (got != static_cast<std::streamsize>(bytes.size())) fail("the end is missing");
    sum_.add(bytes.data(), bytes.size());
    offset_ += bytes.size();
    std::uint64_t bits = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
      bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
    return static_cast<Bits>(bits);
  }
  void take(double& x) { x = std::bit_cast<double>(take_bits<std::uint64_t>()); }
  void take(std::uint32_t& n) { n = take_bits<std::uint32_t>(); }
  void take(bool& truth) {
    const auto bits = take_bits<std::uint8_t>();
    if (bits > 1) fail("a truth should be 0 or 1");
    truth = bits == 1;
  }
  template <class Tag>
  void take(Id<Tag>& id) {
    id = Id<Tag>(take_bits<std::uint32_t>());
  }
  void take(Passage& passage) {
    const auto bits = take_bits<std::uint32_t>();
    if (bits >> 1 >= PassageSets::most_segments) fail("this is no passage");
    passage = Passage(SegmentId(bits >> 1), (bits & 1) != 0);
  }

  std::istream& in_;
  std::size_t offset_ = 0;
  std::size_t field_ = 0;  // where the last field was
  Checksum sum_;
  Places places_;
};

// --- Words ---

namespace detail {

inline std::string as_word(std::string_view text) { return std::string(text); }
inline std::string as_word(char letter) { return std::string(1, letter); }
template <std::unsigned_integral Number>
std::string as_word(Number n) {
  return std::to_string(n);
}
template <class Tag>
std::string as_word(Id<Tag> id) {
  return Tag::prefix + (id.is_none() ? "none" : std::to_string(id.index()));
}

}  // namespace detail

template <class... Words>
void TextReader::fail_at(std::size_t number, const Words&... words) {
  std::string message = "line " + std::to_string(number) + ": ";
  ((message += detail::as_word(words)), ...);
  throw std::invalid_argument(message);
}

template <class... Words>
void BinaryReader::fail_at(std::size_t offset, const Words&... words) {
  std::string message = "byte " + std::to_string(offset) + ": ";
  ((message += detail::as_word(words)), ...);
  throw std::invalid_argument(message);
}

}  // namespace loft::cdt
