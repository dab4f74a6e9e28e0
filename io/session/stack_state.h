// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/stacks/edit.h"

namespace loft::io {

/// The slices that edits have left, by their heights: what a Reconstruction does with them, without
/// the surface.
class StackState {
 public:
  using SharedSlice = std::shared_ptr<const Slice>;

  /// Returns what is wrong with the edit, and changes nothing then: a slice that is not there
  /// (the nearest height is named).
  /// A slice inserted at a height that is there adds its contours to those there.
  std::optional<std::string> apply(const Edit& edit);
  /// What apply() would return.
  [[nodiscard]] std::optional<std::string> problem(const Edit& edit) const;
  /// What will be at the edit's height; null: nothing. Precondition: no problem.
  [[nodiscard]] SharedSlice after(const Edit& edit) const;
  /// Puts a slice to its height, in the place of what is there; null: nothing.
  void set(double z, SharedSlice slice);

  /// The slice at a height, or null.
  [[nodiscard]] SharedSlice find(double z) const;
  [[nodiscard]] const std::map<double, SharedSlice>& slices() const { return slices_; }
  /// From low to high.
  [[nodiscard]] std::vector<Slice> stack() const;

 private:
  std::map<double, SharedSlice> slices_;
};

}  // namespace loft::io
