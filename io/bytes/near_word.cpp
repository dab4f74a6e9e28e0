// SPDX-License-Identifier: MIT
#include "io/bytes/near_word.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "io/bytes/text.h"

namespace loft::io {

namespace {

constexpr std::size_t longest = 32;  // no word of ours is longer

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The least number of edits, by dynamic programming; `before` is the row of two letters ago.
std::size_t edits_between(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, longest + 1>;
  Row row{};
  Row last{};
  Row before{};
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = last;
    last = row;
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const bool is_same = lower(a[i - 1]) == lower(b[k - 1]);
      row[k] = std::min({last[k] + 1, row[k - 1] + 1, last[k - 1] + (is_same ? 0U : 1U)});
      const bool is_swapped = i > 1 && k > 1 && lower(a[i - 1]) == lower(b[k - 2]) &&
                              lower(a[i - 2]) == lower(b[k - 1]);
      if (is_swapped) row[k] = std::min(row[k], before[k - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::string> near_word(std::string_view word, std::span<const std::string_view> known,
                                     std::size_t most) {
  std::optional<std::string> best;
  std::size_t fewest = most + 1;
  for (const std::string_view one : known) {
    const std::size_t size = std::max(word.size(), one.size());
    if (size > longest) continue;
    const std::size_t edits = edits_between(word, one);
    const bool is_short = size < 3 && edits > 0;
    if (is_short || edits >= fewest) continue;
    fewest = edits;
    best = one;
  }
  return best;
}

void KeyWatch::note(std::string_view key) {
  if (const auto found = std::ranges::find(known_, key); found != known_.end()) {
    if (!came(key)) came_.push_back(*found);
    return;
  }
  constexpr std::size_t enough = 8;
  if (suspects_.size() == enough) return;
  if (auto near = near_word(key, known_, 1))
    suspects_.push_back({std::string(key), std::move(*near)});
}

bool KeyWatch::came(std::string_view known) const {
  return std::ranges::find(came_, known) != came_.end();
}

std::vector<std::string> KeyWatch::misspelt() const {
  std::vector<std::string> problems;
  for (const auto& [key, known] : suspects_)
    if (!came(known))
      problems.push_back("unknown key " + in_quotes(key) + "; write \"" + known + '"');
  return problems;
}

bool KeyWatch::lacks(std::string_view known) const {
  return !came(known) && std::ranges::find(suspects_, known, &Suspect::known) == suspects_.end();
}

}  // namespace loft::io
