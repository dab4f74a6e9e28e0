// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>

#include "python/binding/job.h"
#include "reconstruct/defect.h"

namespace loft::python {

namespace py = pybind11;

/// A value that several threads may use, one at a time. Whoever waits for it does so without the
/// interpreter's lock, and whoever has it never asks for that: so neither waits for the other.
template <class Value>
class InTurn {
 public:
  template <class... Arguments>
  explicit InTurn(std::in_place_t /*tag*/, Arguments&&... arguments)
      : value_{std::forward<Arguments>(arguments)...} {}

  /// work(value) for a thread with the interpreter's lock. Signals are heard while it waits, not
  /// during the work, which must be short and touch no Python object.
  template <class Work>
  auto use(Work work) {
    for (;;) {
      {
        const py::gil_scoped_release unlocked;
        const std::unique_lock lock(mutex_, std::chrono::milliseconds(50));
        if (lock.owns_lock()) {
          forks_ = fork_count();
          return work(value_);
        }
      }
      if (forks_ != fork_count())
        throw Error("it was being changed by another thread when this process was forked");
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
  }

  /// The same for a thread without it, such as that of a Job.
  template <class Work>
  auto use_in_job(Work work) {
    const std::lock_guard lock(mutex_);
    forks_ = fork_count();
    return work(value_);
  }

 private:
  std::timed_mutex mutex_;
  std::atomic<unsigned> forks_ = fork_count();  ///< when it was used last
  Value value_;
};

}  // namespace loft::python
