// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "reconstruct/defect.h"

namespace loft::io {

/// Gathers problems as lines of one message, so many and no more.
class Problems {
 public:
  void add(const std::string& problem) {
    constexpr std::size_t shown = 20;
    if (++count_ > shown) return;
    if (!text_.empty()) text_ += '\n';
    text_ += problem;
  }

  [[nodiscard]] bool is_empty() const { return count_ == 0; }

  /// Throws InputError if there are any. `name` is that of the file.
  void raise(std::string_view name) const {
    if (count_ == 0) return;
    const auto shown = static_cast<std::size_t>(std::ranges::count(text_, '\n')) + 1;
    if (shown == count_) throw InputError(text_);
    throw InputError(text_ + '\n' + std::string(name) + ": and " + std::to_string(count_ - shown) +
                     " more");
  }

 private:
  std::string text_;
  std::size_t count_ = 0;
};

/// Calls read(item) for each of several inputs; throws InputError with the problems of all.
template <class Items, class Read>
void gather_problems(const Items& items, Read read) {
  std::string problems;
  for (const auto& item : items) {
    try {
      read(item);
    } catch (const InputError& error) {
      if (!problems.empty()) problems += '\n';
      problems += error.what();
    }
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace loft::io
