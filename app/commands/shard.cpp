// SPDX-License-Identifier: MIT
#include "app/commands/shard.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <queue>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

namespace loft::app {

namespace {

std::optional<std::size_t> shard_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

}  // namespace

std::optional<Shard> shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return {};
  const auto index = shard_number(std::string_view(text).substr(0, slash));
  const auto count = shard_number(std::string_view(text).substr(slash + 1));
  constexpr std::size_t most = 1'000'000;
  if (!index || !count || *index >= *count || *count > most) return {};
  return Shard{*index, *count};
}

std::string complain_of_shard(const std::string& text) {
  if (shard(text)) return {};
  return "'" + text + "' is no shard; give I/N, I from 0 to N - 1, as 0/100 to 99/100";
}

std::vector<std::string> dealt(std::vector<LabelSize> labels, const Shard& shard) {
  std::ranges::sort(labels, {}, [](const LabelSize& one) {
    return std::tuple(~one.size, std::string_view(one.label));
  });
  using Load = std::pair<std::size_t, std::size_t>;  // what there is to do, the shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (std::size_t i = 0; i < shard.count; ++i) least.emplace(0, i);
  std::vector<std::string> mine;
  for (const auto& [label, size] : labels) {
    const auto [load, index] = least.top();
    least.pop();
    least.emplace(load + std::max<std::size_t>(1, size), index);
    if (index == shard.index) mine.push_back(label);
  }
  std::ranges::sort(mine);
  return mine;
}

}  // namespace loft::app
