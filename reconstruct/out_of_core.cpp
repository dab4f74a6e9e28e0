// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/lines.h"
#include "reconstruct/link/linking.h"
#include "reconstruct/link/tips.h"
#include "reconstruct/parallel.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/sew/caps.h"
#include "reconstruct/sew/sewing.h"
#include "reconstruct/sew/survey.h"
#include "reconstruct/sew/used_points.h"
#include "reconstruct/shape/refine.h"
#include "reconstruct/shape/smooth.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

namespace {

/// Heights are worked on in groups of about so many points: enough to keep many threads busy, few
/// enough to take little memory.
constexpr std::size_t group_size = std::size_t{1} << 17U;

/// The regions of a stack in the order of their heights, of the empty ones at both ends only the
/// nearest; those that are no longer needed are forgotten.
class Regions {
 public:
  /// `is_bottom`: the first one that comes is the first there is.
  Regions(Cap cap, std::optional<double> gap, bool is_bottom)
      : cap_(cap),
        gap_(gap),
        volume_(gap.value_or(0)),
        has_low_end_(!is_bottom),
        has_filled_(!is_bottom),
        has_loops_(!is_bottom) {}

  void add(Region region) {
    count_volume(region);
    if (region.is_empty()) {
      if (!has_filled_ && cap_ == Cap::extend) return;
      if (!has_filled_) empty_.clear();  // only the nearest one counts
      empty_.push_back(std::move(region));
      return;
    }
    append_empty();
    has_filled_ = true;
    has_loops_ = has_loops_ || region.has_loops();
    append(std::move(region));
  }

  /// There are more, but they do not come.
  void break_off() { append_empty(); }

  /// No more come.
  void end() {
    if (!has_loops_) throw too_few_slices(nullptr);
    if (cap_ == Cap::extend) return extend_end();
    if (!empty_.empty()) append(std::move(empty_.front()));
    if (bound() < 2) throw too_few_slices(&regions_.front());
    if (cap_ == Cap::dome && regions_.back().has_loops())
      regions_.push_back(beyond(regions_.back(), regions_[regions_.size() - 2]));
  }

  [[nodiscard]] std::size_t bound() const { return first_ + regions_.size(); }
  [[nodiscard]] bool has(std::size_t i) const { return i >= first_ && i < bound(); }
  /// Stays where it is until it is dropped.
  [[nodiscard]] const Region& operator[](std::size_t i) const { return regions_[i - first_]; }
  void drop_below(std::size_t i) {
    for (; first_ < i; ++first_) regions_.pop_front();
  }

  /// Of all that came, without the first empty ones.
  [[nodiscard]] double slab_volume() const { return volume_.volume(); }
  /// Warnings of those that are empty.
  [[nodiscard]] const std::vector<Defect>& repairs() const { return repairs_; }

 private:
  void append_empty() {
    for (Region& empty : std::exchange(empty_, {})) {
      if (has_filled_) repairs_.push_back(empty_slice(empty));
      append(std::move(empty));
    }
  }

  void append(Region region) {
    regions_.push_back(std::move(region));
    if ((cap_ != Cap::dome && cap_ != Cap::extend) || bound() != 2 || has_low_end_) return;
    has_low_end_ = true;
    if (!regions_[0].has_loops()) return;
    regions_.push_front(cap_ == Cap::dome
                            ? beyond(regions_[0], regions_[1])
                            : extended(regions_[0], (regions_[0].z - regions_[1].z) / 2));
  }

  void count_volume(const Region& region) {
    if (!has_filled_ && region.is_empty()) {
      lowest_ = region;
      return;
    }
    if (const auto lowest = std::exchange(lowest_, {})) volume_.add(*lowest);
    volume_.add(region);
  }

  void extend_end() {
    const bool is_alone = bound() < 2;
    if (is_alone && !gap_) throw too_few_slices(&regions_.front());
    const Region& last = regions_.back();
    const double gap = is_alone ? *gap_ : last.z - regions_[regions_.size() - 2].z;
    if (!last.has_loops()) return;
    Region above = extended(last, gap / 2);
    if (is_alone) regions_.push_front(extended(last, -gap / 2));
    regions_.push_back(std::move(above));
  }

  Cap cap_;
  std::optional<double> gap_;  // of a slice that is alone
  SlabVolume volume_;
  std::optional<Region> lowest_;  // the nearest empty one below the first filled one
  bool has_low_end_;
  std::deque<Region> regions_;
  std::size_t first_ = 0;
  bool has_filled_;
  bool has_loops_;
  std::vector<Region> empty_;  // above the last filled one
  std::vector<Defect> repairs_;
};

/// The slices at a height, cleaned.
Region read_and_clean(const SliceSource& source, const Height& height, const Options& options,
                      std::vector<Defect>& repairs, std::set<std::string>& labels,
                      cdt::Triangulation& memory) {
  std::vector<Slice> slices;
  std::vector<const Slice*> parts;
  slices.reserve(height.slices.size());
  for (const std::uint32_t s : height.slices) {
    slices.push_back(source.read(s));
    if (auto fatal = find_unusable(slices.back(), s); !fatal.empty())
      throw InputError(std::move(fatal));
    parts.push_back(&slices.back());
    if (!options.label)
      for (const Contour& contour : slices.back().contours) labels.insert(contour.label);
  }
  return clean(height, parts, options, repairs, memory);
}

std::vector<double> usable_heights(const SliceSource& source) {
  std::vector<double> z;
  std::vector<Defect> fatal;
  for (const SliceSource::Entry& slice : source.slices) {
    const auto index = static_cast<std::uint32_t>(z.size());
    std::ranges::move(find_unusable({slice.z, {}}, index), std::back_inserter(fatal));
    z.push_back(slice.z);
  }
  if (!fatal.empty()) throw InputError(std::move(fatal));
  return z;
}

bool has_flat_caps(const Options& options) {
  return options.cap == Cap::flat || options.cap == Cap::extend;
}

/// What is worked on of a label: heights, from the first region that counts or from one within it,
/// and which of the slabs between these regions are passed on. What is not told by heights is
/// counted from the first region worked on.
struct Window {
  static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

  std::size_t first_height = 0;
  std::size_t height_count = all;
  bool is_bottom = true;         // nothing is below
  bool is_top = true;            // nothing is above
  std::size_t first_region = 0;  // its number among all of the label
  std::size_t first_slab = 0;
  std::size_t slab_bound = all;  // all: up to the top
};

/// Where a label begins and ends among heights, and how its regions are numbered.
class LabelEnds {
 public:
  LabelEnds(const SliceSource& source, std::span<const Height> heights, const Options& options,
            HeightSpan span)
      : source_(source), heights_(heights), options_(options) {
    find_low(span);
    find_high(span);
    const bool keeps_empty = options.cap != Cap::extend;
    const bool has_beyond = options.cap == Cap::extend || options.cap == Cap::dome;
    first_ = keeps_empty && low_ > 0 ? low_ - 1 : low_;
    last_ = keeps_empty && high_ + 1 < heights.size() ? high_ + 1 : high_;
    beyond_ = has_beyond && first_ == low_ && low_has_loops_ ? 1 : 0;
    const bool has_high_end = has_beyond && last_ == high_ && high_has_loops_;
    slab_count_ = last_ - first_ + beyond_ + (has_high_end ? 1 : 0);
  }

  /// None if the label has nothing there.
  [[nodiscard]] std::optional<Window> window(SlabRange range) const {
    const std::size_t first = range.first == 0 ? 0 : slabs_below(range.first);
    const bool is_last = range.bound + 1 == heights_.size();
    const std::size_t bound = is_last ? slab_count_ : slabs_below(range.bound);
    if (first == bound) return std::nullopt;
    Window window;
    window.first_region = first - std::min(first, slices_beside_range);
    window.is_bottom = window.first_region == 0;
    window.is_top = bound + slices_beside_range >= slab_count_;
    window.first_height = window.is_bottom ? first_ : first_ + window.first_region - beyond_;
    const std::size_t last = window.is_top ? last_ : first_ + bound + slices_beside_range - beyond_;
    window.height_count = last + 1 - window.first_height;
    window.first_slab = first - window.first_region;
    window.slab_bound = bound == slab_count_ ? Window::all : bound - window.first_region;
    return window;
  }

 private:
  /// Of the label, below a height: none up to where it begins, all from where it ends.
  [[nodiscard]] std::size_t slabs_below(std::size_t height) const {
    if (height <= first_) return 0;
    return height >= last_ ? slab_count_ : height - first_ + beyond_;
  }

  [[nodiscard]] Region region(std::size_t height) {
    std::vector<Defect> ignored;
    std::set<std::string> labels;
    return read_and_clean(source_, heights_[height], options_, ignored, labels, memory_);
  }

  void find_low(HeightSpan span) {
    std::optional<Region> lowest;
    bool has_loops = false;
    for (std::size_t i = 0; i < heights_.size() && !has_loops; ++i) {
      if (heights_[i].z < span.lowest && !is_at(i, span.lowest)) continue;
      Region found = region(i);
      has_loops = found.has_loops();
      if (lowest || found.is_empty()) continue;
      low_ = i;
      low_has_loops_ = has_loops;
      lowest = std::move(found);
    }
    if (!has_loops) throw too_few_slices(nullptr);
  }

  void find_high(HeightSpan span) {
    for (high_ = heights_.size() - 1; high_ > low_; --high_) {
      if (heights_[high_].z > span.highest) continue;
      const Region found = region(high_);
      if (found.is_empty()) continue;
      high_has_loops_ = found.has_loops();
      return;
    }
    high_has_loops_ = low_has_loops_;
    if (options_.cap == Cap::extend && !options_.gap) {
      const Region only = region(low_);
      throw too_few_slices(&only);
    }
  }

  /// Whether a slice of that z is one of those at a height, which its lowest stands for.
  [[nodiscard]] bool is_at(std::size_t height, double z) const {
    return std::ranges::any_of(heights_[height].slices,
                               [&](std::uint32_t s) { return source_.slices[s].z == z; });
  }

  const SliceSource& source_;
  std::span<const Height> heights_;
  const Options& options_;
  cdt::Triangulation memory_;
  std::size_t low_ = 0;  // the first and the last height with a region that is not empty
  std::size_t high_ = 0;
  bool low_has_loops_ = false;
  bool high_has_loops_ = false;
  std::size_t first_ = 0;  // of the first and the last region, but for those beyond the ends
  std::size_t last_ = 0;
  std::size_t beyond_ = 0;  // regions below the first height
  std::size_t slab_count_ = 0;
};

/// The lines from heights to faces, group by group.
class GroupByGroup {
 public:
  GroupByGroup(const SliceSource& source, const Options& options, SurfaceSink& sink,
               const Window& window = {})
      : source_(source),
        options_(options),
        sink_(sink),
        window_(window),
        caps_below_(window.is_bottom && has_flat_caps(options) ? 1 : 0),
        first_layer_(window.first_slab == 0 ? 0 : layer_of(window.first_slab)),
        layer_bound_(window.slab_bound == Window::all ? Origin::none : layer_of(window.slab_bound)),
        one_label_(options.label),
        regions_(options.cap, options.gap, window.is_bottom),
        linking_(options),
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
    return {std::move(repairs), std::move(reports_), survey_.measures(), survey_.vertices_of_kind(),
            regions_.slab_volume()};
  }

  /// Of a range, once it is finished.
  [[nodiscard]] SlabsReport report_of_range(std::vector<Defect> repairs) {
    SlabsReport made{report(std::move(repairs)), sizes_, {}, {}};
    for (const Cut& cut : cuts_) {
      if (is_in_lower_seam(cut)) made.lower_places.push_back(cut.place - lower_.cuts);
      if (is_in_upper_seam(cut)) made.upper_places.push_back(cut.place - upper_.cuts);
    }
    return made;
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
          read_and_clean(source_, heights[i], options_, found[i], labels[i], memories_[worker]);
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
    add_shapes();
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
    if (options_.reports_slabs) reports_.resize(slab_bound_);
    for_each_index(slabs.size(), options_.threads,
                   [&](std::size_t i, unsigned) { slabs[i] = make_slab(first + i); });
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

  [[nodiscard]] TileSet make_slab(std::size_t i) {
    linking_.link(i);
    TileSet tiles = std::move(linking_.tiles(i));
    if (options_.reports_slabs)
      reports_[i] = report_slab(regions_[i], regions_[i + 1], tiles, linking_.pieces(i));
    if (options_.smooth) {
      Surroundings around{};
      for (std::size_t k = 0; k < around.size(); ++k)
        if (i + k >= 1 && regions_.has(i + k - 1)) around[k] = &shapes_[i + k - 1 - first_shape_];
      tiles = smooth(regions_[i], regions_[i + 1], around, linking_.pieces(i), std::move(tiles),
                     options_.smooth_tolerance);
    }
    return refine(regions_[i], regions_[i + 1], std::move(tiles), options_);
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

  /// What bending wants to know of the regions that are new.
  void add_shapes() {
    if (!options_.smooth || regions_.bound() < 2) return;  // then the first one is known
    const std::size_t known = first_shape_ + shapes_.size();
    shapes_.resize(regions_.bound() - first_shape_);
    for_each_index(regions_.bound() - known, options_.threads, [&](std::size_t i, unsigned) {
      shapes_[known + i - first_shape_] = SliceShape(regions_[known + i]);
    });
  }

  void finish() {
    if (window_.is_top) add_top();
    pass_on();
    pass_on_added();
    std::ranges::sort(cuts_, {}, &Cut::place);
    for (const Cut& cut : cuts_) survey_.add_face(cut.places);
    std::vector<SurfaceFace> faces;
    for (const Cut& cut : cuts_) faces.push_back(cut.face);
    sink_.add_faces(faces);
    sink_.end({sizes_.plain + sizes_.upper, sizes_.lower_doubled + sizes_.doubled});
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

  /// What sewing has added to the layers that are passed on.
  void pass_on_added() {
    const Sewing::Added all{static_cast<std::uint32_t>(sewing_.doubled().size()),
                            static_cast<std::uint32_t>(sewing_.midpoints().size()),
                            static_cast<std::uint32_t>(sewing_.cut_faces().size())};
    const bool has_upper = layer_bound_ != Origin::none;
    if (first_layer_ > 0) note_lower_seam();
    upper_ = has_upper ? sewing_.added_before(layer_bound_) : all;
    const Sewing::Added above = has_upper ? sewing_.added_before(layer_bound_ + 1) : all;
    sizes_.doubled = upper_.doubled - lower_.doubled;
    sizes_.midpoints = upper_.midpoints - lower_.midpoints;
    sizes_.upper_midpoints = above.midpoints - upper_.midpoints;
    sizes_.upper_seam = above.cuts - upper_.cuts;
    pass_on_vertices(sewing_.doubled().first(upper_.doubled).subspan(first_doubled()));
    pass_on_vertices(sewing_.midpoints().first(above.midpoints).subspan(lower_.midpoints));
    for (const Cut& cut : cuts_)
      ++(is_in_lower_seam(cut)   ? sizes_.lower_cuts
         : is_in_upper_seam(cut) ? sizes_.upper_cuts
                                 : sizes_.cuts);
  }

  void note_lower_seam() {
    lower_ = sewing_.added_before(first_layer_);
    lower_seam_end_ = sewing_.added_before(first_layer_ + 1).cuts;
    sizes_.lower_doubled = lower_.doubled - sewing_.added_before(first_layer_ - 1).doubled;
    sizes_.lower_seam = lower_seam_end_ - lower_.cuts;
  }

  [[nodiscard]] std::uint32_t first_doubled() const {
    return lower_.doubled - sizes_.lower_doubled;
  }

  /// Passes on the layers that have become final, and forgets what nobody needs any more.
  void pass_on() {
    for (; passed_bound_ < sewing_.final_bound(); ++passed_bound_) {
      if (passed_bound_ < first_layer_ || passed_bound_ >= layer_bound_) continue;
      if (passed_bound_ == first_layer_) begin_passing_on();
      pass_on_vertices_of(passed_bound_);
      pass_on_faces_of(passed_bound_);
      survey_.connect(sewing_, passed_bound_, first_layer_, layer_bound_);
      if (passed_bound_ + 1 == layer_bound_) pass_on_upper_slice();
    }
    sewing_.drop_below(passed_bound_);
    // Layers begin with the cap; a slab looks at the slice before its own.
    const std::size_t sewn = passed_bound_ - std::min<std::size_t>(caps_below_, passed_bound_);
    const std::size_t needed = std::min(sewn, slab_bound_ - std::min<std::size_t>(1, slab_bound_));
    regions_.drop_below(needed);
    used_.erase(used_.begin(), used_.lower_bound(needed));
    for (; options_.smooth && first_shape_ < needed; ++first_shape_) shapes_.pop_front();
  }

  /// Knows from here on how corners are numbered.
  void begin_passing_on() {
    first_vertex_ = sewing_.first_vertex(first_layer_);
    if (first_layer_ > 0) note_lower_seam();
  }

  /// What the part above begins with.
  void pass_on_upper_slice() {
    vertices_.clear();
    add_slice(*sewing_.layer(layer_bound_).lower);
    sizes_.upper = static_cast<std::uint32_t>(vertices_.size());
    pass_on_vertices(vertices_);
  }

  void pass_on_vertices(std::span<const SurfaceVertex> vertices) {
    survey_.add_vertices(vertices);
    sink_.add_vertices(vertices);
  }

  /// Those of the slice below a layer and inside it; above the last layer also those there.
  void pass_on_vertices_of(std::uint32_t number) {
    const Layer& layer = sewing_.layer(number);
    vertices_.clear();
    add_slice(*layer.lower);
    for (const InnerVertex& inner : layer.tiles.inner)
      vertices_.push_back({inner.place, {inner.kind, layer.slice, Origin::none, Origin::none}});
    const bool is_last =
        sewing_.final_bound() == sewing_.layer_bound() && number + 1 == sewing_.layer_bound();
    if (is_last) add_slice(*layer.upper);
    sizes_.plain += static_cast<std::uint32_t>(vertices_.size());
    pass_on_vertices(vertices_);
  }

  void add_slice(const Region& region) {
    for (std::size_t i = 0; i < region.points.size(); ++i)
      vertices_.push_back({{region.points[i].x, region.points[i].y, region.z}, region.origins[i]});
  }

  void pass_on_faces_of(std::uint32_t number) {
    faces_.clear();
    for (std::uint32_t f = 0; f < sewing_.face_count(number); ++f) {
      faces_.push_back(face({number, 3 * f}));
      survey_.add_face(places({number, 3 * f}));
    }
    sink_.add_faces(faces_);
    sizes_.faces += faces_.size();
    const auto cuts = sewing_.cuts_of(number);
    for (std::uint32_t i = 0; i < cuts.size(); ++i) {
      const HalfEdge first{number, 3 * (sewing_.face_count(number) + i)};
      cuts_.push_back({cuts[i], face(first), places(first)});
    }
  }

  /// The corners of a face as an OpenMesh mesh lists them: the first one last.
  [[nodiscard]] static std::array<HalfEdge, 3> corners(HalfEdge first) {
    const HalfEdge second = Sewing::next(first);
    return {second, Sewing::next(second), first};
  }

  [[nodiscard]] SurfaceFace face(HalfEdge first) const {
    const auto [a, b, c] = corners(first);
    const Layer& layer = sewing_.layer(first.layer);
    return {{passed(sewing_.vertex(a)), passed(sewing_.vertex(b)), passed(sewing_.vertex(c))},
            layer.tiles.tiles[first.face()].kind,
            layer.slab};
  }

  /// The number of a vertex among those that are passed on.
  [[nodiscard]] std::uint32_t passed(std::uint32_t vertex) const {
    if ((vertex & VertexNumbers::doubled_mark) == 0) return vertex - first_vertex_;
    const bool is_midpoint =
        (vertex & VertexNumbers::midpoint_mark) == VertexNumbers::midpoint_mark;
    return vertex - (is_midpoint ? lower_.midpoints : first_doubled());
  }

  [[nodiscard]] std::array<Vec3, 3> places(HalfEdge first) const {
    const auto [a, b, c] = corners(first);
    return {sewing_.place(a), sewing_.place(b), sewing_.place(c)};
  }

  /// Those of slabs that are passed on.
  void keep_own_reports() {
    if (!options_.reports_slabs) return;
    if (window_.slab_bound < reports_.size()) reports_.resize(window_.slab_bound);
    reports_.erase(reports_.begin(),
                   reports_.begin() + static_cast<std::ptrdiff_t>(window_.first_slab));
  }

  /// A face that a midpoint cut off: it comes behind all others.
  struct Cut {
    std::uint32_t place;  // among all that are worked on
    SurfaceFace face;
    std::array<Vec3, 3> places;
  };

  [[nodiscard]] bool is_in_lower_seam(const Cut& cut) const { return cut.place < lower_seam_end_; }
  [[nodiscard]] bool is_in_upper_seam(const Cut& cut) const {
    return layer_bound_ != Origin::none && cut.place >= upper_.cuts;
  }

  const SliceSource& source_;
  const Options& options_;
  SurfaceSink& sink_;
  Window window_;
  std::size_t caps_below_;     // layers below the first slab
  std::uint32_t first_layer_;  // of those that are passed on
  std::uint32_t layer_bound_;  // and behind the last; none: all up to the top
  OneLabel one_label_;
  Regions regions_;
  std::deque<SliceShape> shapes_;  // of the regions from first_shape_ on, if they are asked for
  std::size_t first_shape_ = 0;
  Linking linking_;
  std::size_t added_bound_ = 0;    // regions below are known to it
  std::size_t tiled_bound_ = 0;    // slabs below are tiled,
  std::size_t matched_bound_ = 0;  // have their ends matched,
  std::size_t slab_bound_ = 0;     // are made
  Sewing sewing_;
  std::uint32_t passed_bound_ = 0;  // layers below are passed on
  Survey survey_;
  std::vector<Cut> cuts_;
  PartSizes sizes_;                   // so far
  std::uint32_t first_vertex_ = 0;    // that is passed on
  Sewing::Added lower_;               // before the first layer that is passed on
  Sewing::Added upper_;               // before the one above the last
  std::uint32_t lower_seam_end_ = 0;  // cuts made where the first layer is sewn on
  std::vector<Defect> repairs_;
  std::map<std::size_t, UsedPoints> used_;  // of the regions that have lines
  std::vector<Defect> unused_;              // lines
  std::vector<Defect> unlinked_;
  std::vector<SlabReport> reports_;

  // Memory that is used again.
  std::vector<cdt::Triangulation> memories_;
  std::vector<TileWorkspace> workspaces_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<SurfaceFace> faces_;
};

}  // namespace

namespace {

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
