// SPDX-License-Identifier: MIT
#include "io/contours/cli_header.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>
#include <vector>

#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/bytes/words.h"

namespace loft::io {

namespace {

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  CliHeader read() {
    constexpr std::string_view last = "$$HEADEREND";
    const std::size_t end = bytes_.find(last);
    if (end == std::string_view::npos)
      throw InputError(std::string(name_) +
                       ": $$HEADEREND is missing; it is cut off, or no CLI file");
    header_.end = end + last.size();
    for (std::size_t place = bytes_.find("$$"); place < end;) {
      const std::size_t next = std::min(bytes_.find("$$", place + 2), end);
      read_entry(place, without_blanks(bytes_.substr(place + 2, next - place - 2)));
      place = next;
    }
    if (!has_units_)
      problems_.add(std::string(name_) + ": $$UNITS is missing; write how many mm a unit is, " +
                    "$$UNITS/1 for millimetres");
    problems_.raise(name_);
    return std::move(header_);
  }

 private:
  void complain(std::size_t place, const std::string& problem) {
    const auto line = 1 + std::ranges::count(bytes_.substr(0, place), '\n');
    problems_.add(std::string(name_) + ':' + std::to_string(line) + ": " + problem);
  }

  void read_entry(std::size_t place, std::string_view entry) {
    const std::size_t slash = std::min(entry.find('/'), entry.size());
    const std::string_view key = without_blanks(entry.substr(0, slash));
    std::string_view value = entry.substr(std::min(slash + 1, entry.size()));
    if (key == "BINARY") {
      header_.is_binary = true;
    } else if (key == "ALIGN") {
      header_.is_aligned = true;
    } else if (key == "UNITS") {
      read_units(place, value);
    } else if (key == "LABEL") {
      if (const auto id = cli_number(next_parameter(value)); id && std::abs(*id) < 1e15)
        header_.labels[static_cast<std::int64_t>(*id)] = json_text(one_line(without_blanks(value)));
    } else if (key == "LAYERS") {
      header_.layers = cli_number(value);
    } else if (key == "DIMENSION") {
      read_dimension(value);
    }
  }

  void read_units(std::size_t place, std::string_view value) {
    has_units_ = true;
    const auto units = cli_number(value);
    constexpr double smallest = 1e-15;
    if (units && *units >= smallest && *units <= 1 / smallest) {
      header_.units = *units;
    } else {
      complain(place, "$$UNITS: " + in_quotes(without_blanks(value)) +
                          " is no length; write how many mm a unit is");
    }
  }

  /// One that is no box only fails to tell signed coordinates from unsigned ones.
  void read_dimension(std::string_view value) {
    std::array<double, 6> box{};
    for (double& side : box) {
      const auto number = cli_number(next_parameter(value));
      if (!number) return;
      side = *number;
    }
    header_.dimension = box;
  }

  std::string_view bytes_;
  std::string_view name_;
  CliHeader header_;
  Problems problems_;
  bool has_units_ = false;
};

}  // namespace

CliHeader read_cli_header(std::string_view bytes, std::string_view name) {
  return HeaderReader(bytes, name).read();
}

std::optional<double> cli_number(std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return {};
  return number;
}

std::string_view next_parameter(std::string_view& list) {
  const std::size_t comma = std::min(list.find(','), list.size());
  const std::string_view first = list.substr(0, comma);
  list.remove_prefix(std::min(comma + 1, list.size()));
  return first;
}

}  // namespace loft::io
