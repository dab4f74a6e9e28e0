// SPDX-License-Identifier: MIT
#include "app/capture/feed.h"

#include <utility>

namespace loft::app {

std::uint64_t Feed::publish(std::string data) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(data));
    if (events_.size() > bound_) events_.pop_front();
    number = ++last_;
  }
  changed_.notify_all();
  return number;
}

void Feed::close() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
}

std::uint64_t Feed::last() const {
  const std::lock_guard lock(mutex_);
  return last_;
}

Feed::Reading Feed::read(std::uint64_t number, std::chrono::milliseconds patience) const {
  using Outcome = Reading::Outcome;
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return is_closed_ || last_ >= number; });
  if (last_ >= number) {
    const std::uint64_t first = last_ + 1 - events_.size();
    if (number < first) return {Outcome::too_late};
    return {Outcome::event, events_[static_cast<std::size_t>(number - first)]};
  }
  if (is_closed_) return {Outcome::closed};
  return {number > last_ + 1 ? Outcome::too_late : Outcome::nothing_new};
}

}  // namespace loft::app
