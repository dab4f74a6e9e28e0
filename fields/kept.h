// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

namespace loft::fields {

/// Whether what belongs to a vertex was found already and still holds, shared by several readers:
/// one of them finds and writes it, those that come meanwhile find it for themselves. A number of
/// its own: 0 where nothing is known, else when it was found, whether it holds until the next edit
/// only, wherever that is, and whether it is the same all around the vertex.
class Kept {
 public:
  Kept(std::uint64_t& state, std::uint64_t epoch) : state_(state), epoch_(epoch) {}

  /// Whether it can be read.
  [[nodiscard]] bool holds() const {
    const std::uint64_t state = state_.load(std::memory_order_acquire);
    return state > busy && ((state & passing) == 0 || state >> 3 == epoch_);
  }
  /// Whether the caller is to find it, and to say so by keep() when it is written.
  [[nodiscard]] bool begin() {
    std::uint64_t state = state_.load(std::memory_order_relaxed);
    return state != busy && state_.compare_exchange_strong(state, busy, std::memory_order_acquire);
  }
  void keep(bool is_passing, bool is_same = false) {
    state_.store(epoch_ << 3 | known | (is_passing ? passing : 0) | (is_same ? same : 0),
                 std::memory_order_release);
  }
  /// Precondition: it holds.
  [[nodiscard]] bool is_same_all_around() const {
    return (state_.load(std::memory_order_relaxed) & same) != 0;
  }

 private:
  static constexpr std::uint64_t passing = 1;
  static constexpr std::uint64_t busy = 1;
  static constexpr std::uint64_t known = 2;
  static constexpr std::uint64_t same = 4;

  std::atomic_ref<std::uint64_t> state_;
  std::uint64_t epoch_;
};

}  // namespace loft::fields
