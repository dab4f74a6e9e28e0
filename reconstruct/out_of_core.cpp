// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/lines.h"
#include "reconstruct/link/linking.h"
#include "reconstruct/link/tips.h"
#include "reconstruct/out_of_core/label_ends.h"
#include "reconstruct/out_of_core/passing_on.h"
#include "reconstruct/out_of_core/read_region.h"
#include "reconstruct/out_of_core/region_queue.h"
#include "reconstruct/parallel.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/sew/caps.h"
#include "reconstruct/sew/sewing.h"
#include "reconstruct/sew/used_points.h"
#include "reconstruct/shape/forks.h"
#include "reconstruct/shape/refine.h"
#include "reconstruct/shape/smooth.h"
#include "reconstruct/tile/tiles.h"
#include "reconstruct/usable.h"

namespace loft {

namespace {

/// Heights are worked on in groups of about so many points: enough to keep many threads busy, few
/// enough to take little memory.
constexpr std::size_t group_size = std::size_t{1} << 17U;

bool has_flat_caps(const Options& options) {
  return options.cap == Cap::flat || options.cap == Cap::extend;
}

/// The lines from heights to faces, group by group.
class GroupByGroup {
 public:
  GroupByGroup(const SliceSource& source, const Options& options, SurfaceSink& sink,
               const Window& window = {})
      : source_(source),
        options_(options),
        window_(window),
        caps_below_(window.is_bottom && has_flat_caps(options) ? 1 : 0),
        one_label_(options.label),
        regions_(options.cap, options.gap, window.is_bottom),
        linking_(options),
        passing_on_(sewing_, sink, window.first_slab == 0 ? 0 : layer_of(window.first_slab),
                    window.slab_bound == Window::all ? Origin::none : layer_of(window.slab_bound)),
        memories_(thread_count(options.threads)),
        workspaces_(thread_count(options.threads)) {}

  /// `all` are the heights of the stack.
  void run(std::span<const Height> all, const Progress& progress) {
    const auto heights = all.subspan(
        window_.first_height, std::min(window_.height_count, all.size() - window_.first_height));
    const auto tell = [&](std::size_t done) {
      const double share =
          heights.empty() ? 1 : static_cast<double>(done) / static_cast<double>(heights.size());
      if (progress && !progress(Stage::tile, share)) throw Cancelled();
    };
    tell(0);
    for (std::size_t done = 0; done < heights.size();) {
      const auto group = next_group(heights.subspan(done));
      for (Region& region : clean_group(group)) regions_.add(std::move(region));
      make_slabs(End::none);
      done += group.size();
      tell(done);
    }
    if (window_.is_top) {
      regions_.end();
      make_slabs(End::top);
    } else {
      regions_.break_off();
      make_slabs(End::break_off);
    }
    finish();
  }

  /// `repairs`: what finding heights has told.
  [[nodiscard]] OutOfCoreReport report(std::vector<Defect> repairs) {
    std::ranges::move(repairs_, std::back_inserter(repairs));
    std::ranges::copy(regions_.repairs(), std::back_inserter(repairs));
    std::ranges::move(unused_, std::back_inserter(repairs));
    std::ranges::move(unlinked_, std::back_inserter(repairs));
    std::ranges::stable_sort(repairs, {}, &Defect::z);
    keep_own_reports();
    Survey& survey = passing_on_.survey();
    return {std::move(repairs), std::move(reports_), survey.measures(), survey.vertices_of_kind(),
            regions_.slab_volume()};
  }

  /// Of a range, once it is finished.
  [[nodiscard]] SlabsReport report_of_range(std::vector<Defect> repairs) {
    return {report(std::move(repairs)), passing_on_.sizes(), passing_on_.lower_places(),
            passing_on_.upper_places()};
  }

 private:
  /// Where a group of slabs ends: more follow; or nothing does, with or without more in the stack.
  enum class End { none, break_off, top };

  /// At least as many heights as there are threads, if there are.
  [[nodiscard]] std::span<const Height> next_group(std::span<const Height> heights) const {
    std::size_t points = 0;
    std::size_t count = 0;
    for (; count < heights.size() && (points < group_size || count < memories_.size()); ++count)
      for (const std::uint32_t s : heights[count].slices) points += source_.slices[s].points;
    return heights.first(count);
  }

  [[nodiscard]] std::vector<Region> clean_group(std::span<const Height> heights) {
    std::vector<Region> cleaned(heights.size());
    std::vector<std::vector<Defect>> found(heights.size());
    std::vector<std::set<std::string>> labels(heights.size());
    for_each_index(heights.size(), options_.threads, [&](std::size_t i, unsigned worker) {
      cleaned[i] =
          read_region(source_, heights[i], options_, found[i], labels[i], memories_[worker]);
    });
    for (const auto& some : labels)
      for (const std::string& label : some) one_label_.add(label);
    for (auto& some : found) std::ranges::move(some, std::back_inserter(repairs_));
    return cleaned;
  }

  [[nodiscard]] std::uint32_t layer_of(std::size_t slab) const {
    return static_cast<std::uint32_t>(slab + caps_below_);
  }

  /// Takes every slab as far as the regions that are known allow.
  void make_slabs(End end) {
    if (regions_.bound() < 2) return;  // from the second on the first one stays
    for (; added_bound_ < regions_.bound(); ++added_bound_) linking_.add(regions_[added_bound_]);
    const std::size_t tiled = std::exchange(tiled_bound_, linking_.slab_bound());
    for_each_index(tiled_bound_ - tiled, options_.threads, [&](std::size_t i, unsigned worker) {
      linking_.tile(tiled + i, workspaces_[worker]);
    });
    // Each of the following steps looks at what the one before made of the next slab.
    const std::size_t matched =
        std::exchange(matched_bound_, tiled_bound_ - (end == End::top ? 0 : 1));
    for_each_index(matched_bound_ - matched, options_.threads,
                   [&](std::size_t i, unsigned) { linking_.match(matched + i); });
    const std::size_t behind = end == End::none ? 1 : 0;
    if (matched_bound_ < slab_bound_ + 2 * behind) return;
    const std::size_t first = std::exchange(slab_bound_, matched_bound_ - behind);
    std::vector<TileSet> slabs(slab_bound_ - first);
    std::vector<std::vector<bool>> at_forks(slabs.size());  // tiles, if these alone are bent
    if (options_.reports_slabs) reports_.resize(slab_bound_);
    for_each_index(slabs.size(), options_.threads, [&](std::size_t i, unsigned) {
      slabs[i] = link_slab(first + i);
      if (!options_.smooth) at_forks[i] = find_forks(first + i, slabs[i]);
    });
    add_shapes(first, at_forks);
    for_each_index(slabs.size(), options_.threads, [&](std::size_t i, unsigned) {
      slabs[i] = bend_slab(first + i, std::move(slabs[i]), at_forks[i]);
    });
    settle_lines(first, slabs);
    linking_.drop_below(slab_bound_ == 0 ? 0 : slab_bound_ - 1);

    std::vector<Layer> layers;
    if (first == 0 && caps_below_ != 0) layers.push_back(bottom_cap(sewn_region(0)));
    for (std::size_t i = 0; i < slabs.size(); ++i) {
      const Region& lower = sewn_region(first + i);
      const Region& upper = sewn_region(first + i + 1);
      if (!slabs[i].is_linked) unlinked_.push_back(unlinked_slices(lower));
      layers.push_back({&lower, &upper, std::move(slabs[i]), slab_number(first + i), lower.slice});
    }
    sewing_.add(std::move(layers), options_.threads);
    pass_on();
  }

  /// What faces will say.
  [[nodiscard]] std::uint32_t slab_number(std::size_t i) const {
    return static_cast<std::uint32_t>(window_.first_region + i);
  }

  [[nodiscard]] TileSet link_slab(std::size_t i) {
    linking_.link(i);
    TileSet tiles = std::move(linking_.tiles(i));
    if (options_.reports_slabs)
      reports_[i] = report_slab(regions_[i], regions_[i + 1], tiles, linking_.pieces(i));
    return tiles;
  }

  [[nodiscard]] std::vector<bool> find_forks(std::size_t i, const TileSet& tiles) {
    return tiles_at_forks(regions_[i], regions_[i + 1], linking_.pieces(i), tiles);
  }

  /// What bending wants to know of the regions around slabs.
  void add_shapes(std::size_t first, std::span<const std::vector<bool>> at_forks) {
    std::vector<std::pair<const std::size_t, SliceShape>*> added;
    for (std::size_t i = first; i < first + at_forks.size(); ++i) {
      if (!options_.smooth && at_forks[i - first].empty()) continue;
      for (std::size_t k = i == 0 ? 0 : i - 1; k < i + 3; ++k) {
        if (!regions_.has(k)) continue;
        const auto [shape, is_new] = shapes_.try_emplace(k);
        if (is_new) added.push_back(&*shape);
      }
    }
    for_each_index(added.size(), options_.threads, [&](std::size_t i, unsigned) {
      added[i]->second = SliceShape(regions_[added[i]->first]);
    });
  }

  [[nodiscard]] TileSet bend_slab(std::size_t i, TileSet tiles, const std::vector<bool>& at_forks) {
    const Region& lower = regions_[i];
    const Region& upper = regions_[i + 1];
    if (options_.smooth || !at_forks.empty()) {
      Surroundings around{};
      for (std::size_t k = 0; k < around.size(); ++k)
        if (i + k >= 1 && regions_.has(i + k - 1)) around[k] = &shapes_.at(i + k - 1);
      const Pieces& pieces = linking_.pieces(i);
      tiles = options_.smooth ? smooth(lower, upper, around, pieces, std::move(tiles),
                                       options_.smooth_tolerance)
                              : bend_forks(lower, upper, around, pieces, tiles, at_forks);
    }
    return refine(lower, upper, std::move(tiles), options_);
  }

  /// Leaves out the points of lines that no part ends in; names the lines.
  void settle_lines(std::size_t first, std::vector<TileSet>& slabs) {
    const std::size_t last = first + slabs.size();  // the region above them
    for (std::size_t i = first == 0 ? 0 : first + 1; i <= last; ++i) {
      if (regions_[i].line_count() == 0) continue;
      const bool has_above = i < linking_.slab_bound();
      const TileSet* const above = i < last    ? &slabs[i - first]
                                   : has_above ? &linking_.tiles(i)
                                               : nullptr;
      used_[i] = UsedPoints(regions_[i], i > 0 ? &regions_[i - 1] : nullptr,
                            i > 0 ? &slabs[i - 1 - first] : nullptr, above);
      for (const std::uint32_t line :
           unused_lines(regions_[i], i > 0 ? &linking_.pieces(i - 1) : nullptr,
                        has_above ? &linking_.pieces(i) : nullptr))
        unused_.push_back(unused_line(regions_[i], line));
    }
    static const UsedPoints all;
    const auto used = [&](std::size_t i) -> const UsedPoints& {
      const auto found = used_.find(i);
      return found == used_.end() ? all : found->second;
    };
    for (std::size_t i = first; i < last; ++i)
      renumber(slabs[i - first], regions_[i], regions_[i + 1], used(i), used(i + 1));
  }

  /// A region as it is sewn, once it is settled.
  [[nodiscard]] const Region& sewn_region(std::size_t i) const {
    const auto found = used_.find(i);
    return found == used_.end() ? regions_[i] : found->second.region();
  }

  void finish() {
    if (window_.is_top) add_top();
    pass_on();
    passing_on_.finish();
  }

  void add_top() {
    if (has_flat_caps(options_)) {
      const std::size_t last = slab_bound_ - 1;
      std::vector<Layer> cap;
      cap.push_back(top_cap(sewn_region(last + 1), slab_number(last), regions_[last].slice));
      sewing_.add(std::move(cap), options_.threads);
    }
    sewing_.finish(options_.threads);
  }

  /// Passes on the layers that have become final, and forgets what nobody needs any more.
  void pass_on() {
    passing_on_.pass_on();
    // Layers begin with the cap; a slab looks at the slice before its own.
    const std::size_t passed = passing_on_.passed_bound();
    const std::size_t sewn = passed - std::min<std::size_t>(caps_below_, passed);
    const std::size_t needed = std::min(sewn, slab_bound_ - std::min<std::size_t>(1, slab_bound_));
    regions_.drop_below(needed);
    used_.erase(used_.begin(), used_.lower_bound(needed));
    shapes_.erase(shapes_.begin(), shapes_.lower_bound(needed));
  }

  /// Those of slabs that are passed on.
  void keep_own_reports() {
    if (!options_.reports_slabs) return;
    if (window_.slab_bound < reports_.size()) reports_.resize(window_.slab_bound);
    reports_.erase(reports_.begin(),
                   reports_.begin() + static_cast<std::ptrdiff_t>(window_.first_slab));
  }

  const SliceSource& source_;
  const Options& options_;
  Window window_;
  std::size_t caps_below_;  // layers below the first slab
  OneLabel one_label_;
  RegionQueue regions_;
  std::map<std::size_t, SliceShape> shapes_;  // of the regions around slabs that are bent
  Linking linking_;
  std::size_t added_bound_ = 0;    // regions below are known to it
  std::size_t tiled_bound_ = 0;    // slabs below are tiled,
  std::size_t matched_bound_ = 0;  // have their ends matched,
  std::size_t slab_bound_ = 0;     // are made
  Sewing sewing_;
  PassingOn passing_on_;
  std::vector<Defect> repairs_;
  std::map<std::size_t, UsedPoints> used_;  // of the regions that have lines
  std::vector<Defect> unused_;              // lines
  std::vector<Defect> unlinked_;
  std::vector<SlabReport> reports_;

  // Memory that is used again.
  std::vector<cdt::Triangulation> memories_;
  std::vector<TileWorkspace> workspaces_;
};

void require_out_of_core(const Options& options) {
  if (options.simplify || !options.links.empty())
    throw std::invalid_argument("simplify and links need the whole stack");
  require_usable(options);
}

/// Leaves defects of other slices out; those of none, beyond the ends, go with the lowest.
void keep_those_of(SlabRange range, std::span<const Height> heights, std::vector<Defect>& defects) {
  std::set<std::uint32_t> slices;
  if (range.first == 0) slices.insert(Origin::none);
  const bool is_last = range.bound + 1 == heights.size();
  for (const Height& height :
       heights.subspan(range.first, range.bound - range.first + (is_last ? 1 : 0)))
    slices.insert(height.slices.begin(), height.slices.end());
  std::erase_if(defects, [&](const Defect& defect) { return !slices.contains(defect.slice); });
}

}  // namespace

OutOfCoreReport reconstruct_out_of_core(const SliceSource& source, const Options& options,
                                        SurfaceSink& sink, const Progress& progress) {
  require_out_of_core(options);
  std::vector<Defect> repairs;
  const auto heights = find_heights(usable_heights(source), options.height_tolerance, repairs);
  GroupByGroup work(source, options, sink);
  work.run(heights, progress);
  return work.report(std::move(repairs));
}

std::size_t count_slabs(const SliceSource& source, const Options& options) {
  std::vector<Defect> ignored;
  const auto heights = find_heights(usable_heights(source), options.height_tolerance, ignored);
  return heights.empty() ? 0 : heights.size() - 1;
}

SlabsReport reconstruct_slabs(const SliceSource& source, const Options& options, SlabRange range,
                              HeightSpan span, SurfaceSink& sink, const Progress& progress) {
  require_out_of_core(options);
  std::vector<Defect> repairs;
  const auto heights = find_heights(usable_heights(source), options.height_tolerance, repairs);
  const auto window = LabelEnds(source, heights, options, span).window(range);
  SlabsReport made;
  if (window) {
    GroupByGroup work(source, options, sink, *window);
    work.run(heights, progress);
    made = work.report_of_range(std::move(repairs));
  } else {
    sink.end({});
  }
  keep_those_of(range, heights, made.report.repairs);
  return made;
}

}  // namespace loft
