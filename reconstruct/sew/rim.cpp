// SPDX-License-Identifier: MIT
#include "reconstruct/sew/rim.h"

#include <algorithm>
#include <utility>

namespace loft {

namespace {

/// Finds the place of a contour edge among the loop vertices of its region.
class RimIndex {
 public:
  explicit RimIndex(const Region& region) : region_(region) {
    places_.assign(region.points.size(), Origin::none);
    nexts_.resize(region.loop_vertices.size());
    others_.assign(region.loop_vertices.size(), Origin::none);
    for (std::size_t l = 0; l < region.loop_count(); ++l) {
      const auto loop = region.loop(l);
      const std::uint32_t first = region.loop_starts[l];
      for (std::uint32_t k = 0; k < loop.size(); ++k) {
        nexts_[first + k] = k + 1 == loop.size() ? first : first + k + 1;
        others_[first + k] = std::exchange(places_[loop[k]], first + k);
      }
    }
  }

  /// Of the edge between two points, from the one to the next on their loop; none for an
  /// edge across a cap.
  [[nodiscard]] std::uint32_t find(std::uint32_t from, std::uint32_t to) const {
    std::uint32_t place = places_[from];
    while (place != Origin::none && end(place) != to) place = others_[place];
    return place;
  }

 private:
  [[nodiscard]] std::uint32_t end(std::uint32_t place) const {
    return region_.loop_vertices[nexts_[place]];
  }

  const Region& region_;
  std::vector<std::uint32_t> places_;  // of each point, one among the loop vertices
  std::vector<std::uint32_t> nexts_;   // of each loop vertex, the one after it
  std::vector<std::uint32_t> others_;  // of each loop vertex, another one with the same point
};

/// Calls below(h, from, to) and above(h, from, to) for the half-edges of a layer that lie in one of
/// its slices, by the points of its region. Those are never cut, and their ends are contour points
/// even where these are doubled: so they are known by their places.
template <class Below, class Above>
void for_each_in_slices(const Sewing& sewing, std::uint32_t number, Below below, Above above) {
  const Layer& layer = sewing.layer(number);
  const auto lower_count = static_cast<std::uint32_t>(layer.lower->points.size());
  const auto contour_count = lower_count + static_cast<std::uint32_t>(layer.upper->points.size());
  for (std::uint32_t h = 0; h < 3 * sewing.face_count_with_cuts(number); ++h) {
    const auto a = sewing.contour_node({number, h});
    const auto b = sewing.contour_node({number, Sewing::next(h)});
    if (a >= contour_count || b >= contour_count || (a < lower_count) != (b < lower_count))
      continue;
    if (a < lower_count) {
      below(h, a, b);
    } else {
      above(h, a - lower_count, b - lower_count);
    }
  }
}

const Region& region_of(const RimmedSlice& slice) {
  static const Region nothing;
  return slice.region == nullptr ? nothing : *slice.region;
}

}  // namespace

RimPlaces::RimPlaces(const Sewing& sewing, std::uint32_t first, std::uint32_t last,
                     std::span<const RimmedSlice> slices, bool is_partial)
    : first_layer_(first), numbers_(last - first) {
  std::vector<RimIndex> indices;
  for (const RimmedSlice& slice : slices) indices.emplace_back(region_of(slice));
  const auto is_fine = [&](std::uint32_t count) {
    return count == 1 || (count == 0 && is_partial);
  };
  for (std::uint32_t i = 0; i < last - first; ++i) {
    std::vector<std::uint32_t> lower_counts(region_of(slices[i]).loop_vertices.size());
    std::vector<std::uint32_t> upper_counts(region_of(slices[i + 1]).loop_vertices.size());
    numbers_[i].assign(std::size_t{3} * sewing.face_count_with_cuts(first + i), Origin::none);
    const auto note = [&](std::uint32_t h, RimPlace place) {
      if (place.place == Origin::none) return;
      ++(place.is_above ? lower_counts : upper_counts)[place.place];
      numbers_[i][h] = static_cast<std::uint32_t>(places_.size());
      places_.push_back(place);
    };
    for_each_in_slices(
        sewing, first + i,
        [&](std::uint32_t h, std::uint32_t from, std::uint32_t to) {
          note(h, {i, indices[i].find(from, to), true});
        },
        [&](std::uint32_t h, std::uint32_t from, std::uint32_t to) {
          note(h, {i + 1, indices[i + 1].find(to, from), false});
        });
    if (!std::ranges::all_of(lower_counts, is_fine)) irregular_.push_back(i);
    if (!std::ranges::all_of(upper_counts, is_fine)) irregular_.push_back(i + 1);
  }
}

const RimPlace* RimPlaces::find(HalfEdge h) const {
  const std::uint32_t number = numbers_[h.layer - first_layer_][h.index];
  return number == Origin::none ? nullptr : &places_[number];
}

}  // namespace loft
