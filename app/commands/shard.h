// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace loft::app {

/// One of several jobs that share the labels of a stack: `--shard 0/100` to `--shard 99/100`.
struct Shard {
  std::size_t index = 0;  ///< from 0
  std::size_t count = 1;

  [[nodiscard]] bool is_all() const { return count == 1; }
};

/// `I/N` with I from 0 and below N; none for anything else.
[[nodiscard]] std::optional<Shard> shard(const std::string& text);
/// For the command line: what is wrong, empty if nothing is.
[[nodiscard]] std::string complain_of_shard(const std::string& text);

/// A label and how much there is to do: its vertices.
struct LabelSize {
  std::string label;
  std::size_t size = 0;
};

/// The labels of one shard, sorted. Largest first, each goes to the shard that has least to do, the
/// first of these; of labels of one size those whose name comes first go first.
///
/// Law: each label is in exactly one of the shards, and which one that is depends on names and
/// sizes only, so that jobs on different machines agree. No shard has more to do than another by
/// more than the largest label. Cost: O(n log n) in labels and shards.
[[nodiscard]] std::vector<std::string> dealt(std::vector<LabelSize> labels, const Shard& shard);

}  // namespace loft::app
