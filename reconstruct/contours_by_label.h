// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "reconstruct/defect.h"
#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft {

/// Where the contours of each label are in a stack, found in one reading; so that surfaces of all
/// labels do not read the stack once for each. Does not keep the stack.
class ContoursByLabel {
 public:
  explicit ContoursByLabel(std::span<const Slice> slices);

  /// Sorted; a contour without label counts as "".
  [[nodiscard]] std::vector<std::string> labels() const;
  /// In order; none where no contour has the label.
  [[nodiscard]] std::span<const ContourId> of(const std::string& label) const;
  /// Of all labels, see find_unusable().
  [[nodiscard]] const std::vector<Defect>& unusable() const { return unusable_; }

 private:
  std::map<std::string, std::vector<ContourId>> contours_;
  std::vector<Defect> unusable_;
};

}  // namespace loft
