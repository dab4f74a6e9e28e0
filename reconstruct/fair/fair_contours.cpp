// SPDX-License-Identifier: MIT
#include "reconstruct/fair/fair_contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "cdt/predicates.h"
#include "mesh/adjacency.h"
#include "mesh/admitted.h"
#include "reconstruct/fair/clearance.h"
#include "reconstruct/fair/contour_net.h"
#include "reconstruct/fair/edge_meetings.h"
#include "reconstruct/fair/relax.h"

namespace loft {

namespace {

using cdt::Point;

/// Of the area of a contour, how much it may be off.
constexpr double area_tolerance = 1e-4;
/// Where points would meet something they go half as far, this often; then they stay.
constexpr int most_halvings = 4;
/// More rounds than it takes until nothing meets any more, mostly two or three.
constexpr int most_rounds = 32;
/// Of its length, what an edge keeps at least.
constexpr double least_length = 0x1p-10;

/// Of a distance that points go all of, what is left for the rounding of coordinates.
constexpr double rounding = 1e-9;

/// Coordinates that exact arithmetic can take, those of `from` where they are not.
Point admitted(Point p, Point from) {
  return {admitted::slice.admits(p.x) ? p.x : from.x, admitted::slice.admits(p.y) ? p.y : from.y};
}

/// Chosen by jitter and stairs made of known shapes: the nearest to these.
constexpr Smoothing smoothing{.rounds = 15, .step = 0.5, .back = 0.53};

bool is_admitted(std::span<const Point> contour) {
  return std::ranges::all_of(
      contour, [](Point p) { return admitted::slice.admits(p.x) && admitted::slice.admits(p.y); });
}

/// A net on its way to being fair.
class Fairing {
 public:
  Fairing(const ContourNet& contours, double distance)
      : net_(contours.net),
        neighbours_(net_),
        edges_(neighbours_.edges()),
        components_(net_.points.size()) {
    edges_.insert(edges_.end(), contours.flat_edges.begin(), contours.flat_edges.end());
    for (const auto& [a, b] : edges_) components_.unite(a, b);
    const auto met = find_meetings(edges_, net_.points);
    for (const auto& [i, k] : met) components_.unite(edges_[i].first, edges_[k].first);
    reach_ = clearances(edges_, net_.points, components_, distance);
    halvings_.resize(net_.points.size());
    for (const auto& [a, b] : contours.flat_edges) reach_[a] = reach_[b] = 0;
    for (const auto& [i, k] : met)
      for (const std::uint32_t v : ends(i, k)) reach_[v] = 0;
    for (std::size_t i = 0; i < net_.loop_count(); ++i)
      areas_.push_back(signed_area(net_.loop(i), net_.points));
  }

  std::vector<Point> operator()() {
    places_ = relax(net_, net_.points, areas_, reach(), smoothing);
    for (int round = 0; round < most_rounds; ++round) {
      static_cast<void>(restore_areas(net_, areas_, reach(), area_tolerance / 100, places_));
      if (!separate()) break;
    }
    while (give_up()) continue;
    return places_;
  }

 private:
  [[nodiscard]] std::array<std::uint32_t, 4> ends(std::uint32_t i, std::uint32_t k) const {
    return {edges_[i].first, edges_[i].second, edges_[k].first, edges_[k].second};
  }

  [[nodiscard]] Reach reach() const {
    return [this](std::uint32_t v, Point wanted) {
      const Point from = net_.points[v];
      const double x = wanted.x - from.x;
      const double y = wanted.y - from.y;
      const double way = std::hypot(x, y);
      if (reach_[v] == 0) return from;
      if (way <= reach_[v]) return admitted(wanted, from);
      const double share = (1 - rounding) * reach_[v] / way;
      return admitted({from.x + share * x, from.y + share * y}, from);
    };
  }

  /// Points whose edges meet, or do not come in the same order round a point as they did, or have
  /// become too short.
  [[nodiscard]] std::vector<std::uint32_t> find_wrong() const {
    std::vector<std::uint32_t> wrong;
    for (const auto& [i, k] : find_meetings(edges_, places_))
      if (!do_meet(edges_[i], edges_[k], net_.points))
        for (const std::uint32_t v : ends(i, k)) wrong.push_back(v);
    const auto length = [](Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); };
    for (const auto& [a, b] : edges_)
      if (length(places_[a], places_[b]) < least_length * length(net_.points[a], net_.points[b]))
        wrong.insert(wrong.end(), {a, b});
    for (std::uint32_t v = 0; v < places_.size(); ++v) {
      const auto around = neighbours_.of(v);
      if (around.size() < 3 || order_around(v, net_.points) == order_around(v, places_)) continue;
      wrong.push_back(v);
      wrong.insert(wrong.end(), around.begin(), around.end());
    }
    std::ranges::sort(wrong);
    wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
    return wrong;
  }

  /// The neighbours of a point counter-clockwise, from the first one on.
  [[nodiscard]] std::vector<std::uint32_t> order_around(std::uint32_t v,
                                                        std::span<const Point> places) const {
    const auto around = neighbours_.of(v);
    std::vector<std::uint32_t> order(around.begin() + 1, around.end());
    const Point from = places[v];
    const Point first = places[around.front()];
    // On the left of the first one or straight on: 0, on its right: 1, behind it: between them.
    const auto half = [&](std::uint32_t n) { return cdt::orient(from, first, places[n]) < 0; };
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
      if (half(a) != half(b)) return half(b);
      return cdt::orient(from, places[a], places[b]) > 0;
    });
    return order;
  }

  /// Lets points go less far that would meet something. Whether there were any.
  bool separate() {
    const std::vector<std::uint32_t> wrong = find_wrong();
    bool is_changed = false;
    for (const std::uint32_t v : wrong) {
      if (reach_[v] == 0) continue;
      is_changed = true;
      const Point from = net_.points[v];
      if (++halvings_[v] > most_halvings) {
        reach_[v] = 0;
        places_[v] = from;
        continue;
      }
      places_[v] = admitted({(from.x + places_[v].x) / 2, (from.y + places_[v].y) / 2}, from);
      reach_[v] = std::hypot(places_[v].x - from.x, places_[v].y - from.y);
    }
    return is_changed;
  }

  /// Puts contours back to where they were whose area was lost, or that still meet something, with
  /// all that they touch. Whether there were any.
  bool give_up() {
    std::vector<std::uint32_t> lost = find_wrong();
    for (std::size_t i = 0; i < net_.loop_count(); ++i)
      if (std::abs(signed_area(net_.loop(i), places_) - areas_[i]) >
          area_tolerance / 2 * std::abs(areas_[i]))
        lost.push_back(net_.loop(i).front());
    std::vector<bool> is_lost(places_.size());
    for (const std::uint32_t v : lost) is_lost[components_.find(v)] = true;
    bool is_changed = false;
    for (std::uint32_t v = 0; v < places_.size(); ++v) {
      if (!is_lost[components_.find(v)] || places_[v] == net_.points[v]) continue;
      places_[v] = net_.points[v];
      is_changed = true;
    }
    return is_changed;
  }

  const OutlineNet& net_;
  Neighbours neighbours_;
  std::vector<NetEdge> edges_;  // those of loops, and of contours that enclose nothing
  DisjointSets components_;
  std::vector<double> reach_;
  std::vector<int> halvings_;
  std::vector<double> areas_;
  std::vector<Point> places_;
};

}  // namespace

std::vector<std::vector<Point>> fair(std::span<const std::span<const Point>> contours,
                                     double distance) {
  std::vector<std::span<const Point>> usable;
  for (const auto contour : contours)
    if (is_admitted(contour)) usable.push_back(contour);
  const ContourNet net = make_net(usable);
  std::vector<Point> places = net.net.points;
  if (distance > 0 && net.net.loop_count() > 0) places = Fairing(net, distance)();
  std::vector<std::vector<Point>> result;
  auto numbers = net.numbers.begin();
  for (const auto contour : contours) {
    std::vector<Point>& points = result.emplace_back(contour.begin(), contour.end());
    if (!is_admitted(contour)) continue;
    for (std::size_t p = 0; p < points.size(); ++p) points[p] = places[(*numbers)[p]];
    ++numbers;
  }
  return result;
}

void make_fair(std::span<Slice* const> parts, double distance) {
  std::vector<std::span<const Point>> contours;
  for (const Slice* part : parts)
    for (const Contour& contour : part->contours) contours.emplace_back(contour.points);
  std::vector<std::vector<Point>> moved = fair(contours, distance);
  auto next = moved.begin();
  for (Slice* part : parts)
    for (Contour& contour : part->contours) contour.points = std::move(*next++);
}

}  // namespace loft
