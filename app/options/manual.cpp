// SPDX-License-Identifier: MIT
#include "app/options/manual.h"

#include <sstream>

namespace loft::app {

namespace {

/// Text that troff prints as it is: hyphens can be copied, no line is a command.
std::string escaped(std::string_view text) {
  std::string result;
  bool is_first = true;
  for (const char c : text) {
    if (is_first && (c == '.' || c == '\'')) result += "\\&";
    is_first = c == '\n';
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

/// In the argument of a macro.
std::string roff_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : escaped(text)) result += c == '"' ? std::string("\\(dq") : std::string(1, c);
  return result + '"';
}

/// `\fB-o\fR, \fB--output\fR \fIOUT\fR`
std::string heading(const OptionNote& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += (text.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
  if (!option.argument.empty())
    text += (text.empty() ? "\\fI" : " \\fI") + escaped(option.argument) + "\\fR";
  return text;
}

std::string lines_of(const OptionNote& option) {
  std::string text = ".TP\n" + heading(option) + '\n' + escaped(option.text) + ".\n";
  if (option.choices.empty()) return text;
  text += "One of";
  for (const std::string& choice : option.choices)
    text += (&choice == &option.choices.front() ? " \\fB" : ", \\fB") + escaped(choice) + "\\fR";
  return text + ".\n";
}

std::string synopsis(const CommandNote& command) {
  std::string text = ".PP\n\\fBloft " + escaped(command.name) + "\\fR";
  bool has_more = false;
  for (const OptionNote& option : command.options) {
    const std::string words =
        heading(option) + (option.is_positional() && option.is_list ? "..." : "");
    if (option.is_required) text += ' ' + words;
    if (!option.is_required && option.is_positional()) text += " [" + words + ']';
    has_more = has_more || (!option.is_required && !option.is_positional());
  }
  return text + (has_more ? " [\\fIoptions\\fR]\n" : "\n");
}

std::string example(const std::string& lines) { return ".PP\n.nf\n" + escaped(lines) + "\n.fi\n"; }

bool is_worth_a_section(const CommandNote& command) {
  return !command.name.empty() && command.commands.empty();
}

}  // namespace

std::string manual(const CommandNote& program, std::string_view version) {
  std::ostringstream out;
  out << ".\\\" SPDX-License-Identifier: MIT\n.TH LOFT 1 \"\" " << roff_quoted(std::string(version))
      << " \"User Commands\"\n.SH NAME\nloft \\- " << escaped(program.text) << "\n.SH SYNOPSIS\n";
  for_each_command(program, [&](const CommandNote& command) {
    if (is_worth_a_section(command)) out << synopsis(command);
  });
  out << ".SH COMMANDS\n";
  for_each_command(program, [&](const CommandNote& command) {
    if (!is_worth_a_section(command)) return;
    out << ".SS " << roff_quoted("loft " + command.name) << '\n' << escaped(command.text) << ".\n";
    for (const OptionNote& option : command.options) out << lines_of(option);
    if (!command.footer.empty()) out << example(command.footer);
  });
  out << ".SH NOTES\n" << example(program.footer);
  return std::move(out).str();
}

}  // namespace loft::app
