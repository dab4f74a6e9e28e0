// SPDX-License-Identifier: MIT
#include "app/commands/out_of_core.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <limits>
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
#include "io/bytes/checksum.h"
#include "io/bytes/file.h"
#include "io/bytes/hexadecimal.h"
#include "io/meshes/ply_part.h"
#include "io/meshes/ply_pieces.h"
#include "io/stack_file.h"
#include "reconstruct/fair/stairs.h"
#include "reconstruct/number_text.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/usable.h"
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

/// Whether a range can be made of it, as it must.
bool is_range(const ReconstructCommand& command) {
  if (!is_one_ply(command))
    throw UsageError("--slabs writes one PLY file; give one output OUT.ply");
  if (command.memory == Memory::in_memory)
    throw UsageError("--slabs works out of core; leave out --in-memory");
  if (command.options.simplify)
    throw UsageError("--simplify needs the whole surface in memory; leave out --slabs");
  if (command.links) throw UsageError("--links needs the whole stack in memory; leave out --slabs");
  if (command.volumes)
    throw UsageError("volumes are those of the whole stack; leave out --csv or --slabs");
  return true;
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
  explicit Overview(const ReconstructCommand& command)
      : looks_for_stairs_(bends_as_they_are(command.options)),
        looks_for_range_(command.range.has_value()) {}

  void add(const Slice& slice) {
    std::ranges::move(find_unusable(slice, static_cast<std::uint32_t>(total_.slices)),
                      std::back_inserter(unusable_));
    ++total_.slices;
    total_.contours += slice.contours.size();
    for (const Contour& contour : slice.contours) total_.vertices += contour.points.size();
    if (looks_for_stairs_) stairs_.add(slice);
    add_sizes(labels_, slice);
    if (!looks_for_range_) return;
    for (const Contour& contour : slice.contours) spans_[contour.label].add(slice.z);
    add_to_checksum(slice);
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

  /// Of a range: where the contours of a label are, and what tells the stack from others.
  [[nodiscard]] HeightSpan span_of(const std::string& label) const {
    const auto found = spans_.find(label);
    return found == spans_.end() ? HeightSpan() : found->second.span;
  }
  [[nodiscard]] std::uint64_t checksum() const { return checksum_; }

 private:
  struct Span {
    HeightSpan span{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};

    void add(double z) {
      span.lowest = std::min(span.lowest, z);
      span.highest = std::max(span.highest, z);
    }
  };

  void add_to_checksum(const Slice& slice) {
    add_numbers(std::span(&slice.z, 1));
    for (const Contour& contour : slice.contours) {
      checksum_ = io::checksum(contour.label, checksum_);
      add_numbers(std::array{static_cast<double>(contour.points.size())});
      for (const cdt::Point& point : contour.points) add_numbers(std::array{point.x, point.y});
      for (const auto& place : contour.places) add_numbers(place);
    }
  }

  /// Number by number, not byte by byte: all of a large stack passes by here.
  void add_numbers(std::span<const double> numbers) {
    for (const double number : numbers) {
      checksum_ ^= std::bit_cast<std::uint64_t>(number);
      checksum_ *= 0x9e3779b97f4a7c15U;
      checksum_ ^= checksum_ >> 32U;
    }
  }

  StackSize total_;
  std::map<std::string, StackSize> labels_;
  bool looks_for_stairs_;
  bool looks_for_range_;
  std::map<std::string, Span> spans_;
  std::uint64_t checksum_ = io::no_checksum;
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

/// What decides how a part comes out, by the names of options.
std::map<std::string, std::string> part_settings(const Options& options) {
  std::map<std::string, std::string> settings = settings_of(options);
  settings["smooth"] = options.smooth ? "yes" : "no";
  settings["tolerance"] = exact(options.tolerance);
  settings["height-tolerance"] = exact(options.height_tolerance);
  if (options.keyhole_width) settings["keyhole-width"] = exact(*options.keyhole_width);
  if (options.max_shift) settings["max-shift"] = exact(*options.max_shift);
  return settings;
}

/// What else than slices tells a stack from others. `before`: the checksum of these.
std::uint64_t checksum_of(const Stack& about, const std::vector<std::optional<Colour>>& colours,
                          std::uint64_t before) {
  std::string text = about.gap ? exact(*about.gap) : "";
  for (const auto& colour : colours) text += colour ? io::hexadecimal(*colour) : " ";
  for (const StackLabel& label : about.labels) text += label.gap ? exact(*label.gap) + ' ' : " ";
  if (about.frame)
    for (const auto& row : about.frame->rows)
      for (const double number : row) text += exact(number) + ' ';
  return io::checksum(text, before);
}

/// Makes a part of a stack's surface: some slabs, label by label.
class RangeWork {
 public:
  /// Throws UsageError where the stack has no such slabs.
  RangeWork(const ReconstructCommand& command, const io::StackFile& stack)
      : about_(stack.about()),
        source_(stack.source()),
        slab_count_(count_slabs(source_, command.options)) {
    range_ = {command.range->first, command.range->bound.value_or(slab_count_)};
    if (range_.bound > slab_count_ || range_.first >= range_.bound)
      throw UsageError("--slabs " + text() + ": the stack has the slabs 0.." +
                       std::to_string(slab_count_));
  }

  [[nodiscard]] std::string text() const {
    return std::to_string(range_.first) + ".." + std::to_string(range_.bound);
  }

  OutOfCoreReport make(const Options& options, HeightSpan span, SurfaceSink& sink,
                       const Progress& progress) {
    SlabsReport made = reconstruct_slabs(source_, options, range_, span, sink, progress);
    surfaces_.push_back(made.sizes);
    std::ranges::copy(made.lower_places, std::back_inserter(seam_places_));
    std::ranges::copy(made.upper_places, std::back_inserter(seam_places_));
    return std::move(made.report);
  }

  /// `stack` tells it from others.
  void commit(const ReconstructCommand& command, std::uint64_t stack,
              const std::vector<std::optional<Colour>>& colours, io::PlyPieces& output) const {
    io::PlyPartNote note{range_, slab_count_, part_settings(command.options), surfaces_};
    note.origin["stack"] = io::hexadecimal(checksum_of(about_, colours, stack));
    output.commit(note, seam_places_);
  }

 private:
  const Stack& about_;
  SliceSource source_;
  std::size_t slab_count_;
  SlabRange range_;
  std::vector<PartSizes> surfaces_;
  std::vector<std::uint32_t> seam_places_;
};

}  // namespace

bool is_out_of_core(const ReconstructCommand& command) {
  if (command.memory == Memory::out_of_core && !is_one_ply(command))
    throw UsageError("--out-of-core writes one PLY file; give one output OUT.ply");
  if (command.memory == Memory::out_of_core && command.options.simplify)
    throw UsageError("--simplify needs the whole surface in memory; leave out --out-of-core");
  if (command.memory == Memory::out_of_core && command.links)
    throw UsageError("--links needs the whole stack in memory; leave out --out-of-core");
  if (command.range) return is_range(command);
  if (command.memory != Memory::by_size) return command.memory == Memory::out_of_core;
  const bool reads_files = std::ranges::find(command.inputs, path("-")) == command.inputs.end();
  return is_one_ply(command) && reads_files && !command.options.simplify && !command.links &&
         input_size(command) > most_in_memory;
}

void run_out_of_core(ReconstructCommand& command, Terminal& terminal, Report& report) {
  Stopwatch stopwatch;
  Overview overview(command);
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
  std::optional<RangeWork> range;
  if (command.range) range.emplace(command, stack);
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
      OutOfCoreReport made =
          range ? range->make(options, overview.span_of(names[i]), in_world, follow)
                : reconstruct_out_of_core(stack.source(), options, in_world, follow);
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
  if (range) {
    range->commit(command, overview.checksum(), colours, output);
    report.range = range->text();
  } else {
    output.commit();
  }
  terminal.clear_progress();
  report.seconds["write"] = stopwatch.lap();
}

}  // namespace loft::app
