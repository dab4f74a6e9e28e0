// SPDX-License-Identifier: MIT
#include "app/commands/settings.h"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "app/report.h"
#include "io/stacks/stack_line.h"
#include "io/unit.h"
#include "reconstruct/number_text.h"

namespace loft::app {

namespace {

double number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

void set_length(std::optional<double>& length, const std::string& text) { length = number(text); }

/// As labels_text() has them.
void take_labels(StreamCommand& command, const std::string& text) {
  auto said = io::parse_stack_line(text);
  if (said && said->problems.empty()) command.labels = std::move(said->stack.labels);
}

std::string labels_text(const StreamCommand& command) {
  Stack about;
  about.labels = command.labels;
  std::string line;
  io::append_stack_line(line, about);
  return line;
}

template <class Choice>
void choose(Choice& choice, std::initializer_list<Choice> all, const std::string& text) {
  for (const Choice one : all)
    if (name(one) == text) choice = one;
}

void set(StreamCommand& command, const std::string& key, const std::string& value) {
  Options& options = command.options;
  if (key == "fill")
    choose(options.fill, {Fill::even_odd, Fill::nonzero, Fill::keyhole_aware}, value);
  if (key == "cap") choose(options.cap, {Cap::flat, Cap::dome, Cap::open}, value);
  if (key == "link")
    choose(options.link, {LinkRule::automatic, LinkRule::overlap, LinkRule::none}, value);
  if (key == "smooth") options.smooth = value == "true";
  if (key == "smooth_tolerance") set_length(options.smooth_tolerance, value);
  if (key == "unit") command.unit = value;
  if (key == "labels") take_labels(command, value);
  if (key == "keyhole_width") set_length(options.keyhole_width, value);
  if (key == "tolerance") options.tolerance = number(value);
  if (key == "max_shift") set_length(options.max_shift, value);
  if (key == "fair") set_length(options.fair, value);
  if (key == "max_edge") set_length(options.max_edge, value);
  if (key == "target_edge") set_length(options.target_edge, value);
}

}  // namespace

void check_at(std::uint64_t count, const io::Session& session, const std::filesystem::path& file) {
  const std::uint64_t all = session.edit_count();
  if (count > all)
    throw InputError(file.string() + ": it has " + std::to_string(all) + " edits, and not " +
                     std::to_string(count));
}

Capture::Setup setup_of(const StreamCommand& command) {
  Capture::Setup setup;
  setup.options = command.options;
  setup.most_effort = static_cast<std::uint64_t>(command.most_effort * 1e6);
  setup.unit = command.unit;
  setup.labels = command.labels;
  setup.metres_per_unit = io::metres_per_unit(command.unit).value_or(0.001);
  return setup;
}

std::map<std::string, std::string> settings_of(const StreamCommand& command) {
  std::map<std::string, std::string> settings = settings_of(command.options);
  settings["smooth"] = command.options.smooth ? "true" : "false";
  settings["unit"] = command.unit;
  if (command.options.keyhole_width)
    settings["keyhole_width"] = exact(*command.options.keyhole_width);
  if (command.options.tolerance != Options().tolerance || command.given.contains("tolerance"))
    settings["tolerance"] = exact(command.options.tolerance);
  if (!command.labels.empty()) settings["labels"] = labels_text(command);
  if (command.options.max_shift) settings["max_shift"] = exact(*command.options.max_shift);
  return settings;
}

void take_over(const std::map<std::string, std::string>& settings, StreamCommand& command) {
  const auto asked = settings_of(command);
  for (const std::string& key : command.given) {
    const auto begun = settings.find(key);
    if (begun == settings.end())
      throw UsageError("the session was begun without " + key +
                       "; leave the option out, or begin another session");
    if (begun->second != asked.at(key))
      throw UsageError("the session was begun with " + key + ' ' + begun->second + ", not " +
                       asked.at(key) + "; leave the option out, or begin another session");
  }
  for (const auto& [key, value] : settings) set(command, key, value);
}

}  // namespace loft::app
