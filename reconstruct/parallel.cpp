// SPDX-License-Identifier: MIT
#include "reconstruct/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace loft {

namespace {

/// Hands out indices and gathers exceptions.
class SharedWork {
 public:
  SharedWork(std::size_t count, const std::function<void(std::size_t, unsigned)>& body)
      : count_(count), body_(body) {}

  void run(unsigned worker) {
    for (std::size_t i = next_++; i < count_; i = next_++) {
      try {
        body_(i, worker);
      } catch (...) {
        note_failure(i);
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Everything before i has begun, so that the lowest failure is always among those noted.
  void note_failure(std::size_t i) {
    next_ = count_;
    const std::lock_guard lock(mutex_);
    if (failure_ && failed_ < i) return;
    failure_ = std::current_exception();
    failed_ = i;
  }

  std::size_t count_;
  const std::function<void(std::size_t, unsigned)>& body_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t failed_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

unsigned thread_count(unsigned wanted) {
  return wanted != 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
}

void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t, unsigned)>& body) {
  const auto workers = static_cast<int>(std::min<std::size_t>(thread_count(threads), count));
  if (workers <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i, 0);
    return;
  }
  SharedWork work(count, body);
  // More threads than processors are refused, unless it is said so.
  std::optional<tbb::global_control> allowed;
  if (workers > tbb::this_task_arena::max_concurrency())
    allowed.emplace(tbb::global_control::max_allowed_parallelism, workers);
  tbb::task_arena arena(workers);
  arena.execute([&] {
    tbb::parallel_for(
        0, workers, [&](int worker) { work.run(static_cast<unsigned>(worker)); },
        tbb::simple_partitioner());
  });
  work.rethrow();
}

}  // namespace loft
