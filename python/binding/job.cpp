// SPDX-License-Identifier: MIT
#include "python/binding/job.h"

#include <pthread.h>

#include <atomic>
#include <string>
#include <system_error>
#include <vector>

#include "reconstruct/defect.h"
#include "reconstruct/parallel.h"
#include "reconstruct/reconstruct.h"

namespace loft::python {

namespace {

using namespace std::chrono_literals;

constexpr auto time_between_signals = 50ms;
constexpr auto time_between_news = 100ms;

std::atomic<bool> has_begun_threads = false;
std::atomic<bool> is_fork_of_threads = false;
std::atomic<unsigned> forks = 0;

/// The jobs of this process that go on.
class Jobs {
 public:
  void add(const std::shared_ptr<Job>& job) {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(job);
  }
  void remove(const std::shared_ptr<Job>& job) {
    const std::lock_guard lock(mutex_);
    std::erase(jobs_, job);
  }
  /// Whether there are none; tells those there are to stop.
  bool stop_all() {
    const std::lock_guard lock(mutex_);
    for (const std::shared_ptr<Job>& job : jobs_) job->stop();
    return jobs_.empty();
  }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<Job>> jobs_;
};

/// Never destroyed: threads may outlive what the end of a program destroys.
std::atomic<Jobs*> jobs = new Jobs;

extern "C" void note_fork() {
  is_fork_of_threads = is_fork_of_threads || has_begun_threads;
  ++forks;
  jobs = new Jobs;  // the threads of the others, and who holds their lock, are not here
}

}  // namespace

Kept::Kept(py::object object)
    : object_(new py::object(std::move(object)), [](py::object* kept) {
        const py::gil_scoped_acquire lock;
        delete kept;
      }) {}

unsigned fork_count() { return forks; }

unsigned usable_threads(unsigned wanted) {
  if (is_fork_of_threads) {
    if (wanted > 1)
      throw Error(
          "this process was forked from one in which loft had begun threads, and these are not "
          "here: use multiprocessing's 'spawn' or 'forkserver', or threads=1");
    return 1;
  }
  if (thread_count(wanted) > 1) has_begun_threads = true;
  return wanted;
}

bool Job::report(Stage stage, double fraction) {
  const std::lock_guard lock(mutex_);
  state_ = {stage, fraction};
  has_news_ = true;
  return !is_stopped_;
}

void Job::finish(std::exception_ptr failure) {
  {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    is_finished_ = true;
  }
  finished_.notify_all();
}

bool Job::is_finished_within(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return finished_.wait_for(lock, time, [this] { return is_finished_; });
}

std::optional<Job::State> Job::news() {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(has_news_, false)) return {};
  return state_;
}

void Job::tell(const py::object& progress) {
  const std::optional<State> state = news();
  if (!state) return;
  const py::object answer = progress(name(state->stage), state->fraction);
  if (!answer.is_none() && !py::cast<bool>(py::bool_(answer))) throw Cancelled();
}

void Job::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
}

void Job::wait(const py::object& progress) {
  auto next_news = std::chrono::steady_clock::now() + time_between_news;
  try {
    for (bool is_finished = false; !is_finished;) {
      {
        const py::gil_scoped_release unlocked;
        is_finished = is_finished_within(time_between_signals);
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const auto now = std::chrono::steady_clock::now();
      if (progress.is_none() || (now < next_news && !is_finished)) continue;
      next_news = now + time_between_news;
      tell(progress);
    }
  } catch (...) {
    stop();
    throw;
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, {}));
}

void run(const py::object& progress, std::function<void(Job&)> work) {
  auto job = std::make_shared<Job>();
  jobs.load()->add(job);
  auto body = [job, work = std::move(work)]() mutable {
    std::exception_ptr failure;
    try {
      work(*job);
    } catch (...) {
      failure = std::current_exception();
    }
    work = {};
    jobs.load()->remove(job);
    job->finish(std::move(failure));
  };
  try {
    std::thread(std::move(body)).detach();
  } catch (const std::system_error& error) {
    jobs.load()->remove(job);
    throw Error(std::string("no thread can be begun: ") + error.what());
  }
  job->wait(progress);
}

void wait_for_abandoned() {
  while (!jobs.load()->stop_all()) {
    {
      const py::gil_scoped_release unlocked;
      std::this_thread::sleep_for(10ms);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void watch_forks() { pthread_atfork(nullptr, nullptr, note_fork); }

}  // namespace loft::python
