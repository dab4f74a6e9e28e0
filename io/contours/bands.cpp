// SPDX-License-Identifier: MIT
#include "io/contours/bands.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "io/contours/edge_loops.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

using Edge = std::array<std::uint32_t, 2>;

bool is_before(const cdt::Point& a, const cdt::Point& b) {
  return std::tie(a.x, a.y) < std::tie(b.x, b.y);
}

/// The edges that come an odd number of times, each from its lower vertex, in order.
std::vector<Edge> odd_ones(std::vector<Edge> edges) {
  std::ranges::sort(edges);
  std::vector<Edge> result;
  for (const Edge& edge : edges) {
    if (!result.empty() && result.back() == edge) {
      result.pop_back();
    } else {
      result.push_back(edge);
    }
  }
  return result;
}

class Bands {
 public:
  explicit Bands(const std::vector<BandRing>& rings) {
    for (const BandRing& ring : rings)
      points_.insert(points_.end(), ring.points.begin(), ring.points.end());
    std::ranges::sort(points_, is_before);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    for (const BandRing& ring : rings) add(ring);
  }

  std::vector<Slice> sum(std::string_view name) const {
    std::vector<Slice> slices;
    std::vector<Edge> outline;
    std::size_t room = 10'000 + 100 * points_.size();
    for (const auto& [z, edges] : bands_) {  // from the top
      std::vector<Edge> both = edges;
      both.insert(both.end(), outline.begin(), outline.end());
      outline = odd_ones(std::move(both));
      if (outline.size() > room)
        throw InputError(std::string(name) + ": has bands at " + std::to_string(bands_.size()) +
                         " heights, which make far more outlines than there are; do EMIN and EMAX "
                         "mean the heights between which a band is?");
      room -= outline.size();
      slices.push_back({z, loops(outline)});
    }
    std::ranges::reverse(slices);
    return slices;
  }

 private:
  void add(const BandRing& ring) {
    std::vector<Edge>& edges = bands_[ring.z];
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const std::uint32_t a = number(ring.points[i]);
      const std::uint32_t b = number(ring.points[(i + 1) % ring.points.size()]);
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }

  [[nodiscard]] std::uint32_t number(const cdt::Point& point) const {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(points_, point, is_before) -
                                      points_.begin());
  }

  [[nodiscard]] std::vector<Contour> loops(const std::vector<Edge>& edges) const {
    std::vector<Contour> contours;
    for (const auto& loop : join_edges(edges).loops) {
      Contour contour;
      for (const std::uint32_t v : loop) contour.points.push_back(points_[v]);
      contours.push_back(std::move(contour));
    }
    return contours;
  }

  std::vector<cdt::Point> points_;  // sorted, each once
  std::map<double, std::vector<Edge>, std::greater<>> bands_;
};

}  // namespace

std::vector<Slice> sum_bands(const std::vector<BandRing>& rings, std::string_view name) {
  return Bands(rings).sum(name);
}

}  // namespace loft::io
