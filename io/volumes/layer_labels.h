// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/volumes/volume.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// The labels of a volume, numbered from 1: those it knows of first, others as they are met. Each
/// has a name of its own.
class LayerLabels {
 public:
  explicit LayerLabels(const Volume& volume);

  /// Pixels of that slice and layer come next.
  void begin(std::uint32_t slice, std::uint32_t layer);
  /// The label of a pixel with that value, 0 for none. Throws InputError for a value that stands
  /// for no label.
  [[nodiscard]] std::uint32_t of(double value) {
    if (value == last_value_) return last_label_;  // mostly
    last_label_ = find(value);
    last_value_ = value;
    return last_label_;
  }
  [[nodiscard]] const std::string& name(std::uint32_t label) const {
    return labels_[label - 1].label.name;
  }

  /// Adds the labels that have been met to a stack, and notes of those that have not.
  void tell(Stack& stack) const;

 private:
  struct Met {
    StackLabel label;
    bool is_met = false;
    bool is_told = false;  ///< by the volume
  };

  std::uint32_t add(StackLabel label, bool is_told);
  [[nodiscard]] std::uint32_t find(double value);
  [[nodiscard]] std::uint32_t meet(std::uint32_t label);
  [[nodiscard]] StackLabel named(std::uint32_t value) const;
  [[noreturn]] void refuse(double value) const;

  const Volume& volume_;
  std::vector<Met> labels_;
  std::set<std::string> names_;
  std::vector<std::map<double, std::uint32_t>> by_value_;  ///< for each layer
  std::uint32_t slice_ = 0;
  std::uint32_t layer_ = 0;
  double last_value_ = 0;
  std::uint32_t last_label_ = 0;
};

}  // namespace loft::io
