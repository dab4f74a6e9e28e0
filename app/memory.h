// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>

namespace loft::app {

/// Memory of this process that is in RAM, in bytes; 0 where the system does not say.
inline std::size_t memory_in_use() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0;
  std::size_t resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// A number of bytes in units of 2^20, as schedulers count a job's megabytes; one place.
inline double megabytes(std::size_t bytes) {
  return std::ceil(static_cast<double>(bytes) / 0x1p20 * 10) / 10;
}

/// The most memory of this process that was in RAM, all in all and since the last look, in bytes;
/// 0 where the system does not say. Where it cannot start anew, both are of all its life.
class PeakMemory {
 public:
  PeakMemory() { start_anew(); }

  /// Since the last one, or the beginning.
  std::size_t lap() {
    const std::size_t peak = highest();
    start_anew();
    return peak;
  }
  [[nodiscard]] std::size_t in_all() const { return std::max(in_all_, read()); }

 private:
  static std::size_t read() {
    std::ifstream file("/proc/self/status");
    std::string word;
    std::size_t kilobytes = 0;
    while (file >> word)
      if (word == "VmHWM:" && file >> kilobytes) return kilobytes << 10U;
    return 0;
  }
  std::size_t highest() {
    const std::size_t peak = read();
    in_all_ = std::max(in_all_, peak);
    return peak;
  }
  void start_anew() {
    highest();
    std::ofstream("/proc/self/clear_refs") << "5\n";  // see proc(5)
  }

  std::size_t in_all_ = 0;
};

}  // namespace loft::app
