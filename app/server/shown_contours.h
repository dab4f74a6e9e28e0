// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "reconstruct/slice.h"

namespace loft::app {

/// Contours that do not change, by their heights: slices of one height are one.
class ShownContours {
 public:
  explicit ShownContours(std::vector<Slice> slices);

  [[nodiscard]] std::optional<Slice> slice(double z) const;
  [[nodiscard]] std::vector<double> heights() const;
  /// The slices that have contours of a label.
  [[nodiscard]] std::size_t count(std::string_view label) const;
  [[nodiscard]] const std::map<double, Slice>& slices() const { return slices_; }

 private:
  std::map<double, Slice> slices_;
};

}  // namespace loft::app
