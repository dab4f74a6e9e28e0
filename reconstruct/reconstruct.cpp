// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruct.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <iterator>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/lines.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/fair.h"
#include "reconstruct/link/linking.h"
#include "reconstruct/link/tips.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/parallel.h"
#include "reconstruct/sew/sew.h"
#include "reconstruct/shape/forks.h"
#include "reconstruct/shape/refine.h"
#include "reconstruct/shape/simplify.h"
#include "reconstruct/shape/smooth.h"
#include "reconstruct/tile/tiles.h"
#include "reconstruct/usable.h"
#include "reconstruct/world.h"

namespace loft {

namespace {

/// Of the empty regions at either end the one next to a filled one stays: the shape ends before it.
/// Those between are where it is interrupted.
std::vector<Region> trim(std::vector<Region> regions, std::vector<Defect>& repairs) {
  const auto is_filled = [](const Region& region) { return !region.is_empty(); };
  auto first = std::ranges::find_if(regions, is_filled);
  auto last = std::find_if(regions.rbegin(), regions.rend(), is_filled).base();
  if (first >= last) return {};
  for (const Region& region : std::span(first, last))
    if (region.is_empty()) repairs.push_back(empty_slice(region));
  if (first != regions.begin()) --first;
  if (last != regions.end()) ++last;
  return {std::make_move_iterator(first), std::make_move_iterator(last)};
}

/// Rounds off the ends that no empty slice is beyond.
void add_beyond_ends(std::vector<Region>& regions) {
  const Region& bottom = regions[0];
  const Region& top = regions.back();
  std::optional<Region> low;
  std::optional<Region> high;
  if (bottom.has_loops()) low = beyond(bottom, regions[1]);
  if (top.has_loops()) high = beyond(top, regions[regions.size() - 2]);
  if (low) regions.insert(regions.begin(), std::move(*low));
  if (high) regions.push_back(std::move(*high));
}

/// Continues the ends half a gap outwards; empty slices beyond them do not count.
void extend_ends(std::vector<Region>& regions, std::optional<double> gap) {
  if (!regions.empty() && regions.back().is_empty()) regions.pop_back();
  if (!regions.empty() && regions.front().is_empty()) regions.erase(regions.begin());
  if (regions.empty() || (regions.size() == 1 && !gap)) return;
  const std::size_t last = regions.size() - 1;
  const double low = last == 0 ? *gap : regions[1].z - regions[0].z;
  const double high = last == 0 ? *gap : regions[last].z - regions[last - 1].z;
  if (regions[last].has_loops()) regions.push_back(extended(regions[last], high / 2));
  if (regions[0].has_loops()) regions.insert(regions.begin(), extended(regions[0], -low / 2));
}

/// Names the slabs that no valid tiles were found for.
void report_unlinked(std::span<const Region> regions, std::span<const TileSet> slabs,
                     std::vector<Defect>& repairs) {
  for (std::size_t i = 0; i < slabs.size(); ++i)
    if (!slabs[i].is_linked) repairs.push_back(unlinked_slices(regions[i]));
}

/// Names the points and lines that no part ends in.
void report_unused_lines(std::span<const Region> regions, std::span<const Pieces> slabs,
                         std::vector<Defect>& repairs) {
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (const std::uint32_t line : unused_lines(regions[i], i > 0 ? &slabs[i - 1] : nullptr,
                                                 i < slabs.size() ? &slabs[i] : nullptr))
      repairs.push_back(unused_line(regions[i], line));
}

std::string in_lines(std::span<const std::string> problems) {
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  return text;
}

/// Counts the finished steps of a stage, of whatever thread, and passes them on one at a time.
class Reporter {
 public:
  Reporter(const Progress& progress, Stage stage, std::size_t steps)
      : progress_(progress), stage_(stage), steps_(steps) {
    report();
  }
  void add_step() {
    const std::lock_guard lock(mutex_);
    ++done_;
    report();
  }

 private:
  void report() const {
    const double fraction =
        steps_ == 0 ? 1 : static_cast<double>(done_) / static_cast<double>(steps_);
    if (progress_ && !progress_(stage_, fraction)) throw Cancelled();
  }

  const Progress& progress_;
  Stage stage_;
  std::size_t steps_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

/// Cleans what is at one height.
using Clean =
    std::function<Region(const Height&, std::vector<Defect>& repairs, cdt::Triangulation& memory)>;

std::vector<Region> clean_all(std::span<const Height> heights, unsigned threads, const Clean& clean,
                              std::vector<Defect>& repairs, const Progress& progress) {
  Reporter reporter(progress, Stage::clean, heights.size());
  std::vector<Region> regions(heights.size());
  std::vector<std::vector<Defect>> found(heights.size());
  std::vector<cdt::Triangulation> memories(thread_count(threads));
  for_each_index(heights.size(), threads, [&](std::size_t i, unsigned worker) {
    regions[i] = clean(heights[i], found[i], memories[worker]);
    reporter.add_step();
  });
  for (auto& some : found) std::ranges::move(some, std::back_inserter(repairs));
  return regions;
}

/// The slabs of a stack: tiled, linked, and then whatever the options ask for.
struct Slabs {
  std::vector<TileSet> tiles;
  std::vector<Pieces> pieces;
};

Slabs tile_all(const std::vector<Region>& regions, Linking& linking, unsigned threads,
               const Progress& progress) {
  for (const Region& region : regions) linking.add(region);
  const std::size_t count = linking.slab_bound();
  Reporter reporter(progress, Stage::tile, 2 * count);
  std::vector<TileWorkspace> workspaces(thread_count(threads));
  for_each_index(count, threads, [&](std::size_t i, unsigned worker) {
    linking.tile(i, workspaces[worker]);
    reporter.add_step();
  });
  for_each_index(count, threads, [&](std::size_t i, unsigned) { linking.match(i); });
  for_each_index(count, threads, [&](std::size_t i, unsigned) {
    linking.link(i);
    reporter.add_step();
  });
  Slabs slabs;
  for (std::size_t i = 0; i < count; ++i) {
    slabs.tiles.push_back(std::move(linking.tiles(i)));
    slabs.pieces.push_back(std::move(linking.pieces(i)));
  }
  return slabs;
}

/// The orders that could not be met, in the order of `orders`, each once.
void report_refused(std::span<const Slice> slices, std::span<const LinkOrder> orders,
                    std::vector<Refusal> refusals, const Linking& linking,
                    std::vector<Defect>& repairs) {
  for (std::size_t i = 0; i < linking.slab_bound(); ++i)
    refusals.insert(refusals.end(), linking.refusals(i).begin(), linking.refusals(i).end());
  std::ranges::stable_sort(refusals, {}, &Refusal::order);
  for (const Refusal& refusal : refusals) {
    const LinkOrder& order = orders[refusal.order];
    const ContourId& from = order.from;
    repairs.push_back({DefectKind::refused_link,
                       slices[from.slice].z,
                       from.slice,
                       from.contour,
                       {},
                       {},
                       0,
                       describe(order, refusal)});
  }
}

/// The slices around each slab.
Surroundings surroundings(std::span<const SliceShape> shapes, std::size_t slab) {
  Surroundings found{};
  for (std::size_t k = 0; k < found.size(); ++k)
    if (slab + k >= 1 && slab + k - 1 < shapes.size()) found[k] = &shapes[slab + k - 1];
  return found;
}

void smooth_all(const std::vector<Region>& regions, Slabs& slabs, const Options& options,
                const Progress& progress) {
  Reporter reporter(progress, Stage::smooth, regions.size() + slabs.tiles.size());
  std::vector<SliceShape> shapes(regions.size());
  for_each_index(regions.size(), options.threads, [&](std::size_t i, unsigned) {
    shapes[i] = SliceShape(regions[i]);
    reporter.add_step();
  });
  for_each_index(slabs.tiles.size(), options.threads, [&](std::size_t i, unsigned) {
    slabs.tiles[i] = smooth(regions[i], regions[i + 1], surroundings(shapes, i), slabs.pieces[i],
                            std::move(slabs.tiles[i]), options.smooth_tolerance);
    reporter.add_step();
  });
}

/// Straight tiles follow four slices where they fork.
void bend_all_forks(const std::vector<Region>& regions, Slabs& slabs, unsigned threads) {
  std::vector<std::vector<bool>> at_forks(slabs.tiles.size());
  for_each_index(at_forks.size(), threads, [&](std::size_t i, unsigned) {
    at_forks[i] = tiles_at_forks(regions[i], regions[i + 1], slabs.pieces[i], slabs.tiles[i]);
  });
  std::vector<std::size_t> forked;
  std::vector<bool> is_near(regions.size());
  for (std::size_t i = 0; i < at_forks.size(); ++i) {
    if (at_forks[i].empty()) continue;
    forked.push_back(i);
    for (std::size_t k = i == 0 ? 0 : i - 1; k < std::min(i + 3, regions.size()); ++k)
      is_near[k] = true;
  }
  std::vector<SliceShape> shapes(regions.size());
  for_each_index(regions.size(), threads, [&](std::size_t i, unsigned) {
    if (is_near[i]) shapes[i] = SliceShape(regions[i]);
  });
  for_each_index(forked.size(), threads, [&](std::size_t f, unsigned) {
    const std::size_t i = forked[f];
    slabs.tiles[i] = bend_forks(regions[i], regions[i + 1], surroundings(shapes, i),
                                slabs.pieces[i], slabs.tiles[i], at_forks[i]);
  });
}

void refine_all(const std::vector<Region>& regions, std::vector<TileSet>& slabs,
                const Options& options, const Progress& progress) {
  Reporter reporter(progress, Stage::refine, slabs.size());
  for_each_index(slabs.size(), options.threads, [&](std::size_t i, unsigned) {
    slabs[i] = refine(regions[i], regions[i + 1], std::move(slabs[i]), options);
    reporter.add_step();
  });
}

void check_enough(std::span<const Region> regions) {
  if (std::ranges::none_of(regions, &Region::has_loops)) throw too_few_slices(nullptr);
  if (regions.size() < 2) throw too_few_slices(regions.empty() ? nullptr : &regions.front());
}

Reconstructed reconstruct_from(std::span<const Slice> slices, const Clean& clean_height,
                               const Options& all_options, const Progress& progress) {
  if (const auto problems = find_bad_orders(slices, all_options.links); !problems.empty())
    throw InputError(in_lines(problems));
  Options options = all_options;
  options.links = orders_for(options.label, slices, options.links);
  std::vector<Defect> repairs;
  std::vector<double> z;
  for (const Slice& slice : slices) z.push_back(slice.z);
  const auto heights = find_heights(z, options.height_tolerance, repairs);
  auto regions =
      trim(clean_all(heights, options.threads, clean_height, repairs, progress), repairs);
  SlabVolume slab_volume(options.gap.value_or(0));
  for (const Region& region : regions) slab_volume.add(region);
  if (options.cap == Cap::extend) {
    extend_ends(regions, options.gap);
    options.cap = Cap::flat;
  }
  check_enough(regions);
  if (options.cap == Cap::dome) add_beyond_ends(regions);
  std::vector<Refusal> refusals;
  Linking linking(options, orders_of_slabs(regions, options.links, refusals));
  Slabs slabs = tile_all(regions, linking, options.threads, progress);
  report_unused_lines(regions, slabs.pieces, repairs);
  report_unlinked(regions, slabs.tiles, repairs);
  report_refused(slices, options.links, std::move(refusals), linking, repairs);
  std::ranges::stable_sort(repairs, {}, &Defect::z);
  std::vector<SlabReport> reports;
  if (options.reports_slabs) reports = report_slabs(regions, slabs.tiles, slabs.pieces);
  if (options.smooth) {
    smooth_all(regions, slabs, options, progress);
  } else {
    bend_all_forks(regions, slabs, options.threads);
  }
  if (options.max_edge || options.target_edge) refine_all(regions, slabs.tiles, options, progress);
  Reporter sewing(progress, Stage::sew, 1);
  // Made in its place: an OpenMesh mesh cannot be moved, only copied.
  Reconstructed result{sew(regions, std::move(slabs.tiles), options.cap, options.threads),
                       std::move(repairs), std::move(reports), slab_volume.volume()};
  sewing.add_step();
  if (options.simplify) {
    Reporter simplifying(progress, Stage::simplify, 1);
    simplify(result.surface, *options.simplify);
    simplifying.add_step();
  }
  return result;
}

Options without_fair(const Options& options) {
  Options rest = options;
  rest.fair = {};
  return rest;
}

}  // namespace

Reconstructed reconstruct(std::span<const Slice> slices, const Options& options,
                          const Progress& progress) {
  require_usable(options);
  require_usable(slices);
  if (options.fair)
    return reconstruct(fair(slices, *options.fair, options.height_tolerance, options.threads),
                       without_fair(options), progress);
  OneLabel one_label(options.label);
  for (const Slice& slice : slices) one_label.add(slice);
  const auto clean_height = [&](const Height& height, std::vector<Defect>& repairs,
                                cdt::Triangulation& memory) {
    std::vector<const Slice*> parts;
    for (const std::uint32_t s : height.slices) parts.push_back(&slices[s]);
    return clean(height, parts, options, repairs, memory);
  };
  return reconstruct_from(slices, clean_height, options, progress);
}

Reconstructed reconstruct(std::span<const Slice> slices, const ContoursByLabel& contours,
                          const Options& options, const Progress& progress) {
  assert(options.label);
  require_usable(options);
  if (!contours.unusable().empty()) throw InputError(contours.unusable());
  if (options.fair)
    return reconstruct(fair(slices, *options.fair, options.height_tolerance, options.threads),
                       contours, without_fair(options), progress);
  const std::span<const ContourId> wanted = contours.of(*options.label);
  const auto clean_height = [&](const Height& height, std::vector<Defect>& repairs,
                                cdt::Triangulation& memory) {
    return clean(height, slices, wanted, options, repairs, memory);
  };
  return reconstruct_from(slices, clean_height, options, progress);
}

namespace {

Options options_for(const Stack& stack, const Options& options) {
  Options result = options;
  if (stack.fill) result.fill = *stack.fill;
  if (!result.keyhole_width) result.keyhole_width = stack.keyhole_width;
  if (!result.gap) {
    const StackLabel* const label = options.label ? stack.find_label(*options.label) : nullptr;
    result.gap = label != nullptr && label->gap ? label->gap : stack.gap;
  }
  return result;
}

}  // namespace

Reconstructed reconstruct(const Stack& stack, const Options& options, const Progress& progress) {
  if (options.fair) {
    require_usable(options);
    return reconstruct(fair(stack, *options.fair, options.height_tolerance, options.threads),
                       without_fair(options), progress);
  }
  Reconstructed made = reconstruct(stack.slices, options_for(stack, options), progress);
  place_in_world(stack, made.surface, made.repairs);
  return made;
}

Reconstructed reconstruct(const Stack& stack, const ContoursByLabel& contours,
                          const Options& options, const Progress& progress) {
  if (options.fair) {
    require_usable(options);
    return reconstruct(fair(stack, *options.fair, options.height_tolerance, options.threads),
                       contours, without_fair(options), progress);
  }
  Reconstructed made = reconstruct(stack.slices, contours, options_for(stack, options), progress);
  place_in_world(stack, made.surface, made.repairs);
  return made;
}

std::vector<std::string> labels(std::span<const Slice> slices) {
  std::set<std::string> found;
  for (const Slice& slice : slices)
    for (const Contour& contour : slice.contours) found.insert(contour.label);
  return {found.begin(), found.end()};
}

}  // namespace loft
