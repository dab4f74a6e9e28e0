// SPDX-License-Identifier: MIT
#include "app/server/slab_ranges.h"

#include <algorithm>
#include <charconv>

namespace loft::app {

namespace {

/// Takes a number of at most nine digits from the beginning.
std::optional<std::uint32_t> take_id(std::string_view& text) {
  std::uint32_t id = 0;
  const char* const end = text.data() + std::min<std::size_t>(text.size(), 9);
  const auto [stop, error] = std::from_chars(text.data(), end, id);
  if (error != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return id;
}

bool take_mark(std::string_view& text, std::string_view mark) {
  if (!text.starts_with(mark)) return false;
  text.remove_prefix(mark.size());
  return true;
}

std::optional<SlabRange> take_range(std::string_view& text) {
  const auto part = take_id(text);
  if (!part || !take_mark(text, "-")) return {};
  const auto first = take_id(text);
  if (!first) return {};
  const auto last = take_mark(text, "..") ? take_id(text) : first;
  if (!last || *last < *first) return {};
  return SlabRange{*part, *first, *last};
}

}  // namespace

std::optional<std::vector<SlabRange>> parse_slab_ranges(std::string_view text) {
  std::vector<SlabRange> ranges;
  do {
    const auto range = take_range(text);
    if (!range) return {};
    ranges.push_back(*range);
  } while (take_mark(text, ","));
  if (!text.empty()) return {};
  return ranges;
}

}  // namespace loft::app
