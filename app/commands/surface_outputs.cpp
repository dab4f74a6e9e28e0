// SPDX-License-Identifier: MIT
#include "app/commands/surface_outputs.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "app/commands/label_files.h"
#include "app/commands/labels.h"
#include "app/commands/parts.h"
#include "app/commands/written.h"
#include "app/interrupt.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "io/bytes/text.h"
#include "io/gltf/gltf.h"
#include "io/surfaces.h"
#include "io/unit.h"
#include "reconstruct/option_names.h"
#include "reconstruct/reconstruct.h"

namespace loft::app {

namespace {

using std::filesystem::path;

bool is_there(const path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

bool is_of_all(const path& output) {
  return !is_per_label(output) && !io::precomputed_folder(output);
}

io::WriteOptions write_options(const ReconstructCommand& command) {
  io::WriteOptions options;
  options.metres_per_unit = *io::metres_per_unit(command.unit);
  // File names only: the same stack gives the same bytes wherever it lies.
  for (const path& input : command.inputs) options.sources.push_back(input.filename().string());
  options.settings = settings_of(command.options);
  options.compression = command.compression;
  options.threads = command.options.threads;
  return options;
}

/// How far positions are moved in compressed glTF.
void tell_rounding(const ReconstructCommand& command, const path& output,
                   std::span<const io::Part> parts, const io::Written& written,
                   Terminal& terminal) {
  if (command.compression == io::Compression::none || command.quiet || !is_gltf(output)) return;
  std::string words = output.string() + ": positions are rounded by at most " +
                      io::short_number(io::quantisation_error(parts)) + ' ' + command.unit;
  if (written.rounding.moved > 0)
    words += "; " + counted(written.rounding.moved, "place") +
             " a few steps farther, so that it stays valid";
  terminal.say(words);
}

void check_folder(const path& folder) {
  if (folder.empty()) throw UsageError("precomputed://: a folder is wanted behind it");
  if (is_per_label(folder))
    throw UsageError(folder.string() +
                     ": a folder of meshes has all labels; leave {label} out of its name");
}

/// Each job would replace what the others have made.
void forbid_shares(const ReconstructCommand& command) {
  if (!command.shard.is_all())
    for (const path& output : command.outputs)
      if (is_of_all(output))
        throw UsageError(output.string() +
                         ": --shard makes some of the labels, and each job would replace the file "
                         "of the others; put {label} in its name, or write precomputed://FOLDER");
  if (command.volumes && (!command.shard.is_all() || command.skip_existing))
    throw UsageError(
        command.volumes->string() +
        ": a job that makes some of the labels only would replace the table by theirs; "
        "leave out --csv and take the reports of --json");
}

}  // namespace

void check_outputs(const ReconstructCommand& command) {
  check_gltf_options(command);
  forbid_shares(command);
  forbid_overwriting(command.inputs, command.outputs);
  if (command.links) forbid_overwriting(std::array{*command.links}, command.outputs);
  for (const path& output : command.outputs) {
    if (const auto folder = io::precomputed_folder(output)) check_folder(*folder);
    if (is_of_all(output)) io::check_writable(output);
  }
}

std::vector<path> outputs_left(const ReconstructCommand& command) {
  std::vector<path> left;
  for (const path& output : command.outputs)
    if (command.skip_existing && is_of_all(output) && is_there(output)) left.push_back(output);
  return left;
}

bool are_per_label(const ReconstructCommand& command) {
  return std::ranges::none_of(command.outputs, is_of_all);
}

bool is_all_there(const ReconstructCommand& command) {
  if (!command.skip_existing || !command.shard.is_all()) return false;
  // What is not there is found out by reading it.
  const auto exists = [](const path& input) {
    std::error_code ignored;
    return std::filesystem::exists(input, ignored);
  };
  if (!std::ranges::all_of(command.inputs, exists)) return false;
  const bool are_named =
      !command.only.empty() && command.except.empty() &&
      std::ranges::none_of(command.only, [](const std::string& label) {
        return label.starts_with('@') || label.find_first_of("*?[\\") != std::string::npos;
      });
  return std::ranges::all_of(command.outputs, [&](const path& output) {
    if (is_of_all(output)) return is_there(output);
    return are_named && is_per_label(output) &&
           std::ranges::all_of(label_files(output, command.only), is_there);
  });
}

SurfaceOutputs::SurfaceOutputs(const ReconstructCommand& command,
                               const std::vector<std::string>& labels,
                               const std::vector<std::string>& all,
                               std::span<const StackLabel> known)
    : command_(command) {
  for (const path& name : command.outputs) {
    Output& output = outputs_.emplace_back(Output{name, {}, {}});
    if (const auto folder = io::precomputed_folder(name)) {
      output.meshes.emplace(*folder, io::segments_of(all, known));
    } else if (is_per_label(name)) {
      const std::vector<path> files = label_files(name, labels);
      for (std::size_t i = 0; i < files.size(); ++i) output.files[labels[i]] = files[i];
    }
  }
}

bool SurfaceOutputs::has(const std::string& label) const {
  if (!command_.skip_existing) return false;
  return std::ranges::all_of(outputs_, [&](const Output& output) {
    if (output.meshes) return output.meshes->has(label);
    return is_there(output.files.empty() ? output.name : output.files.at(label));
  });
}

bool SurfaceOutputs::is_left(const path& file) const {
  return !command_.skip_existing || !is_there(file);
}

void SurfaceOutputs::prepare(const std::vector<std::string>& labels) const {
  for (const Output& output : outputs_) {
    if (output.meshes) {
      output.meshes->begin();
    } else if (output.files.empty()) {
      check_labels_fit(labels.size(), output.name);
    }
    for (const std::string& label : labels) {
      if (output.files.empty()) break;
      const path& file = output.files.at(label);
      forbid_overwriting(command_.inputs, std::array{file});
      io::check_writable(file);
    }
  }
}

bool SurfaceOutputs::write_label(const io::Part& part, Terminal& terminal) const {
  for (const Output& output : outputs_) {
    if (output.meshes && (!command_.skip_existing || !output.meshes->has(part.label))) {
      if (is_interrupted()) throw Cancelled();
      tell(output.name, output.meshes->write(part, *io::metres_per_unit(command_.unit)), terminal);
    } else if (!output.files.empty() && is_left(output.files.at(part.label))) {
      write(output.files.at(part.label), {&part, 1}, terminal);
    }
  }
  return std::ranges::any_of(
      outputs_, [](const Output& output) { return output.meshes || !output.files.empty(); });
}

void SurfaceOutputs::write_all(std::span<const io::Part> parts, Terminal& terminal) const {
  for (const Output& output : outputs_)
    if (is_of_all(output.name) && is_left(output.name)) write(output.name, parts, terminal);
}

void SurfaceOutputs::write(const path& file, std::span<const io::Part> parts,
                           Terminal& terminal) const {
  if (is_interrupted()) throw Cancelled();
  const io::Written written = io::write(file, parts, write_options(command_));
  tell(file, written, terminal);
  tell_rounding(command_, file, parts, written, terminal);
}

}  // namespace loft::app
