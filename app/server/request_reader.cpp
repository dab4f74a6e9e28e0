// SPDX-License-Identifier: MIT
#include "app/server/request_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace loft::app {

namespace {

constexpr std::string_view line_end = "\r\n";
constexpr std::size_t longest_chunk_line = 256;

bool is_token_character(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') ||
         std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

bool is_token(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, is_token_character);
}

bool has_control_character(std::string_view text) {
  return std::ranges::any_of(text, [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && c != '\t') || code == 0x7f;
  });
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// The number that a text is, all of it: digits, no sign.
std::optional<std::size_t> number(std::string_view text, int base) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

RequestReader::State RequestReader::read(std::string_view bytes) {
  if (state_ == State::refused) return state_;
  pending_.append(bytes);
  return step();
}

RequestReader::State RequestReader::next() {
  std::string rest = std::move(pending_);
  *this = RequestReader(limits_);
  pending_ = std::move(rest);
  return step();
}

std::string_view RequestReader::path() const {
  return std::string_view(target_).substr(0, target_.find('?'));
}

std::string RequestReader::take_request() {
  std::string request = std::move(head_);
  if (framing_ != Framing::none)
    request += "Content-Length: " + std::to_string(body_.size()) + "\r\n";
  request += line_end;
  request += body_;
  head_.clear();
  body_ = {};
  return request;
}

RequestReader::State RequestReader::step() {
  if (state_ == State::head) read_head();
  if (state_ == State::body) return framing_ == Framing::length ? read_length() : read_chunks();
  return state_;
}

RequestReader::State RequestReader::read_head() {
  const std::size_t from = scanned_ < 3 ? 0 : scanned_ - 3;
  const std::size_t end = pending_.find("\r\n\r\n", from);
  scanned_ = pending_.size();
  // Of what has no end yet, a part of the end may be there already.
  const std::size_t least = pending_.size() < 3 ? 0 : pending_.size() - 3;
  if ((end == std::string::npos ? least : end) > limits_.most_head)
    return refuse(431, "the head of the request is too long");
  if (end == std::string::npos) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(pending_, '\n'));
    return lines > limits_.most_headers + 1 ? refuse(431, "too many headers") : state_;
  }
  const std::string head = pending_.substr(0, end + line_end.size());
  pending_.erase(0, end + 2 * line_end.size());
  std::size_t count = 0;
  for (std::string_view rest = head; !rest.empty() && state_ == State::head; ++count) {
    const std::size_t length = rest.find(line_end);
    const std::string_view line = rest.substr(0, length);
    rest.remove_prefix(length + line_end.size());
    if (count > limits_.most_headers) return refuse(431, "too many headers");
    if (has_control_character(line)) return refuse(400, "a control character in the head");
    count == 0 ? read_request_line(line) : read_header(line);
  }
  if (state_ != State::head) return state_;
  state_ = framing_ == Framing::none ? State::whole : State::body;
  return state_;
}

void RequestReader::read_request_line(std::string_view line) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  const bool has_parts = first != std::string_view::npos && last > first + 1;
  const std::string_view version = has_parts ? line.substr(last + 1) : std::string_view();
  if (version != "HTTP/1.1" && version != "HTTP/1.0") {
    refuse(400, "the request was not understood");
    return;
  }
  method_ = line.substr(0, first);
  target_ = line.substr(first + 1, last - first - 1);
  if (!is_token(method_) || target_.find(' ') != std::string::npos) {
    refuse(400, "the request was not understood");
    return;
  }
  if (target_.size() > 8000) {
    refuse(414, "the address is too long");
    return;
  }
  head_ = std::string(line) + "\r\n";
}

void RequestReader::read_header(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon))) {
    refuse(400, "a header was not understood");
    return;
  }
  const std::string name = lower(line.substr(0, colon));
  const std::string_view value = without_blanks(line.substr(colon + 1));
  if (name == "host" && std::exchange(has_host_, true)) {
    refuse(400, "two hosts");
    return;
  }
  if (value.size() > 8000) {
    refuse(431, "a header is too long");
    return;
  }
  // Ranges are not served: a few bytes of them can ask for any number of copies.
  static constexpr std::array<std::string_view, 3> left_out{"range", "if-range", "trailer"};
  if (std::ranges::find(left_out, name) != left_out.end()) return;
  if (name == "content-length" || name == "transfer-encoding") return read_framing(name, value);
  if (name == "content-encoding" && lower(value) != "identity") {
    refuse(415, "send the body as it is, not compressed");
    return;
  }
  if (name == "expect") {
    is_expecting_ = lower(value) == "100-continue";
    if (!is_expecting_) refuse(417, "only 100-continue can be expected");
    return;
  }
  head_ += std::string(line.substr(0, colon)) + ": " + std::string(value) + "\r\n";
}

void RequestReader::read_framing(const std::string& name, std::string_view value) {
  if (framing_ != Framing::none) {
    refuse(400, "the length of the body is said twice");
    return;
  }
  if (name == "transfer-encoding") {
    if (lower(value) != "chunked") {
      refuse(501, "bodies come whole, or in chunks");
      return;
    }
    framing_ = Framing::chunks;
    return;
  }
  const auto length = number(value, 10);
  if (!length) {
    // Digits that are no number are one that is too large.
    const bool is_large =
        !value.empty() && value.find_first_not_of("0123456789") == std::string_view::npos;
    refuse(is_large ? 413 : 400, is_large ? "the body is too large; send fewer slices at once"
                                          : "the length of the body is no number");
    return;
  }
  if (*length > limits_.most_body) {
    refuse(413, "the body is too large; send fewer slices at once");
    return;
  }
  framing_ = Framing::length;
  left_ = *length;
}

RequestReader::State RequestReader::read_length() {
  const std::size_t count = std::min(left_, pending_.size());
  body_.append(pending_, 0, count);
  pending_.erase(0, count);
  left_ -= count;
  if (left_ == 0) state_ = State::whole;
  return state_;
}

RequestReader::State RequestReader::read_chunks() {
  std::size_t place = 0;
  while (state_ == State::body) {
    if (chunk_ == Chunk::data) {
      const std::size_t count = std::min(left_, pending_.size() - place);
      body_.append(pending_, place, count);
      place += count;
      left_ -= count;
      if (left_ > 0) break;
      chunk_ = Chunk::data_end;
    }
    const std::size_t end = pending_.find(line_end, place);
    const bool has_end = end != std::string::npos;
    if ((has_end ? end : pending_.size()) - place > longest_chunk_line + (has_end ? 0 : 1))
      return refuse(400, "a line between chunks is too long");
    if (end == std::string::npos) break;
    const std::string line = pending_.substr(place, end - place);
    place = end + line_end.size();
    if (!read_chunk_line(line)) return state_;
  }
  pending_.erase(0, place);
  return state_;
}

/// False if it was refused.
bool RequestReader::read_chunk_line(std::string_view line) {
  if (chunk_ == Chunk::trailer) {
    trailer_size_ += line.size() + line_end.size();
    if (line.empty()) state_ = State::whole;
    return trailer_size_ <= 4096 ||
           refuse(431, "what follows the body is too long") == State::whole;
  }
  if (chunk_ == Chunk::data_end) {
    chunk_ = Chunk::size;
    return line.empty() || refuse(400, "a chunk is longer than it says") == State::whole;
  }
  const auto size = number(without_blanks(line.substr(0, line.find(';'))), 16);
  if (!size || has_control_character(line)) {
    refuse(400, "the size of a chunk is no number");
    return false;
  }
  if (*size > limits_.most_body - body_.size()) {
    refuse(413, "the body is too large; send fewer slices at once");
    return false;
  }
  left_ = *size;
  chunk_ = *size == 0 ? Chunk::trailer : Chunk::data;
  return true;
}

RequestReader::State RequestReader::refuse(int status, std::string why) {
  refusal_ = {status, std::move(why)};
  pending_ = {};
  body_ = {};
  state_ = State::refused;
  return state_;
}

}  // namespace loft::app
