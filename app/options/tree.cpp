// SPDX-License-Identifier: MIT
#include "app/options/tree.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace loft::app {

namespace {

/// `RULE` of `RULE:{evenodd,nonzero}`, `N` of `N:UINT in [0 - 1024]`.
std::string argument_of(const CLI::Option& option) {
  if (option.get_expected_max() == 0) return {};
  if (option.get_positional()) return option.get_single_name();
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

/// What is between the braces there.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.rfind('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

OptionNote note_of(const CLI::Option& option) {
  OptionNote note;
  for (const std::string& name : option.get_snames()) note.names.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) note.names.push_back("--" + name);
  note.argument = argument_of(option);
  note.choices = choices_of(option);
  if (note.choices.empty() && note.argument == "UNIT")
    note.choices = {"m", "cm", "mm", "um", "nm", "in", "ft"};
  note.text = option.get_description();
  note.is_required = option.get_required();
  note.is_list = option.get_expected_max() > 1;
  return note;
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* sub : program.get_subcommands([](const CLI::App*) { return true; }))
    if (!sub->get_group().empty()) names.push_back(sub->get_name());
  return names;
}

CommandNote note_of(const CLI::App& app, const std::string& name) {
  CommandNote note{name, app.get_description(), app.get_footer(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) note.options.push_back(note_of(*option));
  for (OptionNote& option : note.options)
    if (option.argument == "COMMAND") option.choices = command_names(*app.get_parent());
  std::stable_partition(note.options.begin(), note.options.end(),
                        [](const OptionNote& option) { return option.is_positional(); });
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!sub->get_group().empty())
      note.commands.push_back(note_of(*sub, name + (name.empty() ? "" : " ") + sub->get_name()));
  return note;
}

}  // namespace

bool OptionNote::is_file() const {
  constexpr std::array<std::string_view, 6> files{"IN", "OUT", "OUT.glb", "FILE", "MESH", "STACK"};
  return std::ranges::find(files, argument) != files.end();
}

CommandNote tree_of(const CLI::App& app) { return note_of(app, ""); }

std::string first_clause(const std::string& text) {
  return text.substr(
      0, std::min({text.find(';'), text.find(':'), text.find(" ("), text.find(", default")}));
}

}  // namespace loft::app
