// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "reconstruct/progress.h"

namespace loft::python {

namespace py = pybind11;

/// A Python object that threads without the interpreter's lock may hold and let go of.
class Kept {
 public:
  Kept() = default;
  explicit Kept(py::object object);

 private:
  std::shared_ptr<py::object> object_;
};

/// How many threads the work of a call may use: `wanted`, or, where this process has been forked
/// off one whose threads had begun, 1, as those did not come along. Throws Error where more are
/// wanted then.
[[nodiscard]] unsigned usable_threads(unsigned wanted);

/// How many forks there are between the first process and this one.
[[nodiscard]] unsigned fork_count();

/// What Python is told of work that goes on: how far it is, and how it ends.
class Job {
 public:
  /// Called by the worker; false once it is to stop.
  [[nodiscard]] bool report(Stage stage, double fraction);
  void finish(std::exception_ptr failure);

  /// Until it is finished: looks for signals, and tells `progress` (stage, fraction) at most ten
  /// times a second. Throws what these throw, or Cancelled where `progress` returns False, once the
  /// worker has been told to stop. With the interpreter's lock.
  void wait(const py::object& progress);

  /// From now on report() says so.
  void stop();

 private:
  struct State {
    Stage stage = Stage::clean;
    double fraction = 0;
  };

  [[nodiscard]] bool is_finished_within(std::chrono::milliseconds time);
  [[nodiscard]] std::optional<State> news();
  void tell(const py::object& progress);

  std::mutex mutex_;
  std::condition_variable finished_;
  bool is_finished_ = false;
  bool is_stopped_ = false;
  bool has_news_ = false;
  State state_;
  std::exception_ptr failure_;
};

/// Runs work on a thread of its own and waits for it without the interpreter's lock, so that
/// Python's other threads go on, Ctrl-C is heard and Python code is called by the calling thread
/// alone. After Ctrl-C it does not wait for the end: `work` must own all that it uses, and Python
/// objects as Kept.
void run(const py::object& progress, std::function<void(Job&)> work);

/// The same for work that gives a result: work(job).
template <class Work>
auto result_of(const py::object& progress, Work work) {
  using Result = decltype(work(std::declval<Job&>()));
  auto result = std::make_shared<std::optional<Result>>();
  run(progress, [result, work = std::move(work)](Job& job) { result->emplace(work(job)); });
  return std::move(**result);
}

/// Stops all work, what Ctrl-C has left behind and that of daemon threads, and waits for it: to be
/// called before the interpreter ends.
void wait_for_abandoned();

/// Tells a child process that threads of its parent are not there.
void watch_forks();

}  // namespace loft::python
