// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace loft::fields {

/// What a line does to the surface through the values.
enum class LineKind {
  feature,  ///< a breakline: it has a value at each point, the surface has a crease along it
  soft,     ///< it has no values of its own: it lies on the surface that is there without it
  wall,     ///< it has a value on each side at each point: the surface jumps
  barrier,  ///< nothing crosses it: each side is as if the other one's values were not there
};

/// Whether nothing from one side of such a line enters the other.
[[nodiscard]] constexpr bool separates(LineKind kind) {
  return kind == LineKind::wall || kind == LineKind::barrier;
}

/// As it is written in files: "feature", "soft", "wall", "barrier".
[[nodiscard]] std::string_view name_of(LineKind kind);
[[nodiscard]] std::optional<LineKind> line_kind(std::string_view name);

}  // namespace loft::fields
