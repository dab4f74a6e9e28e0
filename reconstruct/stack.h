// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft {

/// A colour as files and screens have it: sRGB, from 0 to 255.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

/// A structure that contours belong to, with what its source tells of it.
struct StackLabel {
  std::string name;                   ///< as Contour::label
  std::optional<Colour> colour = {};  ///< none: the source has none
  std::string id = {};                ///< what the source calls it: a ROI number, a label's value
  std::string kind = {};              ///< RT interpreted type, category of a segment; may be empty
  std::optional<double> gap = {};     ///< thickness of its slices, where it has one of its own

  friend bool operator==(const StackLabel&, const StackLabel&) = default;
};

/// Null where there is none of that name.
[[nodiscard]] const StackLabel* find(std::span<const StackLabel> labels, std::string_view name);

/// Where the slices of a stack lie in the world: x, y in a slice and its z, by a matrix whose last
/// row is 0 0 0 1. Right-handed (its determinant is positive), so that outside stays outside.
struct WorldFrame {
  std::array<std::array<double, 4>, 4> rows{
      {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  [[nodiscard]] Vec3 at(const Vec3& place) const;
  [[nodiscard]] double determinant() const;
  [[nodiscard]] bool is_identity() const { return *this == WorldFrame(); }

  friend bool operator==(const WorldFrame&, const WorldFrame&) = default;
};

/// What is wrong with a frame that comes from a file, and the way out; empty if it can be used: its
/// numbers are admitted, its last row is 0 0 0 1, its determinant positive and not lost in
/// rounding.
[[nodiscard]] std::string fault(const WorldFrame& frame);

/// Slices, and what their source says of them.
struct Stack {
  std::vector<Slice> slices;
  std::string unit = {};                 ///< `mm`, `um`, ...; empty where the source has none
  std::optional<WorldFrame> frame = {};  ///< none: slices are level, their coordinates the world's
  std::vector<StackLabel> labels = {};   ///< those that the source tells more of than the name
  std::optional<Fill> fill = {};         ///< the rule that the source means
  std::optional<double> keyhole_width = {};  ///< of channels as the source draws them
  std::optional<double> gap = {};  ///< thickness of a slice, for stacks of one: the source's word
  std::vector<std::string> notes = {};  ///< what was left out, and why; one line each

  /// Null where the source tells nothing of it.
  [[nodiscard]] const StackLabel* find_label(std::string_view name) const;

  friend bool operator==(const Stack&, const Stack&) = default;
};

}  // namespace loft
