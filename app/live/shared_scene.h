// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/capture/feed.h"
#include "app/live/scene.h"

namespace loft::app {

/// A scene among its pages: edits one after the other, each an event of the feed before it is
/// answered; a page that comes late gets the whole state. For any number of threads.
class SharedScene {
 public:
  /// Changes with more bytes than that are not kept: pages get the whole state instead.
  static constexpr std::size_t most_bytes = std::size_t{1} << 20U;
  static constexpr std::size_t most_events = 1024;

  explicit SharedScene(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}

  /// An edit as it comes: what its event is called, `{"event": number, "microseconds": cost}`.
  /// Throws Refusal, whatever was thrown inside.
  Json apply(std::string_view text);
  /// As Scene has them. Throw Refusal.
  [[nodiscard]] Json answer(const Question& question);
  [[nodiscard]] std::optional<std::string> bytes(const Question& question);
  /// Time goes on as far as it has since the last call, but for what is more than a second.
  void advance();
  /// The whole state, and the number of the event after it.
  [[nodiscard]] std::pair<std::string, std::uint64_t> state();
  [[nodiscard]] const Feed& feed() const { return feed_; }

 private:
  using Clock = std::chrono::steady_clock;

  void let_time_pass();
  std::uint64_t publish(const Json& change);

  std::mutex mutex_;
  std::unique_ptr<Scene> scene_;
  Clock::time_point now_ = Clock::now();
  Feed feed_{most_events};
};

}  // namespace loft::app
