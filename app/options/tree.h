// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace loft::app {

/// An option or an argument, as documents show it.
struct OptionNote {
  std::vector<std::string> names;  ///< `-o`, `--output`; none for an argument
  std::string argument;            ///< `OUT`; empty for a flag
  std::vector<std::string> choices;
  std::string text;
  bool is_required = false;
  bool is_list = false;  ///< as many as there are

  [[nodiscard]] bool is_positional() const { return names.empty(); }
  /// Whether it is given a file.
  [[nodiscard]] bool is_file() const;
};

/// A command with its options and the commands below it.
struct CommandNote {
  std::string name;  ///< as it is typed behind `loft`: `session list`; empty for the program
  std::string text;
  std::string footer;
  std::vector<OptionNote> options;  ///< in the order of the help
  std::vector<CommandNote> commands;

  /// Its last word.
  [[nodiscard]] std::string word() const { return name.substr(name.rfind(' ') + 1); }
};

/// What is told of a program: all commands and options that are not hidden.
[[nodiscard]] CommandNote tree_of(const CLI::App& app);

/// Calls visit(command) for all commands of a tree, from the top.
template <class Visit>
void for_each_command(const CommandNote& command, const Visit& visit) {
  visit(command);
  for (const CommandNote& below : command.commands) for_each_command(below, visit);
}

/// The first clause of a text, short enough for a menu.
[[nodiscard]] std::string first_clause(const std::string& text);

}  // namespace loft::app
