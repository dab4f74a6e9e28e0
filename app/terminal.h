// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace loft::app {

/// Words for the user, on stderr. Coloured, and with a progress bar, where that is a terminal;
/// NO_COLOR and TERM=dumb are respected.
class Terminal {
 public:
  /// A quiet one says nothing but errors.
  explicit Terminal(bool quiet = false);
  ~Terminal() { clear_progress(); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void say(std::string_view line);
  void warn(std::string_view line);
  /// One line each, `error: ` in front.
  void complain(std::string_view lines);

  /// Draws the bar, from 0 to 1, and about how long it will take, if that has changed;
  /// clear_progress() takes it away, and what comes then is another task.
  void show_progress(std::string_view activity, double fraction);
  /// Draws a line in its place that counts what has no end to measure by.
  void show_count(std::string_view line);
  [[nodiscard]] bool shows_progress() const { return has_bar_; }
  void clear_progress();

 private:
  [[nodiscard]] std::string time_left(double fraction) const;
  void draw(std::string line);
  void print(std::string_view colour, std::string_view prefix, std::string_view line);

  bool quiet_;
  bool has_bar_;
  bool has_colour_;
  std::string bar_;                              // what is drawn now
  std::chrono::steady_clock::time_point begin_;  // of the task
};

}  // namespace loft::app
