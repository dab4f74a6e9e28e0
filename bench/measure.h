// SPDX-License-Identifier: MIT
#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

namespace loft::bench {

/// Processor time of this thread, in seconds.
[[nodiscard]] inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Seconds that an action takes.
template <class Action>
[[nodiscard]] double seconds_of(Action action) {
  const double start = thread_seconds();
  action();
  return thread_seconds() - start;
}

/// A line of /proc/self/status in kilobytes: "VmRSS:" is the memory used now, "VmHWM:" the most
/// there has been. 0 where there is no such file.
[[nodiscard]] inline long memory_kilobytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  long kilobytes = 0;
  while (status >> word)
    if (word == key) status >> kilobytes;
  return kilobytes;
}

/// Durations of the same thing done again and again.
class Durations {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }

  /// The duration that `fraction` of all do not reach; 0 if there is none.
  [[nodiscard]] double quantile(double fraction) const {
    if (seconds_.empty()) return 0;
    std::vector<double> sorted = seconds_;
    std::ranges::sort(sorted);
    const auto rank = static_cast<std::size_t>(fraction * static_cast<double>(sorted.size()));
    return sorted[std::min(rank, sorted.size() - 1)];
  }
  [[nodiscard]] double microseconds(double fraction) const { return 1e6 * quantile(fraction); }

 private:
  std::vector<double> seconds_;
};

}  // namespace loft::bench
