// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>

#include "reconstruct/linking.h"
#include "reconstruct/region.h"
#include "reconstruct/sew.h"
#include "reconstruct/tiles.h"

namespace loft {

namespace {

/// All contours at one height.
struct Layer {
  double z;
  std::uint32_t slice;  // the first of the input's slices at this height
  std::vector<ContourSource> contours;
};

using cdt::Triangulation;

std::vector<Defect> find_not_finite(std::span<const Slice> slices) {
  std::vector<Defect> found;
  for (std::uint32_t s = 0; s < slices.size(); ++s) {
    const Slice& slice = slices[s];
    if (!(std::abs(slice.z) <= Triangulation::largest_coordinate))
      found.push_back(
          {DefectKind::not_finite,
           slice.z,
           s,
           {},
           {},
           {},
           0,
           "the height is not a finite number below 1e75; correct it or leave the slice out"});
    for (std::uint32_t c = 0; c < slice.contours.size(); ++c) {
      const auto& points = slice.contours[c].points;
      for (std::uint32_t p = 0; p < points.size(); ++p)
        if (!Triangulation::is_usable(points[p].x) || !Triangulation::is_usable(points[p].y))
          found.push_back(
              {DefectKind::not_finite,
               slice.z,
               s,
               c,
               p,
               {},
               0,
               "a coordinate is not finite, beyond 1e75, or below 1e-50 without being 0; "
               "correct the point or leave it out"});
    }
  }
  return found;
}

/// The slices by height, those of equal height as one.
std::vector<Layer> find_layers(std::span<const Slice> slices,
                               const std::optional<std::string>& label,
                               std::vector<Defect>& repairs) {
  std::vector<std::uint32_t> order(slices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return slices[i].z; });
  std::vector<Layer> layers;
  for (const std::uint32_t s : order) {
    const Slice& slice = slices[s];
    if (layers.empty() || layers.back().z != slice.z) {
      layers.push_back({slice.z, s, {}});
    } else {
      repairs.push_back({DefectKind::merged_slices,
                         slice.z,
                         s,
                         {},
                         {},
                         {},
                         0,
                         "has the same height as slice " + std::to_string(layers.back().slice) +
                             "; merged into it"});
    }
    for (std::uint32_t c = 0; c < slice.contours.size(); ++c)
      if (!label || slice.contours[c].label == *label)
        layers.back().contours.push_back({slice.contours[c].points, s, c});
  }
  return layers;
}

/// Between slices there must be room for heights that are different numbers.
void check_gaps(std::span<const Layer> layers) {
  constexpr double least_gap = 0x1p-40;  // relative to the height
  std::vector<Defect> found;
  for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
    const double height = std::max(std::abs(layers[i].z), std::abs(layers[i + 1].z));
    if (layers[i + 1].z - layers[i].z < least_gap * height)
      found.push_back(
          {DefectKind::slices_too_near,
           layers[i + 1].z,
           layers[i + 1].slice,
           {},
           {},
           {},
           0,
           "is nearer to slice " + std::to_string(layers[i].slice) +
               " than rounding allows at that height; leave one out, or give heights from "
               "an origin nearby"});
  }
  if (!found.empty()) throw InputError(std::move(found));
}

/// Leaves out the empty regions at both ends; those between are where the shape is interrupted.
std::vector<Region> trim(std::vector<Region> regions, std::vector<Defect>& repairs) {
  const auto is_filled = [](const Region& region) { return !region.is_empty(); };
  const auto first = std::ranges::find_if(regions, is_filled);
  const auto last = std::find_if(regions.rbegin(), regions.rend(), is_filled).base();
  if (first >= last) return {};
  std::vector<Region> kept(std::make_move_iterator(first), std::make_move_iterator(last));
  for (const Region& region : kept)
    if (region.is_empty())
      repairs.push_back({DefectKind::empty_slice,
                         region.z,
                         region.slice,
                         {},
                         {},
                         {},
                         0,
                         "is empty: the shape ends below it and starts again above; remove the "
                         "slice if it should go on"});
  return kept;
}

/// For Cap::dome: an empty slice one gap beyond each end, into which the shape rounds off.
void add_beyond_ends(std::vector<Region>& regions) {
  const auto beyond = [](const Region& end, const Region& before) {
    Region region;
    region.z = end.z + (end.z - before.z);
    region.slice = Origin::none;
    region.loop_starts = {0};
    return region;
  };
  const Region low = beyond(regions[0], regions[1]);
  const Region high = beyond(regions[regions.size() - 1], regions[regions.size() - 2]);
  regions.insert(regions.begin(), low);
  regions.push_back(high);
}

/// Names the slabs that no valid tiles were found for.
void report_unlinked(std::span<const Region> regions, std::span<const TileSet> slabs,
                     std::vector<Defect>& repairs) {
  for (std::size_t i = 0; i < slabs.size(); ++i)
    if (!slabs[i].is_linked)
      repairs.push_back(
          {DefectKind::unlinked_slices,
           regions[i].z,
           regions[i].slice,
           {},
           {},
           {},
           0,
           "no valid surface was found from here to slice " + std::to_string(regions[i + 1].slice) +
               ", whose contours nearly coincide with these; the shape is interrupted "
               "there. Make the contours equal or more different"});
}

std::string in_lines(std::span<const std::string> problems) {
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
  return text;
}

class Reporter {
 public:
  Reporter(const Progress& progress, Stage stage, std::size_t steps)
      : progress_(progress), stage_(stage), steps_(steps) {
    report(0);
  }
  void report(std::size_t done) const {
    const double fraction =
        steps_ == 0 ? 1 : static_cast<double>(done) / static_cast<double>(steps_);
    if (progress_ && !progress_(stage_, fraction)) throw Cancelled();
  }

 private:
  const Progress& progress_;
  Stage stage_;
  std::size_t steps_;
};

std::vector<Region> clean_all(const std::vector<Layer>& layers, Fill fill,
                              std::vector<Defect>& repairs, const Progress& progress) {
  const Reporter reporter(progress, Stage::clean, layers.size());
  std::vector<Region> regions;
  for (const Layer& layer : layers) {
    regions.push_back(clean(layer.contours, layer.z, fill, repairs));
    regions.back().slice = layer.slice;
    reporter.report(regions.size());
  }
  return regions;
}

void tile_all(Linking& linking, const Progress& progress) {
  const Reporter reporter(progress, Stage::tile, linking.slab_count());
  for (std::size_t i = 0; i < linking.slab_count(); ++i) {
    linking.tile(i);
    reporter.report(i + 1);
  }
  for (std::size_t i = 0; i < linking.slab_count(); ++i) linking.match(i);
  for (std::size_t i = 0; i < linking.slab_count(); ++i) linking.link(i);
}

void report_refused(std::span<const Slice> slices, std::span<const LinkOrder> orders,
                    const Linking& linking, std::vector<Defect>& repairs) {
  for (const Refusal& refusal : linking.refusals()) {
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

void check_enough(std::span<const Region> regions) {
  const auto filled =
      std::ranges::count_if(regions, [](const Region& region) { return !region.is_empty(); });
  if (filled >= 2) return;
  Defect defect{DefectKind::too_few_slices, 0, 0, {}, {}, {}, 0, ""};
  if (filled == 1) {
    const auto only =
        std::ranges::find_if(regions, [](const Region& region) { return !region.is_empty(); });
    defect.z = only->z;
    defect.slice = only->slice;
    defect.message =
        "is the only one with an outline; a surface needs two. For a flat part, give its outline a "
        "second time at the height where it ends";
  } else {
    defect.message = "no slice has an outline with an area";
  }
  throw InputError({defect});
}

}  // namespace

Reconstruction reconstruct(std::span<const Slice> slices, const Options& all_options,
                           const Progress& progress) {
  if (auto fatal = find_not_finite(slices); !fatal.empty()) throw InputError(std::move(fatal));
  if (const auto problems = find_bad_orders(slices, all_options.links); !problems.empty())
    throw InputError(in_lines(problems));
  Options options = all_options;
  options.links = orders_for(options.label, slices, options.links);
  Reconstruction result;
  const auto layers = find_layers(slices, options.label, result.repairs);
  check_gaps(layers);
  auto regions = trim(clean_all(layers, options.fill, result.repairs, progress), result.repairs);
  check_enough(regions);
  if (options.cap == Cap::dome) add_beyond_ends(regions);
  Linking linking(regions, options);
  tile_all(linking, progress);
  const std::vector<TileSet>& slabs = linking.tiles();
  report_unlinked(regions, slabs, result.repairs);
  report_refused(slices, options.links, linking, result.repairs);
  if (options.reports_slabs) result.slabs = report_slabs(regions, slabs, linking.pieces());
  const Reporter sewing(progress, Stage::sew, 1);
  result.surface = sew(regions, slabs, options.cap);
  sewing.report(1);
  std::ranges::stable_sort(result.repairs, {}, &Defect::z);
  return result;
}

std::vector<std::string> labels(std::span<const Slice> slices) {
  std::set<std::string> found;
  for (const Slice& slice : slices)
    for (const Contour& contour : slice.contours) found.insert(contour.label);
  return {found.begin(), found.end()};
}

}  // namespace loft
