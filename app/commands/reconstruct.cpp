// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruct.h"

#include <array>
#include <functional>
#include <iostream>
#include <list>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "app/commands/commands.h"
#include "app/commands/label_choice.h"
#include "app/commands/label_files.h"
#include "app/commands/labels.h"
#include "app/commands/out_of_core.h"
#include "app/commands/parts.h"
#include "app/commands/place_of.h"
#include "app/commands/reconstruct_report.h"
#include "app/commands/take_over.h"
#include "app/commands/volume_table.h"
#include "app/commands/written.h"
#include "app/interrupt.h"
#include "app/overwriting.h"
#include "app/place.h"
#include "app/stopwatch.h"
#include "app/terminal.h"
#include "io/bytes/text.h"
#include "io/gltf/gltf.h"
#include "io/stack.h"
#include "io/stacks/links_json.h"
#include "io/surfaces.h"
#include "io/unit.h"
#include "mesh/measure.h"
#include "reconstruct/fair.h"
#include "reconstruct/fair/stairs.h"
#include "reconstruct/number_text.h"
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

/// Finds out early what would make the work useless.
void check_outputs(const ReconstructCommand& command) {
  check_gltf_options(command);
  forbid_overwriting(command.inputs, command.outputs);
  if (command.links) forbid_overwriting(std::array{*command.links}, command.outputs);
  for (const path& output : command.outputs)
    if (!is_per_label(output)) io::check_writable(output);
}

/// The same, once the labels are known.
void check_outputs(const ReconstructCommand& command, const std::vector<std::string>& labels) {
  static_cast<void>(hidden_labels(command, labels));
  for (const path& output : command.outputs) {
    if (!is_per_label(output)) {
      check_labels_fit(labels.size(), output);
      continue;
    }
    const std::vector<path> files = label_files(output, labels);
    forbid_overwriting(command.inputs, files);
    for (const path& file : files) io::check_writable(file);
  }
}

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

/// All labels but those that are skipped, or one InputError for all that cannot be reconstructed.
std::list<Result> reconstruct_all(const ReconstructCommand& command, const Stack& stack,
                                  const Options& all_options, Terminal& terminal,
                                  std::vector<SkippedLabel>& skipped) {
  const ContoursByLabel contours(stack.slices);
  std::vector<std::string> names =
      LabelChoice(command.only, command.except).chosen(contours.labels());
  if (names.empty()) names.emplace_back();
  check_outputs(command, names);
  const bool is_labelled = names.size() > 1 || !names[0].empty();
  const bool is_measured =
      command.json || !command.quiet || command.volumes;  // else nobody sees it
  const double share = 1.0 / static_cast<double>(names.size());
  std::list<Result> results;
  LabelProblems problems(command);
  for (std::size_t i = 0; i < names.size(); ++i) {
    Options options = all_options;
    if (is_labelled) options.label = names[i];
    Follower follower(terminal, names[i], share * static_cast<double>(i), share);
    try {
      Result& result = results.emplace_back(stack, contours, options, follower);
      if (is_measured) result.report.measures = measure(result.made.surface);
    } catch (const InputError& error) {
      problems.add(names[i], error);
    }
  }
  terminal.clear_progress();
  problems.raise(names.size());
  skipped = problems.skipped();
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
  options.metres_per_unit = *io::metres_per_unit(command.unit);
  // File names only: the same stack gives the same bytes wherever it lies.
  for (const path& input : command.inputs) options.sources.push_back(input.filename().string());
  options.settings = settings_of(command.options);
  options.compression = command.compression;
  return options;
}

std::vector<io::Part> parts_of(const ReconstructCommand& command, const Stack& stack,
                               const std::list<Result>& results) {
  std::vector<std::string> labels;
  for (const Result& result : results) labels.push_back(result.report.label);
  const std::set<std::string> hidden = hidden_labels(command, labels);
  std::vector<io::Part> parts;
  for (const Result& result : results) {
    io::Part& part = parts.emplace_back(part_of(command, stack, result.report.label));
    part.surface = &result.made.surface;
    part.slices = result.report.input.slices;
    part.is_hidden = hidden.contains(part.label);
  }
  return parts;
}

/// How far positions are moved in compressed glTF.
void tell_rounding(const ReconstructCommand& command, const path& output,
                   std::span<const io::Part> parts, const io::Written& written,
                   Terminal& terminal) {
  if (command.compression == io::Compression::none || command.quiet || !is_gltf(output)) return;
  std::string words = output.string() + ": positions are rounded by at most " +
                      io::short_number(io::quantisation_error(parts)) + ' ' + command.unit;
  if (written.rounding.moved > 0)
    words += "; " + counted(written.rounding.moved, "place") +
             " a few steps farther, so that it stays valid";
  terminal.say(words);
}

void write_one(const ReconstructCommand& command, const path& output,
               std::span<const io::Part> parts, Terminal& terminal) {
  if (is_interrupted()) throw Cancelled();
  const io::Written written = io::write(output, parts, write_options(command));
  tell(output, written, terminal);
  tell_rounding(command, output, parts, written, terminal);
}

void write_all(const ReconstructCommand& command, std::span<const io::Part> parts,
               Terminal& terminal) {
  std::vector<std::string> labels;
  for (const io::Part& part : parts) labels.push_back(part.label);
  for (const path& output : command.outputs) {
    if (!is_per_label(output)) {
      write_one(command, output, parts, terminal);
      continue;
    }
    const std::vector<path> files = label_files(output, labels);
    for (std::size_t i = 0; i < files.size(); ++i)
      write_one(command, files[i], parts.subspan(i, 1), terminal);
  }
}

void say_summary(const ReconstructCommand& command, const Report& report, Terminal& terminal) {
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
  for (const path& output : command.outputs)
    terminal.say("wrote " + output.string() + (is_per_label(output) ? ", a file a label" : ""));
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
  std::list<Result> results = reconstruct_all(command, stack, options, terminal, report.skipped);
  stopwatch.lap();
  write_all(command, parts_of(command, stack, results), terminal);
  report.seconds["write"] = stopwatch.lap();
  for (Result& result : results) {
    for (const auto& [stage, seconds] : result.report.seconds) report.seconds[stage] += seconds;
    report.parts.push_back(std::move(result.report));
  }
}

}  // namespace

ExitCode run(const ReconstructCommand& given) {
  ReconstructCommand command = given;
  command.read.threads = command.options.threads;
  Terminal terminal(command.quiet);
  Report report;
  Stopwatch total;
  check_outputs(command);
  report.is_out_of_core = is_out_of_core(command);
  catch_interrupts();
  if (report.is_out_of_core) {
    run_out_of_core(command, terminal, report);
  } else {
    run_in_memory(command, terminal, report);
  }
  report.seconds["total"] = total.lap();

  for (const SkippedLabel& label : report.skipped)
    terminal.warn(label.message + "; nothing was made of it");
  for (const PartReport& part : report.parts) warn(command, part, terminal);
  if (command.volumes) write_volumes_csv(*command.volumes, report.parts, command.unit);
  say_summary(command, report, terminal);
  if (command.json) std::cout << to_json(report, command) << '\n';
  return command.strict && !report.skipped.empty() ? ExitCode::bad_input : ExitCode::ok;
}

}  // namespace loft::app
