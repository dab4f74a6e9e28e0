// SPDX-License-Identifier: MIT
#include "app/commands/label_work.h"

#include <algorithm>
#include <set>

#include "app/commands/label_choice.h"
#include "app/commands/parts.h"

namespace loft::app {

namespace {

std::vector<std::string> names_of(const std::vector<LabelSize>& labels) {
  std::vector<std::string> names;
  for (const LabelSize& label : labels) names.push_back(label.label);
  return names;
}

std::vector<std::string> choose(const ReconstructCommand& command,
                                const std::vector<LabelSize>& labels) {
  std::vector<std::string> chosen =
      LabelChoice(command.only, command.except).chosen(names_of(labels));
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace

LabelWork::LabelWork(const ReconstructCommand& command, std::vector<LabelSize> labels,
                     std::span<const StackLabel> known)
    : chosen_(choose(command, labels)), outputs_(command, chosen_, names_of(labels), known) {
  is_labelled_ = labels.size() > 1 || !chosen_[0].empty();
  const std::set<std::string> hidden = hidden_labels(command, chosen_);
  hidden_.assign(hidden.begin(), hidden.end());
  std::erase_if(labels, [this](const LabelSize& label) {
    return !std::ranges::binary_search(chosen_, label.label);
  });
  for (const std::string& label : dealt(std::move(labels), command.shard))
    (outputs_.has(label) ? existing_ : labels_).push_back(label);
  outputs_.prepare(labels_);
}

bool LabelWork::is_hidden(const std::string& label) const {
  return std::ranges::binary_search(hidden_, label);
}

}  // namespace loft::app
