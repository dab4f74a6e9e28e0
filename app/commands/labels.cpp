// SPDX-License-Identifier: MIT
#include "app/commands/labels.h"

#include "app/commands/place_of.h"
#include "app/exit_code.h"
#include "app/place.h"
#include "io/bytes/file.h"

namespace loft::app {

namespace {

void add_line(std::string& text, const std::string& line) {
  if (!text.empty()) text += '\n';
  text += line;
}

}  // namespace

void LabelProblems::add(const std::string& label, const InputError& error) {
  Options options;
  if (!label.empty()) options.label = label;
  const std::string message = with_place(error.what(), place_of(command_, options));
  add_line(all_, message);
  if (is_too_little(error)) {
    skipped_.push_back({label, message});
  } else {
    add_line(fatal_, message);
  }
}

void LabelProblems::raise(std::size_t label_count) const {
  if (!fatal_.empty() || (label_count > 0 && skipped_.size() == label_count))
    throw InputError(all_);
}

void check_labels_fit(std::size_t label_count, const std::filesystem::path& output) {
  if (label_count > 1 && io::extension(output) == ".stl")
    throw UsageError(
        output.string() + ": STL would make one solid of " + std::to_string(label_count) +
        " labels; write .glb, .ply or .obj, which keep them apart, or give a stack with "
        "one label");
}

}  // namespace loft::app
