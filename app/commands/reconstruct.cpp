// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruct.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/label_files.h"
#include "app/commands/label_work.h"
#include "app/commands/labels.h"
#include "app/commands/out_of_core.h"
#include "app/commands/parts.h"
#include "app/commands/place_of.h"
#include "app/commands/reconstruct_report.h"
#include "app/commands/surface_outputs.h"
#include "app/commands/take_over.h"
#include "app/commands/volume_table.h"
#include "app/interrupt.h"
#include "app/memory.h"
#include "app/place.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "io/precomputed.h"
#include "io/stack.h"
#include "io/stacks/links_json.h"
#include "io/unit.h"
#include "mesh/measure.h"
#include "reconstruct/fair.h"
#include "reconstruct/fair/stairs.h"
#include "reconstruct/usable.h"

namespace loft::app {

namespace {

using std::filesystem::path;

/// Follows a reconstruction: draws the bar, times the stages, stops it after an interrupt.
class Follower {
 public:
  Follower(Terminal& terminal, std::string label, double begin, double share)
      : terminal_(terminal), label_(std::move(label)), begin_(begin), share_(share) {}

  bool operator()(Stage stage, double fraction) {
    seconds_[name(stage_)] += stopwatch_.lap();
    stage_ = stage;
    std::string activity = name(stage);
    if (!label_.empty()) activity += ' ' + label_;
    terminal_.show_progress(activity, begin_ + share_ * overall(stage, fraction));
    return !is_interrupted();
  }

  std::map<std::string, double> finish() {
    seconds_[name(stage_)] += stopwatch_.lap();
    return std::move(seconds_);
  }

 private:
  Terminal& terminal_;
  std::string label_;
  double begin_;
  double share_;
  Stage stage_ = Stage::clean;
  Stopwatch stopwatch_;
  std::map<std::string, double> seconds_;
};

struct Result {
  /// Made in its place, and stays there: an OpenMesh mesh cannot be moved, only copied.
  Result(const Stack& stack, const ContoursByLabel& contours, const Options& options,
         Follower& follower)
      : made(options.label ? reconstruct(stack, contours, options, std::ref(follower))
                           : reconstruct(stack, options, std::ref(follower))) {
    report.label = options.label.value_or("");
    report.input = size_of(stack.slices, contours.of(report.label));
    report.seconds = follower.finish();
    report.vertices_of_kind = count_kinds(made.surface);
    report.repairs = std::move(made.repairs);
    report.slab_volume = made.slab_volume;
    report.slabs = std::move(made.slabs);
  }

  Reconstructed made;
  PartReport report;
};

/// All that is known of a label, and its surface.
io::Part part_of(const ReconstructCommand& command, const Stack& stack, const LabelWork& work,
                 const Result& result) {
  io::Part part = part_of(command, stack, result.report.label);
  part.surface = &result.made.surface;
  part.slices = result.report.input.slices;
  part.is_hidden = work.is_hidden(part.label);
  return part;
}

/// Makes the labels of a stack one after the other.
class LabelLoop {
 public:
  LabelLoop(const ReconstructCommand& command, const Stack& stack, const Options& options,
            Terminal& terminal, Report& report)
      : command_(command),
        stack_(stack),
        options_(options),
        terminal_(terminal),
        report_(report),
        contours_(stack.slices),
        work_(command, sizes(), stack.labels) {
    report.existing = work_.existing();
    report.peak_memory = memory_.in_all();
  }

  /// Makes and writes the surfaces; one InputError for all labels that cannot be reconstructed.
  void run() {
    try {
      make_all();
      write_all();
    } catch (const Cancelled&) {
      throw_interrupted();
    }
  }

 private:
  void make_all() {
    const std::size_t count = work_.labels().size();
    LabelProblems problems(command_);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string& label = work_.labels()[i];
      try {
        make(label, static_cast<double>(i) / static_cast<double>(count),
             1.0 / static_cast<double>(count));
      } catch (const InputError& error) {
        problems.add(label, error);
      }
    }
    terminal_.clear_progress();
    problems.raise(work_.chosen());
    report_.skipped = problems.skipped();
  }

  std::vector<LabelSize> sizes() const {
    std::vector<LabelSize> sizes;
    for (const std::string& label : contours_.labels())
      sizes.push_back({label, size_of(stack_.slices, contours_.of(label)).vertices});
    if (sizes.empty()) sizes.emplace_back();
    return sizes;
  }

  void make(const std::string& label, double begin, double share) {
    Options options = options_;
    if (work_.is_labelled()) options.label = label;
    Stopwatch stopwatch;
    memory_.lap();
    Follower follower(terminal_, label, begin, share);
    Result& result = results_.emplace_back(stack_, contours_, options, follower);
    const bool is_measured = command_.json || !command_.quiet || command_.volumes;
    if (is_measured) result.report.measures = measure(result.made.surface);  // else nobody sees it
    write(result);
    result.report.seconds["total"] = stopwatch.lap();
    result.report.peak_memory = memory_.lap();
    report_.peak_memory = std::max(report_.peak_memory, memory_.in_all());
    if (!are_per_label(command_)) return;
    report_.parts.push_back(std::move(result.report));
    results_.pop_back();
  }

  /// What is of this label alone, at once: it stays whatever happens to the others.
  void write(Result& result) {
    Stopwatch stopwatch;
    const io::Part part = part_of(command_, stack_, work_, result);
    if (work_.outputs().write_label(part, terminal_)) ++made_;
    result.report.seconds["write"] = stopwatch.lap();
  }

  void write_all() {
    if (results_.empty()) return;
    Stopwatch stopwatch;
    std::vector<io::Part> parts;
    for (const Result& result : results_) parts.push_back(part_of(command_, stack_, work_, result));
    work_.outputs().write_all(parts, terminal_);
    report_.seconds["write"] += stopwatch.lap();
    for (Result& result : results_) report_.parts.push_back(std::move(result.report));
  }

  [[noreturn]] void throw_interrupted() const {
    if (made_ == 0) throw Cancelled();
    throw Interrupted("interrupted; " + grouped(made_) + " of " +
                      counted(work_.labels().size(), "label") + (made_ == 1 ? " is" : " are") +
                      " done, their files whole; --skip-existing goes on from there");
  }

  const ReconstructCommand& command_;
  const Stack& stack_;
  const Options& options_;
  Terminal& terminal_;
  Report& report_;
  ContoursByLabel contours_;
  LabelWork work_;
  PeakMemory memory_;
  std::list<Result> results_;
  std::size_t made_ = 0;
};

/// Warns of every repair, but not of too many of a kind.
void warn(const ReconstructCommand& command, const PartReport& part, Terminal& terminal) {
  constexpr std::size_t shown = 20;
  std::map<DefectKind, std::size_t> counts;
  Options options;
  if (!part.label.empty()) options.label = part.label;
  const std::string place = place_of(command, options);
  for (const Defect& repair : part.repairs) {
    if (++counts[repair.kind] <= shown) terminal.warn(place + loft::describe(repair));
  }
  for (const auto& [kind, count] : counts) {
    if (count <= shown) continue;
    terminal.warn(place + "and " + grouped(count - shown) + " more of kind " + loft::name(kind) +
                  "; --json lists all");
  }
}

const char* how(const path& output) {
  if (io::precomputed_folder(output)) return ", a mesh a label";
  return is_per_label(output) ? ", a file a label" : "";
}

void say_summary(const ReconstructCommand& command, const Report& report,
                 const std::vector<path>& left, Terminal& terminal) {
  if (!report.range.empty())
    terminal.say("the slabs " + report.range + ", open to those beside them; see loft join");
  if (report.parts.size() > 1 && report.range.empty())
    for (const std::string& line : volume_table(report.parts, command.unit)) terminal.say(line);
  for (const PartReport& part : report.parts) {
    const std::string prefix = part.label.empty() ? "" : part.label + ": ";
    if (report.parts.size() == 1 && report.range.empty())
      terminal.say(prefix + describe(part.measures, command.unit));
    if (!part.repairs.empty())
      terminal.say(prefix + describe(summarize(part.repairs), command.unit));
  }
  if (!report.existing.empty())
    terminal.say(counted(report.existing.size(), "label") + " left as they are: their files exist");
  if (report.parts.empty()) {
    terminal.say("nothing to do");
    return;
  }
  for (const path& output : command.outputs)
    terminal.say(std::ranges::count(left, output) > 0
                     ? output.string() + " is left as it is: it exists"
                     : "wrote " + output.string() + how(output));
}

/// Contours of a stack that are bent without being made fair.
void warn_of_stairs(const ReconstructCommand& command, const Stack& stack, Terminal& terminal) {
  if (!bends_as_they_are(command.options)) return;
  Stairs stairs;
  for (const Slice& slice : stack.slices) stairs.add(slice);
  if (stairs.are_there()) terminal.warn(stairs_are_bent);
}

/// Once, not for each label.
void make_fair(Stack& stack, Options& options) {
  require_usable(options);
  stack = fair(stack, *options.fair, options.height_tolerance, options.threads);
  options.fair = {};
}

void run_in_memory(ReconstructCommand& command, Terminal& terminal, Report& report) {
  Stopwatch stopwatch;
  Stack stack = io::read_stack(command.inputs, command.read);
  take_over(stack, command, terminal);
  report.input = size_of(stack.slices);
  report.input.slices = stack.slices.size();
  report.seconds["read"] = stopwatch.lap();

  Options options = command.options;
  warn_of_stairs(command, stack, terminal);
  if (options.fair) {
    make_fair(stack, options);
    report.seconds["fair"] = stopwatch.lap();
  }
  if (command.links) options.links = io::read_links_json(*command.links, stack.slices);
  options.reports_slabs = command.json && command.slabs;
  LabelLoop(command, stack, options, terminal, report).run();
  for (const PartReport& part : report.parts)
    for (const auto& [stage, seconds] : part.seconds)
      if (stage != "total") report.seconds[stage] += seconds;
}

/// The path with the scheme that --format asks for.
void name_formats(ReconstructCommand& command) {
  if (!command.is_neuroglancer) return;
  for (path& output : command.outputs)
    if (!io::precomputed_folder(output)) output = "precomputed://" + output.string();
}

void work(ReconstructCommand& command, Terminal& terminal, Report& report) {
  if (is_all_there(command)) {
    report.existing = command.only;
  } else if (report.is_out_of_core) {
    run_out_of_core(command, terminal, report);
  } else {
    run_in_memory(command, terminal, report);
  }
}

}  // namespace

ExitCode run(const ReconstructCommand& given) {
  ReconstructCommand command = given;
  command.read.threads = command.options.threads;
  name_formats(command);
  Terminal terminal(command.quiet);
  Report report;
  Stopwatch total;
  const PeakMemory memory;
  catch_interrupts();
  check_outputs(command);
  report.is_out_of_core = is_out_of_core(command);
  const std::vector<path> left = outputs_left(command);
  work(command, terminal, report);
  report.peak_memory = std::max(report.peak_memory, memory.in_all());
  report.seconds["total"] = total.lap();

  for (const SkippedLabel& label : report.skipped)
    terminal.warn(label.message + "; nothing was made of it");
  for (const PartReport& part : report.parts) warn(command, part, terminal);
  if (command.volumes) write_volumes_csv(*command.volumes, report.parts, command.unit);
  say_summary(command, report, left, terminal);
  if (command.json) std::cout << to_json(report, command) << '\n';
  return command.strict && !report.skipped.empty() ? ExitCode::bad_input : ExitCode::ok;
}

}  // namespace loft::app
