// SPDX-License-Identifier: MIT
#include "app/options/help.h"

#include <algorithm>
#include <iostream>
#include <string_view>

#include "io/bytes/near_word.h"
#include "io/bytes/text.h"

namespace loft::app {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

const CLI::App* find_command(const CLI::App& app, const std::string& word) {
  for (const CLI::App* command : commands_of(app))
    if (command->get_name() == word) return command;
  return nullptr;
}

/// The only known word that begins like that; empty if there is none, or several.
std::string begun(const std::string& word, const std::vector<std::string>& known) {
  const auto begins = [&](const std::string& one) { return one.starts_with(word); };
  const auto found = std::ranges::find_if(known, begins);
  return std::ranges::count_if(known, begins) == 1 ? *found : "";
}

/// `did you mean 'reconstruct'?`; the way to the list where nothing is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known,
                       const std::string& otherwise) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  const std::size_t most = std::max<std::size_t>(1, word.size() / 3);
  const auto near = io::near_word(word, views, most);
  const std::string meant = near ? *near : begun(word, known);
  return meant.empty() ? otherwise : "did you mean '" + meant + "'?";
}

std::string no_command(const CLI::App& app, const std::string& path, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* command : commands_of(app))
    if (!command->get_group().empty()) known.push_back(command->get_name());
  return io::in_quotes(word) + " is no subcommand of " + path + "; " +
         suggestion(word, known, "'loft help' lists them");
}

std::string no_option(const CLI::App& app, const std::string& path, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  const std::string help = "loft help" + path.substr(std::min<std::size_t>(4, path.size()));
  return io::in_quotes(word) + " is no option of " + path + "; " +
         suggestion(word, known, "'" + help + "' lists them");
}

bool has_option(const CLI::App& app, const std::string& name) {
  return app.get_option_no_throw(name) != nullptr;
}

/// Of `--port=80` and `-ofile`: `--port`, `-o`.
std::string option_name(const std::string& word) {
  return word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

/// Numbers are no options: they follow one.
bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word[1] != '.' && (word[1] < '0' || word[1] > '9');
}

}  // namespace

ExitCode show_help(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string path = app.get_name();
  for (const std::string& word : words) {
    const CLI::App* below = find_command(*command, word);
    if (below == nullptr) throw UsageError(no_command(*command, path, word));
    command = below;
    path += ' ' + word;
  }
  std::cout << app.get_formatter()->make_help(command, path, CLI::AppFormatMode::Normal);
  return ExitCode::ok;
}

std::optional<std::string> find_unknown(const CLI::App& app,
                                        const std::vector<std::string>& arguments) {
  const CLI::App* command = &app;
  std::string path = app.get_name();
  for (const std::string& word : arguments) {
    if (word == "--") return {};
    if (looks_like_option(word)) {
      if (!has_option(*command, option_name(word)))
        return no_option(*command, path, option_name(word));
    } else if (!commands_of(*command).empty()) {
      const CLI::App* below = find_command(*command, word);
      if (below == nullptr) return no_command(*command, path, word);
      command = below;
      path += ' ' + word;
    }
  }
  return {};
}

}  // namespace loft::app
