// SPDX-License-Identifier: MIT
#include "app/capture.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/memory.h"
#include "io/file.h"
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

/// Only the points with that label; contours keep their numbers.
Slice with_label(const Slice& slice, const std::string& label) {
  Slice result{slice.z, {}};
  for (const Contour& contour : slice.contours) {
    result.contours.emplace_back().label = contour.label;
    if (contour.label == label) result.contours.back().points = contour.points;
  }
  return result;
}

/// Takes an edit back.
Edit inverse(const Edit& edit, const io::StackState& before) {
  const auto there = before.slices().find(edit.slice.z);
  if (there == before.slices().end()) return {Edit::Kind::remove, {edit.slice.z, {}}};
  return {edit.kind == Edit::Kind::remove ? Edit::Kind::insert : Edit::Kind::replace,
          there->second};
}

}  // namespace

std::string slab_name(std::size_t part, std::uint32_t id) {
  return std::to_string(part) + '-' + std::to_string(id);
}

/// Slabs that came and went in all, over several changes: what came and went again is not in it.
class Capture::NetChange {
 public:
  void add(std::size_t part, const std::string& label, const SurfaceChange& change) {
    for (const std::uint32_t id : change.removed)
      if (added_.erase({part, id}) == 0) removed_.emplace_back(part, id);
    for (const SlabInfo& slab : change.added) added_[{part, slab.id}] = {label, slab};
    for (const Defect& repair : change.repairs) repairs_.push_back(describe(repair));
  }

  [[nodiscard]] bool is_empty() const { return removed_.empty() && added_.empty(); }

  void report(Answer& answer) const {
    for (const auto& [part, id] : removed_) answer.removed.push_back(slab_name(part, id));
    for (const auto& [key, slab] : added_) answer.added.push_back(slab_name(key.first, key.second));
    answer.repairs = repairs_;
  }

  [[nodiscard]] Json removed() const {
    Json all = Json::array();
    for (const auto& [part, id] : removed_) all.push_back(slab_name(part, id));
    return all;
  }
  [[nodiscard]] Json added(std::uint64_t edit) const {
    Json all = Json::array();
    for (const auto& [key, slab] : added_)
      all.push_back(to_json(key.first, slab.first, slab.second, edit));
    return all;
  }

  /// Slabs that came get the number of the edit.
  void note(std::uint64_t edit, std::map<SlabKey, std::uint64_t>& births) const {
    for (const SlabKey& key : removed_) births.erase(key);
    for (const auto& [key, slab] : added_) births[key] = edit;
  }

  static Json to_json(std::size_t part, const std::string& label, const SlabInfo& slab,
                      std::uint64_t edit) {
    return {{"id", slab_name(part, slab.id)},
            {"low", slab.low},
            {"high", slab.high},
            {"label", label},
            {"edit", edit}};
  }

 private:
  std::map<SlabKey, std::pair<std::string, SlabInfo>> added_;
  std::vector<SlabKey> removed_;
  std::vector<std::string> repairs_;
};

/// An edit that was applied, or why it was not.
struct Capture::Applied {
  Answer answer;
  NetChange change;
  Edit back;  // takes it back
};

Capture::Capture(Setup setup, std::optional<io::Session> session, Feed& feed)
    : setup_(std::move(setup)), session_(std::move(session)), feed_(feed) {
  setup_.options.threads = 1;
  if (session_ && setup_.observe) repeat_session();
  if (session_ && !setup_.observe) resume_session();
  thread_ = std::thread([this] { run(); });
}

namespace {

InputError cannot_be_applied(std::uint64_t edit, const std::string& why) {
  return InputError("edit " + std::to_string(edit) + " of the session cannot be applied: " + why);
}

}  // namespace

/// Edit by edit, for who wants to see each.
void Capture::repeat_session() {
  session_->for_each([&](std::uint64_t number, Edit&& edit) {
    const Applied applied = apply(edit);
    if (applied.answer.outcome != Answer::Outcome::taken)
      throw cannot_be_applied(number, applied.answer.error);
    applied.change.note(++edits_, births_);
    setup_.observe(applied.answer, *view_now());
  });
}

/// Makes the slices that the edits have left, each once, whatever the number of edits.
void Capture::resume_session() {
  std::map<double, std::uint64_t> last_edits;  // of slices that are there, by height
  NetChange none;
  io::StackState stack;
  session_->for_each([&](std::uint64_t number, Edit&& edit) {
    if (edit.kind != Edit::Kind::remove) add_parts(edit.slice, none);
    if (const auto problem = stack.apply(edit)) throw cannot_be_applied(number, *problem);
    last_edits[edit.slice.z] = ++edits_;
  });
  for (const auto& [z, slice] : stack.slices()) {
    try {
      for (Part& part : parts_)
        static_cast<void>(part.surface->insert(with_label(slice, part.label)));
    } catch (const Error& error) {
      throw cannot_be_applied(last_edits.at(z), error.what());
    }
  }
  stack_ = std::move(stack);
  note_births(last_edits);
}

/// A slab is as old as the last edit of its slices.
void Capture::note_births(const std::map<double, std::uint64_t>& last_edits) {
  const auto last = [&](double z) {
    const auto found = last_edits.find(z);  // not there beyond the ends, for domes
    return found == last_edits.end() ? 0 : found->second;
  };
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (const SlabInfo& slab : parts_[i].surface->slabs())
      births_[{i, slab.id}] = std::max(last(slab.low), last(slab.high));
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
  const std::size_t points = point_count(edit.slice);
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
    points_waiting_ -= point_count(queue_.front().edit.slice);
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
          all[i].change.note(edits_, births_);
          // Labels before the one that refused it were changed and changed back: viewers start
          // again.
          if (!all[i].change.is_empty()) feed_.publish("");
          continue;
        }
        all[i].change.note(++edits_, births_);
        latencies_.push_back(answer.latency_ms);
        if (latencies_.size() > latency_count) latencies_.pop_front();
        publish(jobs[i].edit, all[i].change, answer.latency_ms);
        if (setup_.observe) setup_.observe(answer, *view_now());
      }
    } else {
      for (std::size_t i = jobs.size(); i-- > 0;) {
        Applied& applied = all[i];
        const bool is_taken = applied.answer.outcome == Answer::Outcome::taken;
        const bool comes_again = is_taken && jobs[i].origin.is_held != nullptr;
        if (!comes_again) ++rejected_;
        if (!is_taken) continue;
        applied.change.note(edits_, births_);
        apply(applied.back).change.note(edits_, births_);
        applied.answer = {Answer::Outcome::not_kept, failure};
        applied.answer.edit = std::move(jobs[i].edit);
      }
      // Slabs were made anew on the way back: viewers start again.
      view_.reset();
      feed_.publish("");
    }
  }
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (jobs[i].done) jobs[i].done(all[i].answer);
}

// --- The surfaces ---

Capture::Applied Capture::apply(const Edit& edit) {
  Applied applied;
  applied.back = inverse(edit, stack_);
  try {
    if (edit.kind != Edit::Kind::remove) add_parts(edit.slice, applied.change);
    // Where nothing has a surface yet, that is all that can be wrong.
    if (edit.kind != Edit::Kind::insert && !stack_.slices().contains(edit.slice.z))
      throw InputError("there is no slice at that height; insert it first");
    apply_to_parts(edit, applied.change);
  } catch (const Error& error) {
    applied.answer = {Answer::Outcome::rejected, error.what()};
    view_.reset();
    return applied;
  }
  static_cast<void>(stack_.apply(edit));
  view_.reset();
  applied.change.report(applied.answer);
  return applied;
}

/// To all labels, or to none.
void Capture::apply_to_parts(const Edit& edit, NetChange& change) {
  const auto apply_to = [](Part& part, const Edit& one) {
    const Slice slice = with_label(one.slice, part.label);
    if (one.kind == Edit::Kind::insert) return part.surface->insert(slice);
    if (one.kind == Edit::Kind::replace) return part.surface->replace(slice.z, slice);
    return part.surface->remove(slice.z);
  };
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    try {
      change.add(i, parts_[i].label, apply_to(parts_[i], edit));
    } catch (...) {
      const Edit back = inverse(edit, stack_);
      for (std::size_t k = 0; k < i; ++k) change.add(k, parts_[k].label, apply_to(parts_[k], back));
      throw;
    }
  }
}

/// A label that comes up for the first time has a surface from then on, with all slices so far.
void Capture::add_parts(const Slice& slice, NetChange& change) {
  const auto add = [&](const std::string& label) {
    if (std::ranges::find(parts_, label, &Part::label) != parts_.end()) return;
    Options options = setup_.options;
    options.label = label;
    Part part{label, std::make_unique<Reconstruction>(options)};
    for (const auto& [z, before] : stack_.slices())
      change.add(parts_.size(), label, part.surface->insert(with_label(before, label)));
    parts_.push_back(std::move(part));
  };
  if (slice.contours.empty() && parts_.empty()) add("");
  for (const Contour& contour : slice.contours) add(contour.label);
}

// --- What others see ---

void Capture::publish(const Edit& edit, const NetChange& change, double latency_ms) {
  const Json z = Json::array({edit.slice.z});
  const bool is_removal = edit.kind == Edit::Kind::remove;
  const Json event{{"removed", change.removed()},
                   {"added", change.added(edits_)},
                   {"slices_removed", is_removal ? z : Json::array()},
                   {"slices_added", is_removal ? Json::array() : z},
                   {"counts", counts()},
                   {"volume", volume()},
                   {"latency_ms", latency_ms},
                   {"edits", edits_}};
  feed_.publish(event.dump());
}

std::pair<std::string, std::uint64_t> Capture::reset_event() const {
  const std::lock_guard lock(state_mutex_);
  Json slabs = Json::array();
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (const SlabInfo& slab : parts_[i].surface->slabs())
      slabs.push_back(NetChange::to_json(i, parts_[i].label, slab, born({i, slab.id})));
  Json slices = Json::array();
  for (const auto& [z, slice] : stack_.slices()) slices.push_back(z);
  const Json event{{"slabs", std::move(slabs)},
                   {"slices", std::move(slices)},
                   {"counts", counts()},
                   {"volume", volume()},
                   {"unit", setup_.unit},
                   {"metres_per_unit", setup_.metres_per_unit},
                   {"edits", edits_}};
  return {event.dump(), feed_.last() + 1};
}

Json Capture::counts() const {
  std::size_t slabs = 0;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const Part& part : parts_) {
    slabs += part.surface->slab_count();
    vertices += part.surface->vertex_count();
    faces += part.surface->face_count();
  }
  return {{"slices", stack_.slices().size()},
          {"slabs", slabs},
          {"vertices", vertices},
          {"faces", faces}};
}

double Capture::volume() const {
  double volume = 0;
  for (const Part& part : parts_) volume += part.surface->volume();
  return volume;
}

std::shared_ptr<const CaptureView> Capture::view() {
  const std::lock_guard lock(state_mutex_);
  return view_now();
}

std::shared_ptr<const CaptureView> Capture::view_now() {
  if (view_) return view_;
  auto view = std::make_shared<CaptureView>();
  for (const Part& part : parts_) view->parts.push_back({part.label, part.surface->snapshot()});
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
  const auto found = stack_.slices().find(z);
  if (found == stack_.slices().end()) return {};
  return found->second;
}

std::vector<double> Capture::heights() const {
  const std::lock_guard lock(state_mutex_);
  std::vector<double> heights;
  for (const auto& [z, slice] : stack_.slices()) heights.push_back(z);
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
  status.update(counts());
  status["volume"] = volume();
  status["latency_ms"] = {
      {"median", at(50)}, {"p99", at(99)}, {"last", latencies_.empty() ? 0 : latencies_.back()}};
  status["queue"] = waiting;
  status["memory_bytes"] = memory_in_use();
  status["session"] = session_.has_value();
  status["version"] = io::version();
  return status;
}

}  // namespace loft::app
