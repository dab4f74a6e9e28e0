// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
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
  Regions(Cap cap, std::optional<double> gap) : cap_(cap), gap_(gap), volume_(gap.value_or(0)) {}

  void add(Region region) {
    count_volume(region);
    if (region.is_empty()) {
      if (!has_filled_ && cap_ == Cap::extend) return;
      if (!has_filled_) empty_.clear();  // only the nearest one counts
      empty_.push_back(std::move(region));
      return;
    }
    for (Region& empty : std::exchange(empty_, {})) {
      if (has_filled_) repairs_.push_back(empty_slice(empty));
      append(std::move(empty));
    }
    has_filled_ = true;
    has_loops_ = has_loops_ || region.has_loops();
    append(std::move(region));
  }

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
  bool has_low_end_ = false;
  std::deque<Region> regions_;
  std::size_t first_ = 0;
  bool has_filled_ = false;
  bool has_loops_ = false;
  std::vector<Region> empty_;  // above the last filled one
  std::vector<Defect> repairs_;
};

/// The lines from heights to faces, group by group.
class GroupByGroup {
 public:
  GroupByGroup(const SliceSource& source, const Options& options, SurfaceSink& sink)
      : source_(source),
        options_(options),
        sink_(sink),
        one_label_(options.label),
        regions_(options.cap, options.gap),
        linking_(options),
        memories_(thread_count(options.threads)),
        workspaces_(thread_count(options.threads)) {}

  OutOfCoreReport run(const Progress& progress) {
    const std::vector<double> z = usable_heights();
    const std::vector<Height> heights = find_heights(z, options_.height_tolerance, repairs_);
    const auto tell = [&](std::size_t done) {
      const double share =
          heights.empty() ? 1 : static_cast<double>(done) / static_cast<double>(heights.size());
      if (progress && !progress(Stage::tile, share)) throw Cancelled();
    };
    tell(0);
    for (std::size_t done = 0; done < heights.size();) {
      const auto group = next_group(std::span(heights).subspan(done));
      for (Region& region : clean_group(group)) regions_.add(std::move(region));
      make_slabs(false);
      done += group.size();
      tell(done);
    }
    regions_.end();
    make_slabs(true);
    finish();
    return report();
  }

 private:
  [[nodiscard]] std::vector<double> usable_heights() const {
    std::vector<double> z;
    std::vector<Defect> fatal;
    for (const SliceSource::Entry& slice : source_.slices) {
      const auto index = static_cast<std::uint32_t>(z.size());
      std::ranges::move(find_unusable({slice.z, {}}, index), std::back_inserter(fatal));
      z.push_back(slice.z);
    }
    if (!fatal.empty()) throw InputError(std::move(fatal));
    return z;
  }

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
      std::vector<Slice> slices;
      std::vector<const Slice*> parts;
      slices.reserve(heights[i].slices.size());
      for (const std::uint32_t s : heights[i].slices) {
        slices.push_back(source_.read(s));
        if (auto fatal = find_unusable(slices.back(), s); !fatal.empty())
          throw InputError(std::move(fatal));
        parts.push_back(&slices.back());
        if (!options_.label)
          for (const Contour& contour : slices.back().contours) labels[i].insert(contour.label);
      }
      cleaned[i] = clean(heights[i], parts, options_, found[i], memories_[worker]);
    });
    for (const auto& some : labels)
      for (const std::string& label : some) one_label_.add(label);
    for (auto& some : found) std::ranges::move(some, std::back_inserter(repairs_));
    return cleaned;
  }

  [[nodiscard]] bool has_flat_caps() const {
    return options_.cap == Cap::flat || options_.cap == Cap::extend;
  }

  /// Takes every slab as far as the regions that are known allow.
  void make_slabs(bool is_end) {
    add_shapes();
    if (regions_.bound() < 2) return;  // from the second on the first one stays
    for (; added_bound_ < regions_.bound(); ++added_bound_) linking_.add(regions_[added_bound_]);
    const std::size_t tiled = std::exchange(tiled_bound_, linking_.slab_bound());
    for_each_index(tiled_bound_ - tiled, options_.threads, [&](std::size_t i, unsigned worker) {
      linking_.tile(tiled + i, workspaces_[worker]);
    });
    // Each of the following steps looks at what the one before made of the next slab.
    const std::size_t behind = is_end ? 0 : 1;
    const std::size_t matched = std::exchange(matched_bound_, tiled_bound_ - behind);
    for_each_index(matched_bound_ - matched, options_.threads,
                   [&](std::size_t i, unsigned) { linking_.match(matched + i); });
    if (matched_bound_ < slab_bound_ + behind + (is_end ? 0 : 1)) return;
    const std::size_t first = std::exchange(slab_bound_, matched_bound_ - behind);
    std::vector<TileSet> slabs(slab_bound_ - first);
    if (options_.reports_slabs) reports_.resize(slab_bound_);
    for_each_index(slabs.size(), options_.threads,
                   [&](std::size_t i, unsigned) { slabs[i] = make_slab(first + i); });
    settle_lines(first, slabs);
    linking_.drop_below(slab_bound_ == 0 ? 0 : slab_bound_ - 1);

    std::vector<Layer> layers;
    if (first == 0 && has_flat_caps()) layers.push_back(bottom_cap(sewn_region(0)));
    for (std::size_t i = 0; i < slabs.size(); ++i) {
      const Region& lower = sewn_region(first + i);
      const Region& upper = sewn_region(first + i + 1);
      if (!slabs[i].is_linked) unlinked_.push_back(unlinked_slices(lower));
      layers.push_back({&lower, &upper, std::move(slabs[i]), static_cast<std::uint32_t>(first + i),
                        lower.slice});
    }
    sewing_.add(std::move(layers), options_.threads);
    pass_on();
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
      tiles = smooth(regions_[i], regions_[i + 1], around, linking_.pieces(i), std::move(tiles));
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
    if (has_flat_caps()) {
      const std::size_t last = slab_bound_ - 1;
      std::vector<Layer> cap;
      cap.push_back(
          top_cap(sewn_region(last + 1), static_cast<std::uint32_t>(last), regions_[last].slice));
      sewing_.add(std::move(cap), options_.threads);
    }
    sewing_.finish(options_.threads);
    pass_on();
    pass_on_vertices(sewing_.doubled());
    pass_on_vertices(sewing_.midpoints());
    for (const Cut& cut : cuts_) survey_.add_face(cut.places);
    std::vector<SurfaceFace> faces;
    for (const Cut& cut : cuts_) faces.push_back(cut.face);
    sink_.add_faces(faces);
    sink_.end(sewing_.numbers());
  }

  /// Passes on the layers that have become final, and forgets what nobody needs any more.
  void pass_on() {
    for (; passed_bound_ < sewing_.final_bound(); ++passed_bound_) {
      pass_on_vertices_of(passed_bound_);
      pass_on_faces_of(passed_bound_);
      survey_.connect(sewing_, passed_bound_);
    }
    sewing_.drop_below(passed_bound_);
    // Layers begin with the cap; a slab looks at the slice before its own.
    const std::size_t cap = has_flat_caps() ? 1 : 0;
    const std::size_t sewn = passed_bound_ - std::min<std::size_t>(cap, passed_bound_);
    const std::size_t needed = std::min(sewn, slab_bound_ - std::min<std::size_t>(1, slab_bound_));
    regions_.drop_below(needed);
    used_.erase(used_.begin(), used_.lower_bound(needed));
    for (; options_.smooth && first_shape_ < needed; ++first_shape_) shapes_.pop_front();
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
    const auto cuts = sewing_.cuts_of(number);
    for (std::uint32_t i = 0; i < cuts.size(); ++i) {
      const HalfEdge first{number, 3 * (sewing_.face_count(number) + i)};
      cuts_.resize(std::max<std::size_t>(cuts_.size(), cuts[i] + 1));
      cuts_[cuts[i]] = {face(first), places(first)};
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
    return {{sewing_.vertex(a), sewing_.vertex(b), sewing_.vertex(c)},
            layer.tiles.tiles[first.face()].kind,
            layer.slab};
  }

  [[nodiscard]] std::array<Vec3, 3> places(HalfEdge first) const {
    const auto [a, b, c] = corners(first);
    return {sewing_.place(a), sewing_.place(b), sewing_.place(c)};
  }

  [[nodiscard]] OutOfCoreReport report() {
    std::vector<Defect> repairs = std::move(repairs_);
    std::ranges::copy(regions_.repairs(), std::back_inserter(repairs));
    std::ranges::move(unused_, std::back_inserter(repairs));
    std::ranges::move(unlinked_, std::back_inserter(repairs));
    std::ranges::stable_sort(repairs, {}, &Defect::z);
    return {std::move(repairs), std::move(reports_), survey_.measures(), survey_.vertices_of_kind(),
            regions_.slab_volume()};
  }

  /// A face that a midpoint cut off: it comes behind all others.
  struct Cut {
    SurfaceFace face;
    std::array<Vec3, 3> places;
  };

  const SliceSource& source_;
  const Options& options_;
  SurfaceSink& sink_;
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

OutOfCoreReport reconstruct_out_of_core(const SliceSource& source, const Options& options,
                                        SurfaceSink& sink, const Progress& progress) {
  if (options.simplify || !options.links.empty())
    throw std::invalid_argument("simplify and links need the whole stack");
  require_usable(options);
  return GroupByGroup(source, options, sink).run(progress);
}

}  // namespace loft
