// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace loft::app {

/// Events for viewers, each with the next number. A bounded number of them is kept: a reader has a
/// cursor into these and nothing of its own, so that one that is slow or dead costs nothing.
/// For any number of threads.
class Feed {
 public:
  explicit Feed(std::size_t bound = 4096) : bound_(bound) {}

  /// The number of the event.
  std::uint64_t publish(std::string data);
  /// No event comes any more.
  void close();

  /// The number of the last event; 0 before the first.
  [[nodiscard]] std::uint64_t last() const;

  struct Reading {
    enum class Outcome { event, nothing_new, too_late, closed } outcome;
    std::string data = {};
  };
  /// The event with that number; waits for it. `too_late`: it is kept no longer, or never was.
  [[nodiscard]] Reading read(std::uint64_t number, std::chrono::milliseconds patience) const;

 private:
  std::size_t bound_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<std::string> events_;
  std::uint64_t last_ = 0;
  bool is_closed_ = false;
};

}  // namespace loft::app
