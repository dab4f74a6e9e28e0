// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// Gathers the closed contours of a file, in any order, and makes slices of them: ascending, those
/// of one height (HeightGroups) in the order in which they came. Counts what is left out.
class StackBuilder {
 public:
  explicit StackBuilder(std::string_view name) : name_(name) {}

  /// Takes a contour whose points are from `lowest` to `highest`. A repeated first point is
  /// dropped; contours of fewer than three points are left out, and so are those that are found to
  /// be in no plane. Precondition: finite, `lowest` <= `highest`.
  void add(Contour contour, double lowest, double highest);
  void add(Contour contour, double height) { add(std::move(contour), height, height); }
  /// A height at which the file has a slice, be it empty.
  void add_height(double height) { heights_.push_back(height); }

  /// Counts something that is no contour: `open line`, `point`. Of each label one note says so.
  void skip(const std::string& label, const std::string& what, std::size_t count = 1) {
    if (count > 0) skipped_[label][what] += count;
  }
  /// What was left out of a label: `label 'axon': 3 open lines, 1 point left out`.
  [[nodiscard]] std::vector<std::string> notes() const;

  [[nodiscard]] bool is_empty() const { return contours_.empty(); }

  /// Gives slices and notes to a stack that may have others. Throws InputError where no contour is
  /// left, which says what there was instead, and ends in the way out, `advice`.
  void finish(Stack& stack, std::string_view advice);

 private:
  struct Raised {
    Contour contour;
    double lowest;
    double highest;
  };
  [[nodiscard]] double tolerance() const;
  void sort_out();
  [[noreturn]] void fail(std::string_view advice) const;

  std::string_view name_;
  std::vector<Raised> contours_;
  std::vector<double> heights_;
  std::map<std::string, std::map<std::string, std::size_t>> skipped_;
};

/// `1 open line`, `12 open lines`.
[[nodiscard]] std::string counted(std::size_t count, std::string_view what);

}  // namespace loft::io
