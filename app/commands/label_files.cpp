// SPDX-License-Identifier: MIT
#include "app/commands/label_files.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "app/exit_code.h"
#include "io/bytes/text.h"

namespace loft::app {

namespace {

constexpr std::string_view placeholder = "{label}";

/// A label as a part of a file's name on any system.
std::string as_name(std::string_view label) {
  std::string name = io::one_line(label);
  for (char& c : name)
    if (std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos) c = '_';
  while (name.starts_with('.') || name.starts_with(' ')) name[0] = '_';
  while (name.ends_with('.') || name.ends_with(' ')) name.back() = '_';
  constexpr std::size_t longest = 200;
  if (name.size() > longest) {
    name.resize(longest);  // not within a character of UTF-8
    while (!name.empty() && (static_cast<unsigned char>(name.back()) & 0xc0U) == 0x80U)
      name.pop_back();
    if (!name.empty() && static_cast<unsigned char>(name.back()) >= 0xc0U) name.pop_back();
  }
  return name.empty() ? "surface" : name;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

bool is_per_label(const std::filesystem::path& output) {
  return output.string().find(placeholder) != std::string::npos;
}

std::vector<std::filesystem::path> label_files(const std::filesystem::path& output,
                                               std::span<const std::string> labels) {
  std::vector<std::filesystem::path> files;
  std::map<std::string, std::string> seen;  // labels, by their files
  for (const std::string& label : labels) {
    std::string file = output.string();
    const std::string name = as_name(label);
    for (auto at = file.find(placeholder); at != std::string::npos;
         at = file.find(placeholder, at + name.size()))
      file.replace(at, placeholder.size(), name);
    const auto [other, is_new] = seen.try_emplace(lower(file), label);
    if (!is_new)
      throw UsageError("labels " + io::in_quotes(other->second) + " and " + io::in_quotes(label) +
                       " would both be written to " + file +
                       "; choose one with --only, or write one file with all labels");
    files.emplace_back(file);
  }
  return files;
}

}  // namespace loft::app
