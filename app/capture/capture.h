// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/capture/feed.h"
#include "app/capture/history.h"
#include "app/capture/labelled_surfaces.h"
#include "app/capture/net_change.h"
#include "app/json.h"
#include "io/session/session.h"
#include "io/stacks/edit.h"
#include "reconstruct/live/snapshot.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// What became of an edit.
struct Answer {
  enum class Outcome {
    nothing,   ///< there is nothing to undo, or to do again
    taken,     ///< it is in the surface and, with a session, durable
    rejected,  ///< it makes no sense there: `error` says why
    not_kept,  ///< the session could not be written; the surface is as before
    ended,     ///< the capture was ended before it could be taken
  };

  Outcome outcome = Outcome::taken;
  std::string error = {};
  std::vector<std::string> removed = {};  ///< slabs, as viewers know them
  std::vector<std::string> added = {};
  std::vector<std::string> repairs = {};
  double latency_ms = 0;                         ///< since it was submitted
  std::optional<io::Edit> edit = {};             ///< back, where it was not kept
  io::Edit::Kind kind = io::Edit::Kind::insert;  ///< what was done, and where
  double z = 0;
};

/// A capture at one time, for output and viewers.
struct CaptureView {
  struct Part {
    std::string label;
    Snapshot snapshot;
  };
  std::vector<Part> parts;  ///< by the order in which labels came up
  Vec3 origin{};            ///< that all GLBs of slabs are relative to
  std::uint64_t edits = 0;
};

/// The surfaces of a stack that edits come for, from any number of threads. One thread of its own
/// applies them in their order, one label after the other; what has been applied since the last
/// time goes into the session in one transaction; then it is answered, and viewers are told.
/// What waits to be applied is bounded: submit() waits, and says so when it has waited long enough.
///
/// What others ask for is answered from what was last told of: nobody waits for an edit that is
/// being applied. No edit ends the capture, whatever is thrown.
class Capture {
 public:
  struct Setup {
    std::string kind = "capture";         ///< what viewers are told that it is: or a `session`
    std::string name = {};                ///< of its file
    Options options = {};                 ///< threads is ignored: one thread works
    std::vector<StackLabel> labels = {};  ///< what their source tells of them, as far as it does
    std::string unit = "mm";
    double metres_per_unit = 0.001;
    /// Steps that one edit may take (cdt/effort.h); beyond, it is rejected and nothing has changed.
    /// What a session has is repeated whatever it takes.
    std::uint64_t most_effort = 2'000'000'000;
    std::size_t most_waiting = 256;             ///< edits
    std::size_t most_points_waiting = 4 << 20;  ///< points in them
    /// Of what a session has only so many edits are made; none: all.
    std::optional<std::uint64_t> most_edits = {};
    /// Called after each edit that has changed slabs or was taken, in the capture's thread, in
    /// their order.
    std::function<void(const NetChange&, const CaptureView&)> observe = {};
  };
  enum class Submission { taken, full, closed };
  using Done = std::function<void(const Answer&)>;
  /// What edits bring along that come from a file, or from a source that can wait.
  struct Origin {
    std::optional<io::InputPosition> position = {};  ///< behind the edit; kept with it
    /// As long as it is true the edit is not kept, untried: one before it was not.
    const std::atomic<bool>* is_held = nullptr;
  };

  /// Applies what is in the session first. Throws FileError, and InputError where the session does
  /// not fit to the options.
  Capture(Setup setup, std::optional<io::Session> session, Feed& feed);
  ~Capture();
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  /// `done` is called once, by the capture's thread, if the edit was taken on.
  Submission submit(io::Edit edit, Done done, std::chrono::milliseconds patience) {
    return submit(std::move(edit), std::move(done), patience, {});
  }
  Submission submit(io::Edit edit, Done done, std::chrono::milliseconds patience, Origin origin);
  /// Takes the last edit back that was not, or does it again (history.h).
  Submission submit(Way way, Done done, std::chrono::milliseconds patience);
  /// Takes no more; returns when everything that waits is done.
  void close();
  /// The same; what is not done after that time is given up (Answer::Outcome::ended).
  void close(std::chrono::milliseconds patience);

  /// The state after some edit; the same object as long as nothing changes.
  [[nodiscard]] std::shared_ptr<const CaptureView> view() const;
  /// The number of the edit that made a slab.
  [[nodiscard]] std::uint64_t birth(std::size_t part, std::uint32_t slab) const;
  /// The slice at a height as it came in, or null.
  [[nodiscard]] std::optional<Slice> slice(double z) const;
  [[nodiscard]] std::vector<double> heights() const;

  /// All that there is, as an event for a viewer that starts, and the number of the event after it.
  [[nodiscard]] std::pair<std::string, std::uint64_t> reset_event() const;
  [[nodiscard]] Json status() const;
  /// Edits that were taken; and those that were rejected or not kept.
  [[nodiscard]] std::uint64_t edit_count() const;
  [[nodiscard]] std::uint64_t rejected_count() const;
  [[nodiscard]] Json history() const;

  [[nodiscard]] const Setup& setup() const { return setup_; }
  [[nodiscard]] bool has_session() const { return session_.has_value(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Job {
    io::Edit edit;
    Done done;
    Clock::time_point begin;
    Origin origin;
    std::optional<Way> way = {};  // the edit is found when it is its turn
    std::optional<io::Undo> undo = {};
  };
  struct Applied;

  void each_edit(const io::Session::Take& take);
  void repeat_session();
  void resume_session();
  void tell_all(const std::map<double, std::uint64_t>& last_edits);
  void run();
  [[nodiscard]] std::vector<Job> next_jobs();
  static void give_back_held(std::vector<Job>& jobs);
  void work_off(std::vector<Job>& jobs);
  [[nodiscard]] std::string keep(const std::vector<Job>& jobs, const std::vector<Applied>& all);
  void tell(const std::vector<Job>& jobs, std::vector<Applied>& all);
  void take_back(std::vector<Job>& jobs, std::vector<Applied>& all, const std::string& failure);
  [[nodiscard]] std::shared_ptr<const CaptureView> make_view();
  [[nodiscard]] Submission enqueue(Job job, std::chrono::milliseconds patience);
  [[nodiscard]] Applied apply(const io::Edit& edit, std::uint64_t most_effort);
  [[nodiscard]] Applied go(Job& job);
  void note(const Job& job, const LabelledSurfaces::Exchange& exchange);
  void refresh();
  void show_undone(const NetChange& change);
  void publish(const io::Edit& edit, const NetChange& change, double latency_ms);

  Setup setup_;
  std::optional<io::Session> session_;
  Feed& feed_;

  mutable std::mutex queue_mutex_;
  std::condition_variable queue_changed_;
  std::deque<Job> queue_;
  std::size_t points_waiting_ = 0;
  bool is_closed_ = false;
  bool is_done_ = false;

  LabelledSurfaces surfaces_;  // of the capture's thread alone, as the next one
  std::optional<Vec3> origin_;
  std::atomic<bool> is_given_up_ = false;

  /// What others have been told, which is all that they can ask for.
  struct Told {
    ShownSlabs slabs;
    io::StackState stack;
    Json counts;
    double volume = 0;
    std::shared_ptr<const CaptureView> view;
    std::uint64_t edits = 0;
    std::uint64_t rejected = 0;
    std::deque<double> latencies;  // of the last edits
    History history;
  };
  mutable std::mutex told_mutex_;
  Told told_;

  mutable std::mutex reset_mutex_;
  mutable std::optional<std::pair<std::string, std::uint64_t>> reset_;  // as reset_event()

  std::thread thread_;
};

}  // namespace loft::app
