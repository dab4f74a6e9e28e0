// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::app {

/// Which labels of a stack are wanted: `--only` and `--except`, names or patterns with `*`, `?` and
/// `[...]`; `@FILE` stands for the lines of a file.
class LabelChoice {
 public:
  /// Reads the files. Throws FileError.
  LabelChoice(const std::vector<std::string>& only, const std::vector<std::string>& except);

  [[nodiscard]] bool is_all() const { return only_.empty() && except_.empty(); }
  [[nodiscard]] bool has(const std::string& label) const;

  /// Takes the other labels out, with their contours. Throws UsageError that names what no label
  /// is called, or if none is left.
  void apply(Stack& stack) const;
  /// The same for a list of labels.
  [[nodiscard]] std::vector<std::string> chosen(const std::vector<std::string>& labels) const;

 private:
  std::vector<std::string> only_;
  std::vector<std::string> except_;
};

}  // namespace loft::app
