// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/capture/net_change.h"
#include "io/session/stack_state.h"
#include "io/stacks/edit.h"
#include "reconstruct/options.h"
#include "reconstruct/reconstruction.h"

namespace loft::app {

/// A stack that edits come for, with a surface for each label in it: all through the same slices.
/// A label has one from the edit on in which it came up first.
class LabelledSurfaces {
 public:
  struct Part {
    std::string label;
    std::unique_ptr<Reconstruction> surface;
  };
  /// What was at a height, and what is there now; null: nothing.
  struct Exchange {
    double z = 0;
    io::StackState::SharedSlice before;
    io::StackState::SharedSlice after;

    [[nodiscard]] Exchange reversed() const { return {z, after, before}; }
  };

  /// Options::label is ignored.
  explicit LabelledSurfaces(Options options) : options_(std::move(options)) {}

  /// Applies an edit to all surfaces, or to none: throws Error where it makes no sense, or a
  /// surface cannot be made. What becomes of slabs is added to `change`; there it is even if it
  /// throws.
  Exchange apply(const io::Edit& edit, NetChange& change);
  /// Undoes what apply() did last.
  void take_back(const Exchange& exchange, NetChange& change);

  /// Begins a surface for each label of a slice that has none.
  void add_labels(const Slice& slice, NetChange& change);
  /// Puts a slice into all surfaces, that of a height where there is none. Throws Error; then this
  /// can only be destroyed.
  void insert(const io::StackState::SharedSlice& slice);

  /// In the order in which labels came up.
  [[nodiscard]] std::span<const Part> parts() const { return parts_; }
  [[nodiscard]] const io::StackState& stack() const { return stack_; }
  [[nodiscard]] Json counts() const;
  [[nodiscard]] double volume() const;

 private:
  void put(const Exchange& exchange, NetChange& change);
  void warn_of_stairs(const Slice& slice, NetChange& change);

  Options options_;
  io::StackState stack_;
  std::vector<Part> parts_;
  bool has_warned_ = false;  // of stairs
};

}  // namespace loft::app
