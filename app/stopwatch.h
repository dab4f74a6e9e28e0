// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <utility>

namespace loft::app {

/// The time since the last look, in seconds.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace loft::app
