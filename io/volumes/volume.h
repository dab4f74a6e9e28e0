// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// What pixels of a value stand for.
struct VolumeLabel {
  StackLabel label;
  std::uint32_t layer = 0;  ///< that the value is looked for in
  double value = 1;         ///< of volumes without a level; others have one label a layer
};

/// Pixels in slices, one behind the other: what readers of images make for trace() (outlines.h).
struct Volume {
  std::string name;  ///< of its file, for messages
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::uint32_t slices = 0;
  /// Masks that may overlap, each over all pixels; the labels of one layer do not.
  std::uint32_t layers = 1;

  /// From (column, row, slice, 1), counted from 0 at the centres of pixels, to the world: three
  /// rows of a matrix.
  std::array<std::array<double, 4>, 3> to_world{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  bool has_spacing = true;  ///< else the source does not know all distances, and has to be told
  /// Where slices lie, in the place of their index, if that is not it: for slices that are not
  /// evenly spaced. As many as slices, or none.
  std::vector<double> positions = {};
  std::string unit = {};

  /// What must be reached to be inside, for pixels that have shares, probabilities or grey. None:
  /// each value but 0 is a label.
  std::optional<double> level = {};
  std::vector<VolumeLabel> labels = {};  ///< what is known of them
  /// What others are, by their value, for those that do not just go by its number; may be empty.
  std::function<StackLabel(std::uint32_t value)> label_of = {};
  std::vector<std::string> notes = {};  ///< become the stack's

  /// Fills in one layer's pixels of one slice, row by row, columns * rows of them. Values that are
  /// not numbers are outside of all labels. Slices are asked for in order, in each all layers.
  std::function<void(std::uint32_t slice, std::uint32_t layer, std::span<double> pixels)> read;
};

}  // namespace loft::io
