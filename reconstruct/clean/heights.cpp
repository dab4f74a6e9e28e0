// SPDX-License-Identifier: MIT
#include "reconstruct/clean/heights.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/fair/fair_contours.h"

namespace loft {

bool are_too_near(double lower, double upper) {
  constexpr double least_gap = 0x1p-40;  // relative to the height
  return upper - lower < least_gap * std::max(std::abs(lower), std::abs(upper));
}

namespace {

void check_gaps(std::span<const Height> heights) {
  std::vector<Defect> found;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    if (are_too_near(heights[i].z, heights[i + 1].z))
      found.push_back(
          {DefectKind::slices_too_near,
           heights[i + 1].z,
           heights[i + 1].slices.front(),
           {},
           {},
           {},
           0,
           "is nearer to slice " + std::to_string(heights[i].slices.front()) +
               " than rounding allows at that height; leave one out, or give heights from "
               "an origin nearby"});
  }
  if (!found.empty()) throw InputError(std::move(found));
}

/// The largest gap that is no proper one: see find_heights(). 0 if all are.
double largest_rounding(std::span<const double> sorted, double tolerance) {
  std::vector<double> gaps;
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i)
    if (sorted[i] != sorted[i + 1]) gaps.push_back(sorted[i + 1] - sorted[i]);
  std::ranges::sort(gaps);
  const auto longest_run = [&](double largest) {
    double longest = 0;
    double start = sorted.front();
    for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
      if (sorted[i + 1] - sorted[i] > largest) start = sorted[i + 1];
      longest = std::max(longest, sorted[i + 1] - start);
    }
    return longest;
  };
  for (std::size_t i = 0; i + 1 < gaps.size(); ++i)
    if (gaps[i] <= tolerance * gaps[i + 1])
      return longest_run(gaps[i]) <= tolerance * gaps[i + 1] ? gaps[i] : 0;
  return 0;
}

}  // namespace

std::vector<Height> find_heights(std::span<const double> z, double tolerance,
                                 std::vector<Defect>& repairs) {
  std::vector<std::uint32_t> order(z.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return z[i]; });
  std::vector<double> sorted;
  for (const std::uint32_t s : order) sorted.push_back(z[s]);
  const double rounding = tolerance > 0 ? largest_rounding(sorted, tolerance) : 0;
  std::vector<Height> heights;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t s = order[i];
    if (i == 0 || sorted[i] - sorted[i - 1] > rounding) {
      heights.push_back({z[s], {s}});
      continue;
    }
    const std::string relation = heights.back().z == z[s]
                                     ? "has the same height as slice "
                                     : "is but for rounding at the height of slice ";
    repairs.push_back(
        {DefectKind::merged_slices,
         z[s],
         s,
         {},
         {},
         {},
         0,
         relation + std::to_string(heights.back().slices.front()) + "; merged into it"});
    heights.back().slices.push_back(s);
  }
  check_gaps(heights);
  return heights;
}

namespace {

Region clean(const Height& height, std::span<const ContourSource> contours, const Options& options,
             std::vector<Defect>& repairs, cdt::Triangulation& memory) {
  Region region = clean(contours, height.z,
                        {options.fill, options.keyhole_width, options.tolerance}, repairs, memory);
  region.slice = height.slices.front();
  return region;
}

}  // namespace

Region clean(const Height& height, std::span<const Slice* const> parts, const Options& options,
             std::vector<Defect>& repairs, cdt::Triangulation& memory) {
  if (options.fair) {
    std::vector<Slice> moved;
    std::vector<Slice*> changing;
    moved.reserve(parts.size());
    for (const Slice* part : parts) changing.push_back(&moved.emplace_back(*part));
    make_fair(changing, *options.fair);
    Options rest = options;
    rest.fair = {};
    return clean(height, std::vector<const Slice*>(changing.begin(), changing.end()), rest, repairs,
                 memory);
  }
  std::vector<ContourSource> contours;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& all = parts[i]->contours;
    for (std::uint32_t c = 0; c < all.size(); ++c)
      if (!options.label || all[c].label == *options.label)
        contours.push_back({all[c].points, height.slices[i], c});
  }
  return clean(height, contours, options, repairs, memory);
}

Region clean(const Height& height, std::span<const Slice> stack,
             std::span<const ContourId> contours, const Options& options,
             std::vector<Defect>& repairs, cdt::Triangulation& memory) {
  std::vector<ContourSource> found;
  for (const std::uint32_t slice : height.slices) {
    auto id = std::ranges::lower_bound(contours, slice, {}, &ContourId::slice);
    for (; id != contours.end() && id->slice == slice; ++id)
      found.push_back({stack[slice].contours[id->contour].points, slice, id->contour});
  }
  return clean(height, found, options, repairs, memory);
}

Defect empty_slice(const Region& region) {
  return {DefectKind::empty_slice,
          region.z,
          region.slice,
          {},
          {},
          {},
          0,
          "is empty: the shape ends below it and starts again above; remove the slice if it should "
          "go on"};
}

Defect unlinked_slices(const Region& lower) {
  return {DefectKind::unlinked_slices,
          lower.z,
          lower.slice,
          {},
          {},
          {},
          0,
          "no valid surface was found from here to the next slice above, whose contours nearly "
          "coincide with these; the shape is interrupted there. Make the contours equal or more "
          "different"};
}

InputError too_few_slices(const Region* only) {
  Defect defect{DefectKind::too_few_slices, 0, 0, {}, {}, {}, 0, ""};
  if (only != nullptr) {
    defect.z = only->z;
    defect.slice = only->slice;
    defect.message =
        "is the only one with an outline, and there is no other beside it; a surface needs two. "
        "For "
        "a flat part, give its outline a second time at the height where it ends; for one that "
        "ends "
        "on the way, an empty slice";
  } else {
    defect.message = "no slice has an outline with an area";
  }
  return InputError(std::vector{defect});
}

void SlabVolume::add(const Region& region) {
  const double area = loft::area(region);
  if (!is_first_) {
    const double gap = region.z - z_;
    // The first slice is as thick below as above.
    sum_ += (is_second_ ? gap : gap / 2) * area_ + gap / 2 * area;
    gap_ = gap;
  }
  is_second_ = is_first_;
  is_first_ = false;
  z_ = region.z;
  area_ = area;
}

double SlabVolume::volume() const {
  if (is_second_) return area_ * alone_;
  return sum_ + gap_ / 2 * area_;
}

Region extended(const Region& end, double half_gap) {
  Region region = end;
  region.z = end.z + half_gap;
  for (Origin& origin : region.origins)
    origin = {VertexKind::steiner, end.slice, Origin::none, Origin::none};
  region.line_vertices = {};
  region.line_starts = {};
  region.line_origins = {};
  region.points.resize(end.loop_points().size());
  region.origins.resize(region.points.size());
  return region;
}

Region beyond(const Region& end, const Region& before) {
  Region region;
  region.z = end.z + (end.z - before.z);
  region.slice = Origin::none;
  region.loop_starts = {0};
  return region;
}

}  // namespace loft
