// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace loft::cdt {

/// Thrown where a thread's Effort has come to its end. What was being made can only be cleared or
/// destroyed then, triangulations as well; who promises more says so (Reconstruction does).
class TooMuchEffort : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bounds what the calling thread does as long as this is there, in steps: tests of pairs,
/// insertions, crossings. Not in seconds: what was too much for one machine is so for every other.
/// Without one there is no bound; a nested one holds in place of the outer one, which is not
/// counted meanwhile. Threads that are started meanwhile are not bounded.
class Effort {
 public:
  static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

  /// Ends, too, once `stop` is true; it is looked at now and then.
  explicit Effort(std::uint64_t most = unlimited, const std::atomic<bool>* stop = nullptr)
      : left_(most), stop_(stop), outer_(current) {
    current = this;
  }
  ~Effort() { current = outer_; }
  Effort(const Effort&) = delete;
  Effort& operator=(const Effort&) = delete;

  static void spend(std::uint64_t steps) {
    if (current != nullptr) current->take(steps);
  }

 private:
  void take(std::uint64_t steps) {
    if (left_ < steps) throw TooMuchEffort("it takes too many steps");
    if (left_ != unlimited) left_ -= steps;
    if ((++calls_ & 0xfffU) == 0 && stop_ != nullptr && *stop_)
      throw TooMuchEffort("it was interrupted");
  }

  std::uint64_t left_;
  const std::atomic<bool>* stop_;
  Effort* outer_;
  std::uint32_t calls_ = 0;

  static inline thread_local Effort* current = nullptr;
};

/// Counts steps of the calling thread. Throws TooMuchEffort where they are too many.
inline void spend(std::uint64_t steps = 1) { Effort::spend(steps); }

}  // namespace loft::cdt
