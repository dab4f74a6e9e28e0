// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "app/capture/capture.h"

namespace loft::app {

/// Hands the edits of a source to a capture, in their order. Those that the session cannot keep are
/// held and tried again, after pauses, until it can; until then nothing behind them is taken: the
/// source waits.
class Intake {
 public:
  struct Line {
    io::Edit edit;
    std::string place;  ///< for complaints
    std::optional<io::InputPosition> position;
  };
  using Complain = std::function<void(const std::string&)>;

  /// `complain` is called by the capture's thread.
  Intake(Capture& capture, Complain complain) : capture_(capture), complain_(std::move(complain)) {}
  /// Closes the capture: its answers come here.
  ~Intake() { capture_.close(); }
  Intake(const Intake&) = delete;
  Intake& operator=(const Intake&) = delete;

  /// Whether it was taken on; waits for that a while.
  [[nodiscard]] bool hand_over(const Line& line, std::chrono::milliseconds patience);
  /// Whether all is answered and none is held; waits for that a while.
  [[nodiscard]] bool is_idle(std::chrono::milliseconds patience);
  [[nodiscard]] std::size_t held_count() const;

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool submit(const Line& line, Capture::Done done,
                            std::chrono::milliseconds patience);
  [[nodiscard]] bool has_none_held(std::chrono::milliseconds patience);
  void note(const Line& line, const Answer& answer);
  void note_trial(const Answer& answer);
  void answered();

  Capture& capture_;
  Complain complain_;
  std::atomic<bool> is_held_ = false;  // what comes has to wait behind what is held

  mutable std::mutex mutex_;  // of all below
  std::condition_variable answered_;
  std::size_t unanswered_ = 0;
  std::deque<Line> held_;
  std::chrono::milliseconds pause_{};
  Clock::time_point next_trial_;
};

}  // namespace loft::app
