// SPDX-License-Identifier: MIT
#include "reconstruct/fair/relax.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace loft {

namespace {

using cdt::Point;

/// More rounds than areas need that can be restored.
constexpr int most_offsets = 200;
/// Of its area, how much a loop may be off while it is still moved.
constexpr double loose_area_tolerance = 1e-4;
/// Of the size of a loop at a point, a step that shows whether that can go there.
constexpr double trial_step = 1e-3;

Point ahead(Point from, double share, Point way) {
  return {from.x + share * way.x, from.y + share * way.y};
}

/// What each neighbour of each point counts for.
std::vector<double> weights(const OutlineNet& net, const Neighbours& neighbours, bool is_even) {
  std::vector<double> found;
  found.reserve(2 * neighbours.edges().size());
  for (std::uint32_t v = 0; v < net.points.size(); ++v)
    for (const std::uint32_t n : neighbours.of(v))
      found.push_back(is_even ? 1
                              : 1 / std::hypot(net.points[n].x - net.points[v].x,
                                               net.points[n].y - net.points[v].y));
  return found;
}

/// The way from each point to the mean of its neighbours.
void find_ways(const Neighbours& neighbours, std::span<const double> weights,
               std::span<const Point> places, std::vector<Point>& ways) {
  auto weight = weights.begin();
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    Point sum;
    double all = 0;
    for (const std::uint32_t n : neighbours.of(v)) {
      sum = {sum.x + *weight * (places[n].x - places[v].x),
             sum.y + *weight * (places[n].y - places[v].y)};
      all += *weight++;
    }
    ways[v] = all > 0 ? Point{sum.x / all, sum.y / all} : Point();
  }
}

/// Offsets loops.
class Offset {
 public:
  /// `share`: of its area, how much a loop may be off.
  Offset(const OutlineNet& net, std::span<const double> areas, const Reach& reach, double share,
         std::vector<Point>& places)
      : net_(net), areas_(areas), reach_(reach), share_(share), places_(places) {}

  /// One step of each loop towards its area. Whether all had theirs before.
  bool operator()() {
    bool are_right = true;
    for (std::size_t i = 0; i < net_.loop_count(); ++i)
      if (!offset(i)) are_right = false;
    return are_right;
  }

 private:
  bool offset(std::size_t loop) {
    loop_ = net_.loop(loop);
    const double excess = signed_area(loop_, places_) - areas_[loop];
    if (std::abs(excess) <= share_ * std::abs(areas_[loop])) return true;
    const double length = find_ways(excess > 0 ? -1 : 1);
    if (length == 0) return false;
    for (std::size_t k = 0; k < loop_.size(); ++k)
      places_[loop_[k]] =
          reach_(loop_[k], ahead(places_[loop_[k]], std::abs(excess) / length, ways_[k]));
    return false;
  }

  /// The way of each point, outwards for sign 1, as much of it as it can go; how much area all of
  /// them sweep for each unit that they go.
  double find_ways(double sign) {
    const std::size_t count = loop_.size();
    ways_.assign(count, {});
    double length = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Point here = places_[loop_[k]];
      const Point before = places_[loop_[k == 0 ? count - 1 : k - 1]];
      const Point after = places_[loop_[k + 1 == count ? 0 : k + 1]];
      const Point normal{(after.y - before.y) / 2, (before.x - after.x) / 2};
      const double size = std::hypot(normal.x, normal.y);
      if (size == 0) continue;
      const Point way{sign * normal.x / size, sign * normal.y / size};
      const Point there = reach_(loop_[k], ahead(here, trial_step * size, way));
      const double share =
          ((there.x - here.x) * way.x + (there.y - here.y) * way.y) / (trial_step * size);
      ways_[k] = ahead({}, std::clamp(share, 0.0, 1.0), way);
      length += std::clamp(share, 0.0, 1.0) * size;
    }
    return length;
  }

  const OutlineNet& net_;
  std::span<const double> areas_;
  const Reach& reach_;
  double share_;
  std::vector<Point>& places_;
  std::span<const std::uint32_t> loop_;
  std::vector<Point> ways_;
};

}  // namespace

std::vector<Point> relax(const OutlineNet& net, std::vector<Point> places,
                         std::span<const double> areas, const Reach& reach, const Smoothing& how) {
  const Neighbours neighbours(net);
  const std::vector<double> weight = weights(net, neighbours, how.is_even);
  std::vector<Point> ways(places.size());
  const auto go = [&](double share) {
    find_ways(neighbours, weight, places, ways);
    for (std::uint32_t v = 0; v < places.size(); ++v)
      places[v] = reach(v, ahead(places[v], share, ways[v]));
  };
  Offset offset(net, areas, reach, loose_area_tolerance, places);
  for (unsigned round = 0; round < how.rounds; ++round) {
    go(how.step);
    if (how.back != 0) go(-how.back);
    static_cast<void>(offset());
  }
  return places;
}

bool restore_areas(const OutlineNet& net, std::span<const double> areas, const Reach& reach,
                   double share, std::vector<Point>& places) {
  Offset offset(net, areas, reach, share, places);
  for (int round = 0; round < most_offsets; ++round)
    if (offset()) return true;
  return false;
}

}  // namespace loft
