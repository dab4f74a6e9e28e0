// SPDX-License-Identifier: MIT
#include "app/options/completion.h"

#include <algorithm>
#include <sstream>

namespace loft::app {

namespace {

std::string joined(const std::vector<std::string>& words) { return CLI::detail::join(words, " "); }

/// In single quotes, for any of the shells; texts have no quotes that a reader would miss.
std::string quoted(std::string text) {
  std::erase(text, '\'');
  return '\'' + text + '\'';
}

std::vector<std::string> option_names(const CommandNote& command) {
  std::vector<std::string> names;
  for (const OptionNote& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::vector<std::string> words_of(const std::vector<CommandNote>& commands) {
  std::vector<std::string> words;
  for (const CommandNote& command : commands) words.push_back(command.word());
  return words;
}

/// That may follow a command: those below it, or the choices of its argument.
std::vector<std::string> words_behind(const CommandNote& command) {
  std::vector<std::string> words = words_of(command.commands);
  for (const OptionNote& option : command.options)
    if (option.is_positional())
      words.insert(words.end(), option.choices.begin(), option.choices.end());
  return words;
}

// --- bash ---

constexpr const char* bash_begin = R"(# SPDX-License-Identifier: MIT
# Completes command lines of loft in bash.
_loft() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command= word
  if [[ $current == '=' ]]; then
    current=
  elif [[ $previous == '=' && $COMP_CWORD -gt 1 ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$command $word" in
)";

std::string bash(const CommandNote& program) {
  std::ostringstream paths;
  std::ostringstream values;
  std::ostringstream words;
  for_each_command(program, [&](const CommandNote& command) {
    for (const CommandNote& below : command.commands)
      paths << "      " << quoted(command.name + ' ' + below.word())
            << ") command=" << quoted(below.name) << " ;;\n";
    for (const OptionNote& option : command.options) {
      if (option.argument.empty() || option.is_positional()) continue;
      values << "    ";
      for (const std::string& name : option.names)
        values << (&name == &option.names.front() ? "" : " | ")
               << quoted(command.name + ' ' + name);
      values << ")\n      COMPREPLY=($(compgen " << (option.is_file() ? "-f" : "-W ")
             << (option.is_file() ? "" : quoted(joined(option.choices)))
             << " -- \"$current\"))\n      return ;;\n";
    }
    words << "    " << quoted(command.name)
          << ")\n      options=" << quoted(joined(option_names(command)))
          << "\n      commands=" << quoted(joined(words_behind(command))) << " ;;\n";
  });
  return bash_begin + paths.str() + "    esac\n  done\n  case \"$command $previous\" in\n" +
         values.str() + "  esac\n  local options= commands=\n  case \"$command\" in\n" +
         words.str() +
         R"(  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [[ -n $commands ]]; then
    COMPREPLY=($(compgen -W "$commands" -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}
complete -o filenames -F _loft loft
)";
}

// --- zsh ---

/// A text inside `[...]` of a specification.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : first_clause(text)) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_value(const OptionNote& option) {
  if (option.argument.empty()) return {};
  const std::string value = ':' + option.argument + ':';
  if (option.is_file()) return value + "_files";
  return option.choices.empty() ? value + ' ' : value + '(' + joined(option.choices) + ')';
}

std::string zsh_function(const std::string& name) {
  std::string result = "_loft";
  if (!name.empty()) result += ' ' + name;
  std::ranges::replace(result, ' ', '_');
  return result;
}

void write_zsh(std::ostream& out, const CommandNote& command) {
  for (const CommandNote& below : command.commands) write_zsh(out, below);
  out << '\n' << zsh_function(command.name) << "() {\n";
  if (!command.commands.empty())
    out << "  local context state state_descr line\n  typeset -A opt_args\n";
  out << "  _arguments -s" << (command.commands.empty() ? "" : " -C");
  for (const OptionNote& option : command.options) {
    if (option.is_positional()) out << " \\\n    " << quoted('*' + zsh_value(option));
    for (const std::string& name : option.names)
      out << " \\\n    "
          << quoted('*' + name + '[' + zsh_text(option.text) + ']' + zsh_value(option));
  }
  if (!command.commands.empty()) {
    out << " \\\n    '1:command:->command' '*::argument:->argument'\n  case $state in\n"
           "    command)\n      local -a commands=(\n";
    for (const CommandNote& below : command.commands)
      out << "        " << quoted(below.word() + ':' + zsh_text(below.text)) << '\n';
    out << "      )\n      _describe command commands ;;\n    argument)\n      case $line[1] in\n";
    for (const CommandNote& below : command.commands)
      out << "        " << below.word() << ") " << zsh_function(below.name) << " ;;\n";
    out << "      esac ;;\n  esac";
  }
  out << "\n}\n";
}

std::string zsh(const CommandNote& program) {
  std::ostringstream out;
  out << "#compdef loft\n# SPDX-License-Identifier: MIT\n# Completes command lines of loft in "
         "zsh.\n";
  write_zsh(out, program);
  out << "\nif [[ $funcstack[1] == _loft ]]; then\n  _loft \"$@\"\nelse\n  compdef _loft "
         "loft\nfi\n";
  return std::move(out).str();
}

// --- fish ---

/// Where a command's words have been typed, and none of those below it.
std::string fish_condition(const CommandNote& command) {
  std::string condition;
  std::istringstream words(command.name);
  for (std::string word; words >> word;)
    condition += (condition.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
  if (command.commands.empty()) return condition;
  return condition + (condition.empty() ? "" : "; and ") + "not __fish_seen_subcommand_from " +
         joined(words_of(command.commands));
}

std::string fish_option(const OptionNote& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.is_file()) return text + " -r -F";
  if (option.argument.empty()) return text;
  return text + " -x" + (option.choices.empty() ? "" : " -a " + quoted(joined(option.choices)));
}

std::string fish(const CommandNote& program) {
  std::ostringstream out;
  out << "# SPDX-License-Identifier: MIT\n# Completes command lines of loft in fish.\n";
  for_each_command(program, [&](const CommandNote& command) {
    const std::string begin = "complete -c loft -n " + quoted(fish_condition(command));
    for (const CommandNote& below : command.commands)
      out << begin << " -f -a " << below.word() << " -d " << quoted(first_clause(below.text))
          << '\n';
    for (const OptionNote& option : command.options)
      if (option.is_positional() && !option.choices.empty())
        out << begin << " -f -a " << quoted(joined(option.choices)) << '\n';
      else if (!option.is_positional())
        out << begin << fish_option(option) << " -d " << quoted(first_clause(option.text)) << '\n';
  });
  return std::move(out).str();
}

}  // namespace

std::string completion(const CommandNote& program, std::string_view shell) {
  if (shell == "bash") return bash(program);
  return shell == "zsh" ? zsh(program) : fish(program);
}

}  // namespace loft::app
