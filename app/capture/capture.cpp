// SPDX-License-Identifier: MIT
#include "app/capture/capture.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "app/memory.h"
#include "cdt/effort.h"
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
  refresh();
  thread_ = std::thread([this] { run(); });
}

/// What the session has, as far as it is wanted.
void Capture::each_edit(const io::Session::Take& take) {
  const std::uint64_t end = setup_.most_edits.value_or(session_->edit_count());
  for_each_with_undo(*session_,
                     [&](std::uint64_t number, Edit&& edit, const std::optional<io::Undo>& undo) {
                       if (number >= end) return;
                       told_.history.add(edit, undo);
                       take(number, std::move(edit));
                     });
}

/// Edit by edit, for who wants to see each.
void Capture::repeat_session() {
  each_edit([&](std::uint64_t number, Edit&& edit) {
    const Applied applied = apply(edit, cdt::Effort::unlimited);
    if (applied.answer.outcome != Answer::Outcome::taken)
      throw cannot_be_applied(number, applied.answer.error);
    applied.change.bring_up_to_date(++told_.edits, told_.slabs);
    told_.view = make_view();
    setup_.observe(applied.change, *told_.view);
  });
  told_.stack = surfaces_.stack();
}

/// Makes the slices that the edits have left, each once, whatever the number of edits.
void Capture::resume_session() {
  std::map<double, std::uint64_t> last_edits;  // of slices that are there, by height
  NetChange none;
  each_edit([&](std::uint64_t number, Edit&& edit) {
    if (edit.kind != Edit::Kind::remove) surfaces_.add_labels(edit.slice, none);
    if (const auto problem = told_.stack.apply(edit)) throw cannot_be_applied(number, *problem);
    last_edits[edit.slice.z] = ++told_.edits;
  });
  for (const auto& [z, slice] : told_.stack.slices()) {
    try {
      surfaces_.insert(slice);
    } catch (const Error& error) {
      throw cannot_be_applied(last_edits.at(z), error.what());
    }
  }
  tell_all(last_edits);
}

/// A slab is as old as the last edit of its slices.
void Capture::tell_all(const std::map<double, std::uint64_t>& last_edits) {
  const auto last = [&](double z) {
    const auto found = last_edits.find(z);  // not there beyond the ends, for domes
    return found == last_edits.end() ? 0 : found->second;
  };
  const auto parts = surfaces_.parts();
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const SlabInfo& slab : parts[i].surface->slabs())
      told_.slabs[{i, slab.id}] = {parts[i].label, slab, std::max(last(slab.low), last(slab.high))};
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

void Capture::close(std::chrono::milliseconds patience) {
  {
    std::unique_lock lock(queue_mutex_);
    is_closed_ = true;
    queue_changed_.notify_all();
    queue_changed_.wait_for(lock, patience, [this] { return is_done_; });
  }
  is_given_up_ = true;
  close();
}

// --- The queue ---

Capture::Submission Capture::submit(Edit edit, Done done, std::chrono::milliseconds patience,
                                    Origin origin) {
  return enqueue({std::move(edit), std::move(done), Clock::now(), std::move(origin)}, patience);
}

Capture::Submission Capture::submit(Way way, Done done, std::chrono::milliseconds patience) {
  return enqueue(
      {.edit = {}, .done = std::move(done), .begin = Clock::now(), .origin = {}, .way = way},
      patience);
}

Capture::Submission Capture::enqueue(Job job, std::chrono::milliseconds patience) {
  const std::size_t points = weight(job.edit);
  std::unique_lock lock(queue_mutex_);
  const auto has_room = [&] {
    return is_closed_ || queue_.empty() ||
           (queue_.size() < setup_.most_waiting &&
            points_waiting_ + points <= setup_.most_points_waiting);
  };
  if (!queue_changed_.wait_for(lock, patience, has_room)) return Submission::full;
  if (is_closed_) return Submission::closed;
  points_waiting_ += points;
  queue_.push_back(std::move(job));
  queue_changed_.notify_all();
  return Submission::taken;
}

/// Waits for some; none when all is done. What goes back or forth comes alone: it rests on what was
/// kept before it.
std::vector<Capture::Job> Capture::next_jobs() {
  std::unique_lock lock(queue_mutex_);
  queue_changed_.wait(lock, [&] { return is_closed_ || !queue_.empty(); });
  std::vector<Job> jobs;
  // Who observes wants to see the surface after each.
  const std::size_t most = setup_.observe ? 1 : most_at_once;
  while (!queue_.empty() && jobs.size() < most) {
    const bool is_alone = queue_.front().way.has_value();
    if (is_alone && !jobs.empty()) break;
    points_waiting_ -= weight(queue_.front().edit);
    jobs.push_back(std::move(queue_.front()));
    queue_.pop_front();
    if (is_alone) break;
  }
  queue_changed_.notify_all();
  return jobs;
}

void Capture::run() {
  for (auto jobs = next_jobs(); !jobs.empty(); jobs = next_jobs()) {
    try {
      work_off(jobs);
    } catch (const std::exception& error) {
      // Such as no memory for the answers: those that wait for them are told so.
      for (const Job& job : jobs)
        if (job.done) job.done({Answer::Outcome::rejected, error.what()});
    }
  }
  const std::lock_guard lock(queue_mutex_);
  is_done_ = true;
  queue_changed_.notify_all();
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
void Capture::work_off(std::vector<Job>& jobs) {
  give_back_held(jobs);
  std::vector<Applied> all;
  for (Job& job : jobs) all.push_back(job.way ? go(job) : apply(job.edit, setup_.most_effort));
  const std::string failure = keep(jobs, all);
  if (failure.empty()) {
    tell(jobs, all);
  } else {
    take_back(jobs, all, failure);
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    // Each is answered once.
    const Done done = std::exchange(jobs[i].done, nullptr);
    if (done) done(all[i].answer);
  }
}

/// In the session, where there is one. What went wrong, or nothing.
std::string Capture::keep(const std::vector<Job>& jobs, const std::vector<Applied>& all) {
  if (!session_) return {};
  std::vector<Edit> taken;
  std::optional<io::InputPosition> position;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (all[i].answer.outcome == Answer::Outcome::ended) continue;  // it comes again
    if (jobs[i].origin.position) position = jobs[i].origin.position;
    if (all[i].answer.outcome == Answer::Outcome::taken) taken.push_back(jobs[i].edit);
  }
  try {
    if (taken.size() == 1 && jobs.front().undo)
      session_->append(taken.front(), *jobs.front().undo);
    else
      session_->append(taken, position);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

void Capture::tell(const std::vector<Job>& jobs, std::vector<Applied>& all) {
  const auto view = make_view();
  const std::lock_guard lock(told_mutex_);
  told_.view = view;
  told_.counts = surfaces_.counts();
  told_.volume = surfaces_.volume();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Answer& answer = all[i].answer;
    answer.latency_ms = milliseconds(Clock::now() - jobs[i].begin);
    if (answer.outcome != Answer::Outcome::taken) {
      if (answer.outcome == Answer::Outcome::rejected) ++told_.rejected;
      show_undone(all[i].change);
      continue;
    }
    all[i].change.bring_up_to_date(++told_.edits, told_.slabs);
    note(jobs[i], all[i].exchange);
    told_.latencies.push_back(answer.latency_ms);
    if (told_.latencies.size() > latency_count) told_.latencies.pop_front();
    publish(jobs[i].edit, all[i].change, answer.latency_ms);
    if (setup_.observe) setup_.observe(all[i].change, *told_.view);
  }
}

/// That an edit was taken.
void Capture::note(const Job& job, const LabelledSurfaces::Exchange& exchange) {
  told_.stack.set(exchange.z, exchange.after);
  told_.history.add(job.edit, job.undo);
  if (!session_) told_.history.remember(exchange.before, exchange.after);
}

void Capture::take_back(std::vector<Job>& jobs, std::vector<Applied>& all,
                        const std::string& failure) {
  NetChange undone;
  std::uint64_t rejected = 0;
  for (const Applied& applied : all) undone.add(applied.change);
  for (std::size_t i = jobs.size(); i-- > 0;) {
    Applied& applied = all[i];
    const bool is_taken = applied.answer.outcome == Answer::Outcome::taken;
    const bool comes_again = is_taken && jobs[i].origin.is_held != nullptr;
    const bool is_answered = applied.answer.outcome == Answer::Outcome::ended ||
                             applied.answer.outcome == Answer::Outcome::nothing;
    if (!comes_again && !is_answered) ++rejected;
    if (!is_taken) continue;
    surfaces_.take_back(applied.exchange, undone);
    applied.answer = {Answer::Outcome::not_kept, failure};
    applied.answer.edit = std::move(jobs[i].edit);
  }
  refresh();
  const std::lock_guard lock(told_mutex_);
  told_.rejected += rejected;
  show_undone(undone);
}

// --- The surfaces ---

/// Back or forth: the edit that does so takes whatever it takes, as what it makes was there before.
Capture::Applied Capture::go(Job& job) {
  Applied applied;
  const auto of = told_.history.next(*job.way);
  if (!of) {
    applied.answer = {Answer::Outcome::nothing, *job.way == Way::undo
                                                    ? "there is nothing to undo"
                                                    : "there is nothing to do again"};
    return applied;
  }
  try {
    job.edit = told_.history.edit(*job.way, session_ ? &*session_ : nullptr, surfaces_.stack());
  } catch (const std::exception& error) {
    applied.answer = {Answer::Outcome::rejected, error.what()};
    return applied;
  }
  job.undo = io::Undo{*of, *job.way == Way::redo};
  return apply(job.edit, cdt::Effort::unlimited);
}

Capture::Applied Capture::apply(const Edit& edit, std::uint64_t most_effort) {
  Applied applied;
  applied.answer.kind = edit.kind;
  applied.answer.z = edit.slice.z;
  if (is_given_up_) {
    applied.answer = {Answer::Outcome::ended, "the capture has ended"};
    return applied;
  }
  try {
    const cdt::Effort effort(most_effort, &is_given_up_);
    applied.exchange = surfaces_.apply(edit, applied.change);
  } catch (const cdt::TooMuchEffort&) {
    applied.answer = {Answer::Outcome::rejected,
                      "it would take more steps than an edit may (--max-effort); send simpler "
                      "contours"};
    if (is_given_up_) applied.answer = {Answer::Outcome::ended, "the capture has ended"};
    return applied;
  } catch (const std::exception& error) {  // whatever it is, the capture goes on
    applied.answer = {Answer::Outcome::rejected, error.what()};
    return applied;
  }
  applied.answer.removed = slab_names(applied.change.removed());
  applied.answer.added = slab_names(applied.change.added());
  applied.answer.repairs = applied.change.repairs();
  return applied;
}

// --- What others see ---

void Capture::refresh() {
  const auto view = make_view();
  const std::lock_guard lock(told_mutex_);
  told_.view = view;
  told_.counts = surfaces_.counts();
  told_.volume = surfaces_.volume();
}

/// Slabs were made anew on the way back from an edit that was not taken: viewers start again.
void Capture::show_undone(const NetChange& change) {
  if (change.is_empty()) return;
  change.bring_up_to_date(told_.edits, told_.slabs);
  feed_.publish("");
  if (setup_.observe) setup_.observe(change, *told_.view);
}

void Capture::publish(const Edit& edit, const NetChange& change, double latency_ms) {
  const Json z = Json::array({edit.slice.z});
  const bool is_removal = edit.kind == Edit::Kind::remove;
  const Json event{{"removed", slab_names(change.removed())},
                   {"added", change.added_as_json(told_.edits)},
                   {"slices_removed", is_removal ? z : Json::array()},
                   {"slices_added", is_removal ? Json::array() : z},
                   {"counts", told_.counts},
                   {"volume", told_.volume},
                   {"latency_ms", latency_ms},
                   {"edits", told_.edits}};
  feed_.publish(event.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Made once for all viewers that start between two edits, and not while edits wait for it.
std::pair<std::string, std::uint64_t> Capture::reset_event() const {
  const std::lock_guard reset_lock(reset_mutex_);
  std::vector<std::pair<SlabKey, ShownSlab>> shown;
  Json event;
  std::uint64_t next = 0;
  {
    const std::lock_guard lock(told_mutex_);
    next = feed_.last() + 1;
    if (reset_ && reset_->second == next) return *reset_;
    shown.assign(told_.slabs.begin(), told_.slabs.end());
    Json slices = Json::array();
    for (const auto& [z, slice] : told_.stack.slices()) slices.push_back(z);
    event = {{"kind", setup_.kind},
             {"name", setup_.name},
             {"is_patient", false},  // a stream has no frame
             {"slices", std::move(slices)},
             {"counts", told_.counts},
             {"volume", told_.volume},
             {"unit", setup_.unit},
             {"metres_per_unit", setup_.metres_per_unit},
             {"edits", told_.edits}};
  }
  Json slabs = Json::array();
  for (const auto& [key, slab] : shown) slabs.push_back(to_json(key, slab));
  event["slabs"] = std::move(slabs);
  reset_ = {event.dump(-1, ' ', false, Json::error_handler_t::replace), next};
  return *reset_;
}

std::shared_ptr<const CaptureView> Capture::view() const {
  const std::lock_guard lock(told_mutex_);
  return told_.view;
}

std::shared_ptr<const CaptureView> Capture::make_view() {
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
  return view;
}

/// What is gone comes from the edit that is being told.
std::uint64_t Capture::birth(std::size_t part, std::uint32_t slab) const {
  const std::lock_guard lock(told_mutex_);
  const auto found = told_.slabs.find({part, slab});
  return found == told_.slabs.end() ? told_.edits + 1 : found->second.edit;
}

std::optional<Slice> Capture::slice(double z) const {
  io::StackState::SharedSlice found;
  {
    const std::lock_guard lock(told_mutex_);
    found = told_.stack.find(z);
  }
  if (found == nullptr) return {};
  return *found;
}

std::vector<double> Capture::heights() const {
  const std::lock_guard lock(told_mutex_);
  std::vector<double> heights;
  for (const auto& [z, slice] : told_.stack.slices()) heights.push_back(z);
  return heights;
}

std::uint64_t Capture::edit_count() const {
  const std::lock_guard lock(told_mutex_);
  return told_.edits;
}

Json Capture::history() const {
  const std::lock_guard lock(told_mutex_);
  return told_.history.to_json();
}

std::uint64_t Capture::rejected_count() const {
  const std::lock_guard lock(told_mutex_);
  return told_.rejected;
}

Json Capture::status() const {
  std::size_t waiting = 0;
  {
    const std::lock_guard lock(queue_mutex_);
    waiting = queue_.size();
  }
  const std::lock_guard lock(told_mutex_);
  std::vector<double> sorted(told_.latencies.begin(), told_.latencies.end());
  std::ranges::sort(sorted);
  const auto at = [&](std::size_t percent) {
    return sorted.empty() ? 0 : sorted[(sorted.size() - 1) * percent / 100];
  };
  Json status{{"edits", told_.edits}, {"rejected", told_.rejected}};
  status.update(told_.counts);
  status["volume"] = told_.volume;
  status["latency_ms"] = {{"median", at(50)},
                          {"p99", at(99)},
                          {"last", told_.latencies.empty() ? 0 : told_.latencies.back()}};
  status["queue"] = waiting;
  status["memory_bytes"] = memory_in_use();
  status["session"] = session_.has_value();
  status["version"] = io::version();
  return status;
}

}  // namespace loft::app
