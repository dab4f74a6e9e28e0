// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reconstruct/defect.h"
#include "reconstruct/slice.h"

namespace loft {

/// What is wrong with the numbers of a slice (DefectKind::not_finite), of its contours with one
/// label or of all; `index` is its number in the stack.
[[nodiscard]] std::vector<Defect> find_unusable(const Slice& slice, std::uint32_t index,
                                                const std::optional<std::string>& label = {});

/// Throws InputError where contours have different labels and none is chosen: one solid of several
/// structures is nothing that anyone asked for.
class OneLabel {
 public:
  /// `chosen`: Options::label.
  explicit OneLabel(const std::optional<std::string>& chosen) : is_chosen_(chosen.has_value()) {}

  void add(const Slice& slice);
  void add(const std::string& label);

 private:
  bool is_chosen_;
  std::optional<std::string> label_;
};

}  // namespace loft
