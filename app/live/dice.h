// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

namespace loft::app {

/// The same numbers everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace loft::app
