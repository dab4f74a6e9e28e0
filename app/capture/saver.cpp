// SPDX-License-Identifier: MIT
#include "app/capture/saver.h"

#include <exception>
#include <utility>

namespace loft::app {

void Saver::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Saver::request() {
  {
    const std::lock_guard lock(mutex_);
    is_wanted_ = true;
  }
  changed_.notify_all();
}

std::string Saver::take_error() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

void Saver::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return is_wanted_ || is_ended_; });
    if (!std::exchange(is_wanted_, false)) return;
    lock.unlock();
    std::string error;
    try {
      save_();
    } catch (const std::exception& thrown) {
      error = thrown.what();
    }
    lock.lock();
    if (!error.empty()) error_ = std::move(error);
  }
}

}  // namespace loft::app
