// SPDX-License-Identifier: MIT
#include "app/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <utility>

namespace loft::app {

namespace {

constexpr std::string_view red = "\x1b[31m";
constexpr std::string_view yellow = "\x1b[33m";
constexpr std::string_view plain = "\x1b[0m";
constexpr std::string_view clear_line = "\r\x1b[K";

bool is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return no_colour == nullptr || *no_colour == '\0';
}

}  // namespace

Terminal::Terminal(bool quiet)
    : quiet_(quiet),
      has_bar_(is_terminal() && !quiet),
      has_colour_(is_terminal() && wants_colour()) {}

void Terminal::print(std::string_view colour, std::string_view prefix, std::string_view line) {
  clear_progress();
  const bool is_coloured = has_colour_ && !colour.empty();
  std::cerr << (is_coloured ? colour : "") << prefix << (is_coloured ? plain : "") << line << '\n';
}

void Terminal::say(std::string_view line) {
  if (!quiet_) print("", "", line);
}

void Terminal::warn(std::string_view line) {
  if (!quiet_) print(yellow, "warning: ", line);
}

void Terminal::complain(std::string_view lines) {
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    print(red, "error: ", lines.substr(0, end));
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
}

void Terminal::show_progress(std::string_view activity, double fraction) {
  if (!has_bar_) return;
  if (bar_.empty()) begin_ = std::chrono::steady_clock::now();
  constexpr std::size_t width = 30;
  const double part = std::clamp(fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(part * width);
  std::string bar(1, '[');
  bar.append(filled, '#').append(width - filled, ' ').append("] ");
  bar.append(std::to_string(static_cast<int>(part * 100))).append("% ").append(activity);
  bar += time_left(part);
  draw(std::move(bar));
}

void Terminal::show_count(std::string_view line) {
  if (has_bar_) draw(std::string(line));
}

void Terminal::draw(std::string line) {
  if (line == bar_) return;
  bar_ = std::move(line);
  std::cerr << clear_line << bar_ << std::flush;
}

/// `, 12 s left`, going by how long it took so far; nothing as long as that says little.
std::string Terminal::time_left(double fraction) const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  if (elapsed.count() < 2 || fraction < 0.02) return {};
  const auto seconds = static_cast<long>(elapsed.count() * (1 - fraction) / fraction + 0.5);
  if (seconds < 100) return ", " + std::to_string(seconds) + " s left";
  return ", " + std::to_string((seconds + 30) / 60) + " min left";
}

void Terminal::clear_progress() {
  if (bar_.empty()) return;
  bar_.clear();
  std::cerr << clear_line << std::flush;
}

}  // namespace loft::app
