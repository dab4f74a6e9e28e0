// SPDX-License-Identifier: MIT
#include "app/capture/intake.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "app/place.h"

namespace loft::app {

namespace {

constexpr std::chrono::milliseconds first_pause{50};
constexpr std::chrono::milliseconds longest_pause{1000};

}  // namespace

bool Intake::hand_over(const Line& line, std::chrono::milliseconds patience) {
  if (!has_none_held(patience)) return false;
  // Its place goes along, in case it comes back; the edit comes with the answer.
  const Line without_edit{{}, line.place, line.position};
  return submit(
      line, [this, without_edit](const Answer& answer) { note(without_edit, answer); }, patience);
}

bool Intake::is_idle(std::chrono::milliseconds patience) {
  if (!has_none_held(patience)) return false;
  std::unique_lock lock(mutex_);
  return answered_.wait_for(lock, patience, [&] { return unanswered_ == 0; }) && held_.empty();
}

std::size_t Intake::held_count() const {
  const std::lock_guard lock(mutex_);
  return held_.size();
}

bool Intake::submit(const Line& line, Capture::Done done, std::chrono::milliseconds patience) {
  {
    const std::lock_guard lock(mutex_);
    ++unanswered_;
  }
  const auto submission =
      capture_.submit(line.edit, std::move(done), patience, {line.position, &is_held_});
  if (submission == Capture::Submission::taken) return true;
  answered();
  return false;
}

/// If any is held, tries the first again when it is time for that.
bool Intake::has_none_held(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (!is_held_ && held_.empty()) return true;
  // Those behind it come back first.
  if (!answered_.wait_for(lock, patience, [&] { return unanswered_ == 0; })) return false;
  if (held_.empty()) return true;
  const auto now = Clock::now();
  if (now < next_trial_) {
    lock.unlock();
    std::this_thread::sleep_until(std::min(next_trial_, now + patience));
    return false;
  }
  const Line first = held_.front();
  lock.unlock();
  is_held_ = false;
  if (!submit(
          first, [this](const Answer& answer) { note_trial(answer); }, patience))
    is_held_ = true;
  return false;
}

void Intake::note(const Line& line, const Answer& answer) {
  if (answer.outcome == Answer::Outcome::rejected) complain_(with_place(answer.error, line.place));
  if (answer.outcome == Answer::Outcome::not_kept) {
    if (!is_held_.exchange(true))
      complain_(with_place(answer.error, line.place) + "; the input waits until it can be kept");
    const std::lock_guard lock(mutex_);
    held_.push_back({*answer.edit, line.place, line.position});
    pause_ = first_pause;
    next_trial_ = Clock::now() + pause_;
  }
  answered();
}

/// Of the first that is held.
void Intake::note_trial(const Answer& answer) {
  if (answer.outcome == Answer::Outcome::not_kept) {
    is_held_ = true;
    const std::lock_guard lock(mutex_);
    pause_ = std::min(2 * pause_, longest_pause);
    next_trial_ = Clock::now() + pause_;
  } else {
    const std::lock_guard lock(mutex_);
    if (answer.outcome == Answer::Outcome::rejected)
      complain_(with_place(answer.error, held_.front().place));
    held_.pop_front();
    next_trial_ = {};
  }
  answered();
}

void Intake::answered() {
  {
    const std::lock_guard lock(mutex_);
    --unanswered_;
  }
  answered_.notify_all();
}

}  // namespace loft::app
