// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/edit.h"

namespace loft::io {

/// The slices that edits have left, by their heights: what a Reconstruction does with them, without
/// the surface.
class StackState {
 public:
  /// Returns what is wrong with the edit, and changes nothing then: a slice that is not there.
  /// A slice inserted at a height that is there adds its contours to those there.
  std::optional<std::string> apply(const Edit& edit);

  [[nodiscard]] const std::map<double, Slice>& slices() const { return slices_; }
  /// From low to high.
  [[nodiscard]] std::vector<Slice> stack() const;

 private:
  std::map<double, Slice> slices_;
};

}  // namespace loft::io
