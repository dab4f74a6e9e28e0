// SPDX-License-Identifier: MIT
#include "app/commands/out_of_core.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "app/commands/label_files.h"
#include "app/commands/label_work.h"
#include "app/commands/labels.h"
#include "app/commands/place_of.h"
#include "app/commands/take_over.h"
#include "app/interrupt.h"
#include "app/memory.h"
#include "app/place.h"
#include "app/stopwatch.h"
#include "io/bytes/file.h"
#include "io/meshes/ply_pieces.h"
#include "io/stack_file.h"
#include "reconstruct/fair/stairs.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/world.h"

namespace loft::app {

namespace {

using std::filesystem::path;

// Shares of the time.
constexpr double share_of_reading = 0.1;
constexpr double share_of_surfaces = 0.85;

bool is_one_ply(const ReconstructCommand& command) {
  return command.outputs.size() == 1 && io::extension(command.outputs[0]) == ".ply" &&
         !is_per_label(command.outputs[0]);
}

std::uintmax_t input_size(const ReconstructCommand& command) {
  std::uintmax_t size = 0;
  for (const path& input : command.inputs) {
    std::error_code error;
    const std::uintmax_t one = std::filesystem::file_size(input, error);
    if (!error) size += one;
  }
  return size;
}

/// What the first look at all slices tells.
class Overview {
 public:
  explicit Overview(const Options& options) : looks_for_stairs_(bends_as_they_are(options)) {}

  void add(const Slice& slice) {
    std::ranges::move(find_unusable(slice, static_cast<std::uint32_t>(total_.slices)),
                      std::back_inserter(unusable_));
    ++total_.slices;
    total_.contours += slice.contours.size();
    for (const Contour& contour : slice.contours) total_.vertices += contour.points.size();
    if (looks_for_stairs_) stairs_.add(slice);
    add_sizes(labels_, slice);
  }

  [[nodiscard]] bool bends_stairs() const { return stairs_.are_there(); }
  [[nodiscard]] const StackSize& total() const { return total_; }
  [[nodiscard]] const std::vector<Defect>& unusable() const { return unusable_; }
  [[nodiscard]] std::vector<LabelSize> labels() const {
    std::vector<LabelSize> sizes;
    for (const auto& [label, size] : labels_) sizes.push_back({label, size.vertices});
    if (sizes.empty()) sizes.emplace_back();
    return sizes;
  }
  [[nodiscard]] StackSize size_of(const std::string& label) const {
    const auto found = labels_.find(label);
    return found == labels_.end() ? StackSize() : found->second;
  }

 private:
  StackSize total_;
  std::map<std::string, StackSize> labels_;
  bool looks_for_stairs_;
  Stairs stairs_;
  std::vector<Defect> unusable_;
};

/// Passes a surface on to where it is in the world.
class WorldSink : public SurfaceSink {
 public:
  WorldSink(const Stack& stack, SurfaceSink& sink) : stack_(stack), sink_(sink) {}

  void add_vertices(std::span<const SurfaceVertex> vertices) override {
    moved_.assign(vertices.begin(), vertices.end());
    for (SurfaceVertex& vertex : moved_)
      vertex.place = world_place(stack_, vertex.place, vertex.origin);
    sink_.add_vertices(moved_);
  }
  void add_faces(std::span<const SurfaceFace> faces) override { sink_.add_faces(faces); }
  void end(const VertexNumbers& numbers) override { sink_.end(numbers); }

 private:
  const Stack& stack_;
  SurfaceSink& sink_;
  std::vector<SurfaceVertex> moved_;
};

}  // namespace

bool is_out_of_core(const ReconstructCommand& command) {
  if (command.memory == Memory::out_of_core && !is_one_ply(command))
    throw UsageError("--out-of-core writes one PLY file; give one output OUT.ply");
  if (command.memory == Memory::out_of_core && command.options.simplify)
    throw UsageError("--simplify needs the whole surface in memory; leave out --out-of-core");
  if (command.memory == Memory::out_of_core && command.links)
    throw UsageError("--links needs the whole stack in memory; leave out --out-of-core");
  if (command.memory != Memory::by_size) return command.memory == Memory::out_of_core;
  const bool reads_files = std::ranges::find(command.inputs, path("-")) == command.inputs.end();
  return is_one_ply(command) && reads_files && !command.options.simplify && !command.links &&
         input_size(command) > most_in_memory;
}

void run_out_of_core(ReconstructCommand& command, Terminal& terminal, Report& report) {
  Stopwatch stopwatch;
  Overview overview(command.options);
  const io::StackFile stack(command.inputs, command.read, [&](const Slice& slice, double share) {
    overview.add(slice);
    terminal.show_progress("read", share_of_reading * share);
    if (is_interrupted()) throw Cancelled();
  });
  if (!overview.unusable().empty())
    throw InputError(
        with_place(InputError(overview.unusable()).what(), place_of(command, Options())));
  take_over(stack.about(), command, terminal);
  if (overview.bends_stairs()) terminal.warn(stairs_are_bent);
  report.input = overview.total();
  report.seconds["read"] = stopwatch.lap();

  const LabelWork work(command, overview.labels(), stack.about().labels);
  const std::vector<std::string>& names = work.labels();
  report.existing = work.existing();
  PeakMemory memory;
  report.peak_memory = memory.in_all();
  terminal.clear_progress();
  if (names.empty()) return;
  std::vector<std::optional<Colour>> colours;
  for (const std::string& name : names) {
    const StackLabel* const said = stack.about().find_label(name);
    colours.push_back(said != nullptr ? said->colour : std::nullopt);
  }
  io::PlyPieces output(command.outputs[0], names, colours);
  Stack about = stack.about();
  if (command.options.fair) about.slices.clear();  // points have moved from places in the file
  WorldSink in_world(about, output);
  LabelProblems problems(command);
  for (std::size_t i = 0; i < names.size(); ++i) {
    Options options = command.options;
    options.reports_slabs = command.json && command.slabs;
    if (work.is_labelled()) options.label = names[i];
    const StackLabel* const label = stack.about().find_label(names[i]);
    options.gap = label != nullptr && label->gap ? label->gap : stack.about().gap;
    const auto follow = [&](Stage stage, double fraction) {
      const double done = (static_cast<double>(i) + fraction) / static_cast<double>(names.size());
      terminal.show_progress(name(stage) + (' ' + names[i]),
                             share_of_reading + share_of_surfaces * done);
      return !is_interrupted();
    };
    try {
      OutOfCoreReport made = reconstruct_out_of_core(stack.source(), options, in_world, follow);
      PartReport& part = report.parts.emplace_back();
      part.label = names[i];
      part.input = overview.size_of(names[i]);
      part.measures = made.measures;
      part.slab_volume = made.slab_volume;
      part.vertices_of_kind = made.vertices_of_kind;
      part.repairs = std::move(made.repairs);
      part.slabs = std::move(made.slabs);
      part.seconds["tile"] = stopwatch.lap();
      part.seconds["total"] = part.seconds["tile"];
      part.peak_memory = memory.lap();
      report.seconds["tile"] += part.seconds["tile"];
    } catch (const InputError& error) {
      problems.add(names[i], error);
      output.skip();
    }
  }
  report.peak_memory = memory.in_all();
  problems.raise(work.chosen());
  report.skipped = problems.skipped();
  terminal.show_progress("write", share_of_reading + share_of_surfaces);
  output.commit();
  terminal.clear_progress();
  report.seconds["write"] = stopwatch.lap();
}

}  // namespace loft::app
