// SPDX-License-Identifier: MIT
#include "app/commands/label_choice.h"

#include <fnmatch.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string_view>

#include "app/exit_code.h"
#include "io/bytes/file.h"
#include "io/bytes/near_word.h"
#include "io/bytes/text.h"
#include "reconstruct/reconstruct.h"

namespace loft::app {

namespace {

bool matches(const std::string& pattern, const std::string& label) {
  return pattern == label || fnmatch(pattern.c_str(), label.c_str(), 0) == 0;
}

bool match_any(const std::vector<std::string>& patterns, const std::string& label) {
  return std::ranges::any_of(patterns,
                             [&](const std::string& pattern) { return matches(pattern, label); });
}

/// `@FILE` becomes the lines of the file.
std::vector<std::string> read(const std::vector<std::string>& words) {
  std::vector<std::string> patterns;
  for (const std::string& word : words) {
    if (!word.starts_with('@')) {
      patterns.push_back(word);
      continue;
    }
    std::istringstream lines(io::read_file(word.substr(1)));
    for (std::string line; std::getline(lines, line);) {
      if (line.ends_with('\r')) line.pop_back();
      if (!line.empty()) patterns.push_back(line);
    }
  }
  return patterns;
}

void require_known(const std::vector<std::string>& patterns,
                   const std::vector<std::string>& labels) {
  for (const std::string& pattern : patterns) {
    const auto is_meant = [&](const std::string& label) { return matches(pattern, label); };
    if (std::ranges::any_of(labels, is_meant)) continue;
    const std::vector<std::string_view> names(labels.begin(), labels.end());
    const auto near = io::near_word(pattern, names, 2);
    throw UsageError("no label is called " + io::in_quotes(pattern) +
                     (near ? "; did you mean " + io::in_quotes(*near) + "?"
                           : "; loft info lists those that there are"));
  }
}

}  // namespace

LabelChoice::LabelChoice(const std::vector<std::string>& only,
                         const std::vector<std::string>& except)
    : only_(read(only)), except_(read(except)) {}

bool LabelChoice::has(const std::string& label) const {
  return (only_.empty() || match_any(only_, label)) && !match_any(except_, label);
}

std::vector<std::string> LabelChoice::chosen(const std::vector<std::string>& labels) const {
  if (is_all()) return labels;
  require_known(only_, labels);
  require_known(except_, labels);
  std::vector<std::string> chosen;
  std::ranges::copy_if(labels, std::back_inserter(chosen),
                       [&](const std::string& label) { return has(label); });
  if (chosen.empty()) throw UsageError("--only and --except leave no label");
  return chosen;
}

void LabelChoice::apply(Stack& stack) const {
  if (is_all()) return;
  static_cast<void>(chosen(labels(stack.slices)));
  for (Slice& slice : stack.slices)
    std::erase_if(slice.contours, [&](const Contour& contour) { return !has(contour.label); });
  std::erase_if(stack.labels, [&](const StackLabel& label) { return !has(label.name); });
}

}  // namespace loft::app
