// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/reconstruct_report.h"
#include "reconstruct/defect.h"

namespace loft::app {

/// What becomes of labels that no surface can be made of: those with too few slices are skipped, so
/// that they stop no others; what is wrong with any other is gathered, and fatal.
class LabelProblems {
 public:
  explicit LabelProblems(const ReconstructCommand& command) : command_(command) {}

  void add(const std::string& label, const InputError& error);
  /// Throws InputError if anything is fatal, or all of so many labels that were asked for, by
  /// whatever job, are skipped here.
  void raise(std::size_t label_count) const;
  [[nodiscard]] const std::vector<SkippedLabel>& skipped() const { return skipped_; }

 private:
  const ReconstructCommand& command_;
  std::vector<SkippedLabel> skipped_;
  std::string fatal_;
  std::string all_;
};

/// Throws UsageError where there are several labels and the output would make them one solid.
void check_labels_fit(std::size_t label_count, const std::filesystem::path& output);

}  // namespace loft::app
