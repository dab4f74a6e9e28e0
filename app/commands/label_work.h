// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/shard.h"
#include "app/commands/surface_outputs.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// Which labels of a stack a command is to work on: those that were chosen (--only, --except), of
/// these its shard, of these the ones whose files are not there yet (--skip-existing).
class LabelWork {
 public:
  /// `labels`: all that there are; of a stack without, one without a name. Throws UsageError where
  /// the choice or the outputs do not fit them.
  LabelWork(const ReconstructCommand& command, std::vector<LabelSize> labels,
            std::span<const StackLabel> known);

  /// To be worked on, sorted. One without a name for a stack without labels.
  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  /// Those of the shard that are not worked on, as their files are there.
  [[nodiscard]] const std::vector<std::string>& existing() const { return existing_; }
  /// Whether labels have names.
  [[nodiscard]] bool is_labelled() const { return is_labelled_; }
  /// That start hidden in viewers.
  [[nodiscard]] bool is_hidden(const std::string& label) const;
  /// How many labels were chosen, whoever works on them.
  [[nodiscard]] std::size_t chosen() const { return chosen_.size(); }
  [[nodiscard]] const SurfaceOutputs& outputs() const { return outputs_; }

 private:
  std::vector<std::string> chosen_;
  SurfaceOutputs outputs_;
  std::vector<std::string> labels_;
  std::vector<std::string> existing_;
  std::vector<std::string> hidden_;
  bool is_labelled_ = false;
};

}  // namespace loft::app
