// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>

#include "io/bytes/words.h"
#include "io/volumes/meta_image_header.h"

namespace loft::io {

namespace {

constexpr std::uint64_t most_files = 1'000'000;

/// A name with a number in it.
struct Pattern {
  std::string_view before;
  std::string_view behind;
  std::size_t width = 0;
  char filling = ' ';

  [[nodiscard]] std::string with(std::uint64_t number) const {
    const std::string digits = std::to_string(number);
    const std::size_t missing = width - std::min(width, digits.size());
    return std::string(before) + std::string(missing, filling) + digits + std::string(behind);
  }
};

std::optional<std::uint64_t> count_in(std::string_view text) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  constexpr std::uint64_t largest = 1'000'000'000'000;
  if (error != std::errc() || end != text.data() + text.size() || count > largest) return {};
  return count;
}

std::optional<Pattern> pattern_in(std::string_view text) {
  const std::size_t percent = text.find('%');
  if (percent == std::string_view::npos) return {};
  Pattern pattern{text.substr(0, percent), text.substr(percent + 1)};
  if (pattern.behind.starts_with('0')) pattern.filling = '0';
  const std::size_t digits = std::min(pattern.behind.find_first_not_of("0123456789"), text.size());
  constexpr std::size_t most_digits = 3;
  if (digits > most_digits || digits >= pattern.behind.size()) return {};
  if (digits > 0) pattern.width = count_in(pattern.behind.substr(0, digits)).value_or(0);
  const char kind = pattern.behind[digits];
  pattern.behind.remove_prefix(digits + 1);
  const bool is_number = kind == 'd' || kind == 'i' || kind == 'u';
  if (!is_number || pattern.behind.find('%') != std::string_view::npos) return {};
  return pattern;
}

}  // namespace

std::vector<std::string> names_by_pattern(std::string_view text, std::uint64_t count) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.empty() || words.size() > 4 || count == 0 || count > most_files) return {};
  const auto pattern = pattern_in(words[0]);
  const auto number = [&](std::size_t i, std::uint64_t otherwise) {
    return words.size() > i ? count_in(words[i]) : otherwise;
  };
  const auto first = number(1, 1);
  const auto step = number(3, 1);
  if (!pattern || !first || !step || *step == 0) return {};
  const auto last = number(2, *first + (count - 1) * *step);
  if (!last || *last < *first || (*last - *first) / *step + 1 != count) return {};
  std::vector<std::string> names;
  for (std::uint64_t i = 0; i < count; ++i) names.push_back(pattern->with(*first + i * *step));
  return names;
}

}  // namespace loft::io
