// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace loft::app {

/// Does one thing in a thread of its own whenever it is asked to. Requests that come while it is at
/// it are one afterwards. What it throws is kept for the next call of take_error().
class Saver {
 public:
  explicit Saver(std::function<void()> save) : save_(std::move(save)), thread_([this] { run(); }) {}
  ~Saver() { finish(); }
  Saver(const Saver&) = delete;
  Saver& operator=(const Saver&) = delete;

  void request();
  /// Does what was asked for before, and then nothing any more.
  void finish();
  /// What went wrong last, each once; empty if nothing did.
  [[nodiscard]] std::string take_error();

 private:
  void run();

  std::function<void()> save_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_wanted_ = false;
  bool is_ended_ = false;
  std::string error_;
  std::thread thread_;
};

}  // namespace loft::app
