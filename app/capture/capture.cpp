// SPDX-License-Identifier: MIT
#include "app/capture/capture.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "app/memory.h"
#include "io/bytes/file.h"
#include "io/version.h"

namespace loft::app {

namespace {

using io::Edit;

/// So many edits go into the session in one transaction at most.
constexpr std::size_t most_at_once = 64;

/// So many latencies are remembered.
constexpr std::size_t latency_count = 4096;

double milliseconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

/// What an edit counts in the queue, in points.
std::size_t weight(const Edit& edit) {
  return point_count(edit.slice) + 4 * edit.slice.contours.size();
}

InputError cannot_be_applied(std::uint64_t edit, const std::string& why) {
  return InputError("edit " + std::to_string(edit) + " of the session cannot be applied: " + why);
}

Options single_threaded(Options options) {
  options.threads = 1;
  return options;
}

}  // namespace

/// An edit that was applied, or why it was not.
struct Capture::Applied {
  Answer answer;
  NetChange change;
  LabelledSurfaces::Exchange exchange;
};

Capture::Capture(Setup setup, std::optional<io::Session> session, Feed& feed)
    : setup_(std::move(setup)),
      session_(std::move(session)),
      feed_(feed),
      surfaces_(single_threaded(setup_.options)) {
  if (session_ && setup_.observe) repeat_session();
  if (session_ && !setup_.observe) resume_session();
  thread_ = std::thread([this] { run(); });
}

/// Edit by edit, for who wants to see each.
void Capture::repeat_session() {
  session_->for_each([&](std::uint64_t number, Edit&& edit) {
    const Applied applied = apply(edit);
    if (applied.answer.outcome != Answer::Outcome::taken)
      throw cannot_be_applied(number, applied.answer.error);
    applied.change.note_births(++edits_, births_);
    setup_.observe(applied.change, *view_now());
  });
}

/// Makes the slices that the edits have left, each once, whatever the number of edits.
void Capture::resume_session() {
  std::map<double, std::uint64_t> last_edits;  // of slices that are there, by height
  NetChange none;
  io::StackState stack;
  session_->for_each([&](std::uint64_t number, Edit&& edit) {
    if (edit.kind != Edit::Kind::remove) surfaces_.add_labels(edit.slice, none);
    if (const auto problem = stack.apply(edit)) throw cannot_be_applied(number, *problem);
    last_edits[edit.slice.z] = ++edits_;
  });
  for (const auto& [z, slice] : stack.slices()) {
    try {
      surfaces_.insert(slice);
    } catch (const Error& error) {
      throw cannot_be_applied(last_edits.at(z), error.what());
    }
  }
  note_births(last_edits);
}

/// A slab is as old as the last edit of its slices.
void Capture::note_births(const std::map<double, std::uint64_t>& last_edits) {
  const auto last = [&](double z) {
    const auto found = last_edits.find(z);  // not there beyond the ends, for domes
    return found == last_edits.end() ? 0 : found->second;
  };
  for_each_slab([&](const SlabKey& key, const std::string&, const SlabInfo& slab) {
    births_[key] = std::max(last(slab.low), last(slab.high));
  });
}

template <class Visit>
void Capture::for_each_slab(Visit visit) const {
  const auto parts = surfaces_.parts();
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const SlabInfo& slab : parts[i].surface->slabs())
      visit(SlabKey{i, slab.id}, parts[i].label, slab);
}

Capture::~Capture() { close(); }

void Capture::close() {
  {
    const std::lock_guard lock(queue_mutex_);
    is_closed_ = true;
  }
  queue_changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

// --- The queue ---

Capture::Submission Capture::submit(Edit edit, Done done, std::chrono::milliseconds patience,
                                    Origin origin) {
  const std::size_t points = weight(edit);
  std::unique_lock lock(queue_mutex_);
  const auto has_room = [&] {
    return is_closed_ || queue_.empty() ||
           (queue_.size() < setup_.most_waiting &&
            points_waiting_ + points <= setup_.most_points_waiting);
  };
  if (!queue_changed_.wait_for(lock, patience, has_room)) return Submission::full;
  if (is_closed_) return Submission::closed;
  points_waiting_ += points;
  queue_.push_back({std::move(edit), std::move(done), Clock::now(), std::move(origin)});
  queue_changed_.notify_all();
  return Submission::taken;
}

/// Waits for some; none when all is done.
std::vector<Capture::Job> Capture::next_jobs() {
  std::unique_lock lock(queue_mutex_);
  queue_changed_.wait(lock, [&] { return is_closed_ || !queue_.empty(); });
  std::vector<Job> jobs;
  // Who observes wants to see the surface after each.
  const std::size_t most = setup_.observe ? 1 : most_at_once;
  while (!queue_.empty() && jobs.size() < most) {
    points_waiting_ -= weight(queue_.front().edit);
    jobs.push_back(std::move(queue_.front()));
    queue_.pop_front();
  }
  queue_changed_.notify_all();
  return jobs;
}

void Capture::run() {
  for (auto jobs = next_jobs(); !jobs.empty(); jobs = next_jobs()) work_off(std::move(jobs));
}

/// Those of a source that waits.
void Capture::give_back_held(std::vector<Job>& jobs) {
  const auto first = std::stable_partition(jobs.begin(), jobs.end(), [](const Job& job) {
    return job.origin.is_held == nullptr || !*job.origin.is_held;
  });
  for (auto job = first; job != jobs.end(); ++job) {
    Answer answer{Answer::Outcome::not_kept};
    answer.edit = std::move(job->edit);
    job->done(answer);
  }
  jobs.erase(first, jobs.end());
}

/// Applies some edits, keeps them, answers.
void Capture::work_off(std::vector<Job> jobs) {
  give_back_held(jobs);
  begin_batch();
  std::vector<Applied> all;
  std::vector<Edit> taken;
  std::optional<io::InputPosition> position;
  for (const Job& job : jobs) {
    if (job.origin.position) position = job.origin.position;
    const std::lock_guard lock(state_mutex_);
    all.push_back(apply(job.edit));
    if (all.back().answer.outcome == Answer::Outcome::taken) taken.push_back(job.edit);
  }
  std::string failure;
  try {
    if (session_) session_->append(taken, position);
  } catch (const Error& error) {
    failure = error.what();
  }
  {
    const std::lock_guard lock(state_mutex_);
    if (failure.empty()) {
      for (std::size_t i = 0; i < jobs.size(); ++i) {
        Answer& answer = all[i].answer;
        answer.latency_ms = milliseconds(Clock::now() - jobs[i].begin);
        if (answer.outcome != Answer::Outcome::taken) {
          ++rejected_;
          show_undone(all[i].change);
          continue;
        }
        all[i].change.note_births(++edits_, births_);
        latencies_.push_back(answer.latency_ms);
        if (latencies_.size() > latency_count) latencies_.pop_front();
        publish(jobs[i].edit, all[i].change, answer.latency_ms);
        if (setup_.observe) setup_.observe(all[i].change, *view_now());
      }
    } else {
      NetChange undone;
      for (const Applied& applied : all) undone.add(applied.change);
      for (std::size_t i = jobs.size(); i-- > 0;) {
        Applied& applied = all[i];
        const bool is_taken = applied.answer.outcome == Answer::Outcome::taken;
        const bool comes_again = is_taken && jobs[i].origin.is_held != nullptr;
        if (!comes_again) ++rejected_;
        if (!is_taken) continue;
        surfaces_.take_back(applied.exchange, undone);
        applied.answer = {Answer::Outcome::not_kept, failure};
        applied.answer.edit = std::move(jobs[i].edit);
      }
      view_.reset();
      show_undone(undone);
    }
    is_unpublished_ = false;
  }
  published_.notify_all();
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (jobs[i].done) jobs[i].done(all[i].answer);
}

/// From now on there are slabs that no event has told of. Viewers that start go first.
void Capture::begin_batch() {
  std::unique_lock lock(state_mutex_);
  published_.wait(lock, [this] { return !is_waited_for_; });
  is_unpublished_ = true;
}

// --- The surfaces ---

Capture::Applied Capture::apply(const Edit& edit) {
  Applied applied;
  view_.reset();
  try {
    applied.exchange = surfaces_.apply(edit, applied.change);
  } catch (const std::exception& error) {  // whatever an edit throws, the capture goes on
    applied.answer = {Answer::Outcome::rejected, error.what()};
    return applied;
  }
  applied.answer.removed = slab_names(applied.change.removed());
  applied.answer.added = slab_names(applied.change.added());
  applied.answer.repairs = applied.change.repairs();
  return applied;
}

// --- What others see ---

/// Slabs were made anew on the way back from an edit that was not taken: viewers start again.
void Capture::show_undone(const NetChange& change) {
  if (change.is_empty()) return;
  change.note_births(edits_, births_);
  feed_.publish("");
  if (setup_.observe) setup_.observe(change, *view_now());
}

void Capture::publish(const Edit& edit, const NetChange& change, double latency_ms) {
  const Json z = Json::array({edit.slice.z});
  const bool is_removal = edit.kind == Edit::Kind::remove;
  const Json event{{"removed", slab_names(change.removed())},
                   {"added", change.added_as_json(edits_)},
                   {"slices_removed", is_removal ? z : Json::array()},
                   {"slices_added", is_removal ? Json::array() : z},
                   {"counts", surfaces_.counts()},
                   {"volume", surfaces_.volume()},
                   {"latency_ms", latency_ms},
                   {"edits", edits_}};
  feed_.publish(event.dump());
}

/// Made once for all viewers that start between two edits, and not while edits wait for it.
std::pair<std::string, std::uint64_t> Capture::reset_event() const {
  const std::lock_guard reset_lock(reset_mutex_);
  struct Shown {
    SlabKey key;
    std::string label;
    SlabInfo slab;
    std::uint64_t edit;
  };
  std::vector<Shown> shown;
  Json event;
  std::uint64_t next = 0;
  {
    std::unique_lock lock(state_mutex_);
    // What no event has told of yet would come a second time.
    is_waited_for_ = true;
    published_.wait(lock, [this] { return !is_unpublished_; });
    is_waited_for_ = false;
    published_.notify_all();
    next = feed_.last() + 1;
    if (reset_ && reset_->second == next) return *reset_;
    for_each_slab([&](const SlabKey& key, const std::string& label, const SlabInfo& slab) {
      shown.push_back({key, label, slab, born(key)});
    });
    Json slices = Json::array();
    for (const auto& [z, slice] : surfaces_.stack().slices()) slices.push_back(z);
    event = {{"slices", std::move(slices)},
             {"counts", surfaces_.counts()},
             {"volume", surfaces_.volume()},
             {"unit", setup_.unit},
             {"metres_per_unit", setup_.metres_per_unit},
             {"edits", edits_}};
  }
  Json slabs = Json::array();
  for (const Shown& one : shown) slabs.push_back(to_json(one.key, one.label, one.slab, one.edit));
  event["slabs"] = std::move(slabs);
  reset_ = {event.dump(), next};
  return *reset_;
}

std::shared_ptr<const CaptureView> Capture::view() {
  const std::lock_guard lock(state_mutex_);
  return view_now();
}

std::shared_ptr<const CaptureView> Capture::view_now() {
  if (view_) return view_;
  auto view = std::make_shared<CaptureView>();
  for (const LabelledSurfaces::Part& part : surfaces_.parts())
    view->parts.push_back({part.label, part.surface->snapshot()});
  const auto is_empty = [](const CaptureView::Part& part) {
    return part.snapshot.slab_count() == 0;
  };
  // What comes next may be far away.
  if (std::ranges::all_of(view->parts, is_empty)) origin_.reset();
  for (const CaptureView::Part& part : view->parts) {
    if (origin_ || part.snapshot.slab_count() == 0) continue;
    const Patch patch = part.snapshot.patch(0, 1);
    if (!patch.mesh.points.empty()) origin_ = patch.mesh.points.front();
  }
  view->origin = origin_.value_or(Vec3{});
  view->edits = edits_;
  view_ = std::move(view);
  return view_;
}

std::uint64_t Capture::birth(std::size_t part, std::uint32_t slab) const {
  const std::lock_guard lock(state_mutex_);
  return born({part, slab});
}

/// What is not noted yet comes from the edit that is being applied.
std::uint64_t Capture::born(const SlabKey& slab) const {
  const auto found = births_.find(slab);
  return found == births_.end() ? edits_ + 1 : found->second;
}

std::optional<Slice> Capture::slice(double z) const {
  const std::lock_guard lock(state_mutex_);
  const auto found = surfaces_.stack().find(z);
  if (found == nullptr) return {};
  return *found;
}

std::vector<double> Capture::heights() const {
  const std::lock_guard lock(state_mutex_);
  std::vector<double> heights;
  for (const auto& [z, slice] : surfaces_.stack().slices()) heights.push_back(z);
  return heights;
}

std::uint64_t Capture::edit_count() const {
  const std::lock_guard lock(state_mutex_);
  return edits_;
}

std::uint64_t Capture::rejected_count() const {
  const std::lock_guard lock(state_mutex_);
  return rejected_;
}

Json Capture::status() const {
  std::size_t waiting = 0;
  {
    const std::lock_guard lock(queue_mutex_);
    waiting = queue_.size();
  }
  const std::lock_guard lock(state_mutex_);
  std::vector<double> sorted(latencies_.begin(), latencies_.end());
  std::ranges::sort(sorted);
  const auto at = [&](std::size_t percent) {
    return sorted.empty() ? 0 : sorted[(sorted.size() - 1) * percent / 100];
  };
  Json status{{"edits", edits_}, {"rejected", rejected_}};
  status.update(surfaces_.counts());
  status["volume"] = surfaces_.volume();
  status["latency_ms"] = {
      {"median", at(50)}, {"p99", at(99)}, {"last", latencies_.empty() ? 0 : latencies_.back()}};
  status["queue"] = waiting;
  status["memory_bytes"] = memory_in_use();
  status["session"] = session_.has_value();
  status["version"] = io::version();
  return status;
}

}  // namespace loft::app
