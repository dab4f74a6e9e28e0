// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruct.h"

#include <array>
#include <functional>
#include <iostream>
#include <map>
#include <utility>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/overwriting.h"
#include "app/report.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "io/links_json.h"
#include "io/slices.h"
#include "io/surfaces.h"
#include "reconstruct/measure.h"

namespace loft::app {

namespace {

using std::filesystem::path;

/// How much of the work is done: the stages' shares are about what they take.
double overall(Stage stage, double fraction) {
  switch (stage) {
    case Stage::clean:
      return 0.1 * fraction;
    case Stage::tile:
      return 0.1 + 0.7 * fraction;
    case Stage::sew:
      break;
  }
  return 0.8 + 0.2 * fraction;
}

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

/// Finds out early what would make the work useless.
void check_outputs(const ReconstructCommand& command) {
  forbid_overwriting(command.inputs, command.outputs);
  if (command.links) forbid_overwriting(std::array{*command.links}, command.outputs);
  for (const path& output : command.outputs) io::check_writable(output);
}

struct Result {
  Surface surface;
  PartReport report;
};

Result reconstruct_label(const std::vector<Slice>& stack, const Options& options,
                         Follower& follower, bool is_measured) {
  Reconstruction made = reconstruct(stack, options, std::ref(follower));
  Result result;
  result.report.label = options.label.value_or("");
  result.report.input = size_of(stack, options.label);
  result.report.seconds = follower.finish();
  result.report.vertices_of_kind = count_kinds(made.surface);
  if (is_measured) result.report.measures = measure(to_mesh(made.surface));
  result.report.repairs = std::move(made.repairs);
  result.report.slabs = std::move(made.slabs);
  result.surface = std::move(made.surface);
  return result;
}

/// `stack.ndjson: label 'heart': ` in front of each line, as far as there is a choice.
std::string with_place(const std::string& lines, const std::string& place) {
  std::string result = place;
  for (const char c : lines) {
    result += c;
    if (c == '\n') result += place;
  }
  return result;
}

std::string place_of(const ReconstructCommand& command, const Options& options) {
  std::string place;
  if (command.inputs.size() == 1) place += command.inputs[0].string() + ": ";
  if (options.label) place += "label '" + *options.label + "': ";
  return place;
}

/// All labels, or one InputError for all that cannot be reconstructed.
std::vector<Result> reconstruct_all(const ReconstructCommand& command,
                                    const std::vector<Slice>& stack, const Options& all_options,
                                    Terminal& terminal) {
  std::vector<std::string> names = labels(stack);
  if (names.empty()) names.emplace_back();
  const bool is_labelled = names.size() > 1 || !names[0].empty();
  const bool is_measured = command.json || !command.quiet;  // else nobody sees it
  const double share = 1.0 / static_cast<double>(names.size());
  std::vector<Result> results;
  std::string problems;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Options options = all_options;
    if (is_labelled) options.label = names[i];
    Follower follower(terminal, names[i], share * static_cast<double>(i), share);
    try {
      results.push_back(reconstruct_label(stack, options, follower, is_measured));
    } catch (const InputError& error) {
      if (!problems.empty()) problems += '\n';
      problems += with_place(error.what(), place_of(command, options));
    }
  }
  terminal.clear_progress();
  if (!problems.empty()) throw InputError(problems);
  return results;
}

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

io::WriteOptions write_options(const ReconstructCommand& command) {
  io::WriteOptions options;
  options.metres_per_unit = command.metres_per_unit;
  // File names only: the same stack gives the same bytes wherever it lies.
  for (const path& input : command.inputs) options.sources.push_back(input.filename().string());
  options.settings = {{"fill", name(command.options.fill)},
                      {"cap", name(command.options.cap)},
                      {"link", name(command.options.link)}};
  return options;
}

void write_all(const ReconstructCommand& command, const std::vector<Result>& results) {
  std::vector<io::Part> parts;
  for (const Result& result : results) parts.push_back({result.report.label, &result.surface});
  for (const path& output : command.outputs) {
    if (is_interrupted()) throw Cancelled();
    io::write(output, parts, write_options(command));
  }
}

void say_summary(const ReconstructCommand& command, const std::vector<Result>& results,
                 Terminal& terminal) {
  for (const Result& result : results) {
    const std::string& label = result.report.label;
    terminal.say((label.empty() ? "" : label + ": ") + describe(result.report.measures));
  }
  for (const path& output : command.outputs) terminal.say("wrote " + output.string());
}

}  // namespace

ExitCode run(const ReconstructCommand& command) {
  Terminal terminal(command.quiet);
  Report report;
  Stopwatch total;
  Stopwatch stopwatch;
  check_outputs(command);
  catch_interrupts();

  const std::vector<Slice> stack = io::read_slices(command.inputs);
  report.input = size_of(stack);
  report.input.slices = stack.size();
  report.seconds["read"] = stopwatch.lap();

  Options options = command.options;
  if (command.links) options.links = io::read_links_json(*command.links, stack);
  options.reports_slabs = command.json;
  std::vector<Result> results = reconstruct_all(command, stack, options, terminal);
  for (const Result& result : results) warn(command, result.report, terminal);
  for (const Result& result : results) {
    for (const auto& [stage, seconds] : result.report.seconds) report.seconds[stage] += seconds;
  }

  stopwatch.lap();
  write_all(command, results);
  report.seconds["write"] = stopwatch.lap();
  report.seconds["total"] = total.lap();

  say_summary(command, results, terminal);
  if (!command.json) return ExitCode::ok;
  for (Result& result : results) report.parts.push_back(std::move(result.report));
  std::cout << to_json(report, command) << '\n';
  return ExitCode::ok;
}

}  // namespace loft::app
