// SPDX-License-Identifier: MIT
#include "fields/line.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace loft::fields {

namespace {

// In the order of LineKind.
constexpr std::array<std::string_view, 4> line_kind_names{"feature", "soft", "wall", "barrier"};

}  // namespace

std::string_view name_of(LineKind kind) { return line_kind_names[static_cast<std::size_t>(kind)]; }

std::optional<LineKind> line_kind(std::string_view name) {
  const auto found = std::find(line_kind_names.begin(), line_kind_names.end(), name);
  if (found == line_kind_names.end()) return std::nullopt;
  return static_cast<LineKind>(found - line_kind_names.begin());
}

}  // namespace loft::fields
