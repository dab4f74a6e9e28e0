// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/terminal.h"
#include "io/meshes/part.h"
#include "io/precomputed.h"

namespace loft::app {

/// Finds out early what would make the work useless, as far as that is known before the stack is.
void check_outputs(const ReconstructCommand& command);

/// Outputs for all labels that --skip-existing leaves as they are.
[[nodiscard]] std::vector<std::filesystem::path> outputs_left(const ReconstructCommand& command);

/// Whether each output has a file of its own for each label, so that a label can be written, and
/// forgotten, as soon as it is made.
[[nodiscard]] bool are_per_label(const ReconstructCommand& command);

/// Whether all that is asked for is known to be there without reading the stack: outputs for all
/// labels, and files of labels where --only names them.
[[nodiscard]] bool is_all_there(const ReconstructCommand& command);

/// Where the surfaces of a stack's labels go.
class SurfaceOutputs {
 public:
  /// `labels`: all that were chosen, whoever works on them; `all`: those of the stack.
  /// Throws UsageError where two of them would share a file.
  SurfaceOutputs(const ReconstructCommand& command, const std::vector<std::string>& labels,
                 const std::vector<std::string>& all, std::span<const StackLabel> known);

  /// Whether nothing has to be made of a label: with --skip-existing, if all its files are there.
  [[nodiscard]] bool has(const std::string& label) const;
  /// Whether these labels could be written now; makes folders of meshes. Throws what writing would.
  void prepare(const std::vector<std::string>& labels) const;

  /// Writes the files that are of one label alone. False if there are none.
  bool write_label(const io::Part& part, Terminal& terminal) const;
  /// Writes the files that are of all labels.
  void write_all(std::span<const io::Part> parts, Terminal& terminal) const;

 private:
  struct Output {
    std::filesystem::path name;                          // as given
    std::map<std::string, std::filesystem::path> files;  // by label; none: one file for all
    std::optional<io::Precomputed> meshes;
  };

  [[nodiscard]] bool is_left(const std::filesystem::path& file) const;
  void write(const std::filesystem::path& file, std::span<const io::Part> parts,
             Terminal& terminal) const;

  const ReconstructCommand& command_;
  std::vector<Output> outputs_;
};

}  // namespace loft::app
