// SPDX-License-Identifier: MIT
#include "overlay/query.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <queue>

#include "cdt/each_once.h"
#include "cdt/predicates.h"
#include "overlay/cut.h"
#include "overlay/distance.h"
#include "overlay/flat_map.h"

namespace loft::overlay {

using cdt::TriangleId;
using cdt::Triangulation;

namespace {

/// Triangles from the inside out: visit(triangle) is called for each once, from that of `start`
/// across edges for which reach(edge) is at most `most`, the nearest first. Infinite triangles are
/// passed without a visit.
template <class Reach, class Visit>
void spread_out(const Triangulation& mesh, Point start, const double& most, Reach reach,
                Visit visit) {
  struct Step {
    double reach;
    TriangleId triangle;
    bool operator<(const Step& other) const { return reach > other.reach; }
  };
  const cdt::Location place = mesh.locate(start);
  if (place.kind == cdt::Location::Kind::nowhere) return;
  FlatMap seen;
  std::priority_queue<Step> front;
  front.push({0, Triangulation::triangle(place.edge)});
  while (!front.empty() && front.top().reach <= most) {
    const Step step = front.top();
    front.pop();
    if (seen.find(step.triangle.index()) != FlatMap::none) continue;
    seen.set(step.triangle.index(), 0);
    if (!mesh.is_infinite(step.triangle)) visit(step.triangle);
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(step.triangle, corner);
      const bool is_to_infinity =
          mesh.from(e) == Triangulation::infinite || mesh.to(e) == Triangulation::infinite;
      const double distance = is_to_infinity ? step.reach : std::max(step.reach, reach(e));
      if (distance <= most) front.push({distance, Triangulation::triangle(mesh.twin(e))});
    }
  }
}

template <class IsBorder>
std::optional<BorderPlace> nearest_edge(const Overlay& overlay, Point p, IsBorder is_border) {
  const Triangulation& mesh = overlay.triangulation();
  const auto place_on = [&](EdgeId e) {
    return nearest_on_segment(p, mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
  };
  std::optional<BorderPlace> best;
  double most = std::numeric_limits<double>::infinity();
  spread_out(
      mesh, p, most, [&](EdgeId e) { return distance(p, place_on(e)); },
      [&](TriangleId t) {
        for (unsigned corner = 0; corner < 3; ++corner) {
          const EdgeId e = Triangulation::edge(t, corner);
          if (!mesh.is_constrained(e) || !is_border(e)) continue;
          const Point place = place_on(e);
          if (const double here = distance(p, place); here < most) {
            best = {e, place, here};
            most = here;
          }
        }
      });
  return best;
}

std::array<Point, 3> corners_of(const Triangulation& mesh, TriangleId t) {
  const EdgeId e = Triangulation::edge(t);
  return {mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))};
}

/// A box as its corners, counter-clockwise.
std::array<Point, 4> corners_of(const cdt::Box& box) {
  return {{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}};
}

/// Whether a segment and a closed box have a point in common.
bool touches(const cdt::Box& box, Point a, Point b) {
  if (std::max(a.x, b.x) < box.low.x || std::min(a.x, b.x) > box.high.x ||
      std::max(a.y, b.y) < box.low.y || std::min(a.y, b.y) > box.high.y)
    return false;
  int left = 0;
  int right = 0;
  for (const Point corner : corners_of(box)) {
    const int side = cdt::orient(a, b, corner);
    left += side > 0 ? 1 : 0;
    right += side < 0 ? 1 : 0;
  }
  return left < 4 && right < 4;
}

/// Whether the insides of a box and a counter-clockwise triangle have a point in common: no side of
/// either has the other beyond it.
bool overlaps(const cdt::Box& box, const std::array<Point, 3>& t) {
  const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
  if (high_x <= box.low.x || low_x >= box.high.x || high_y <= box.low.y || low_y >= box.high.y)
    return false;
  const auto corners = corners_of(box);
  for (std::size_t i = 0; i < 3; ++i)
    if (std::ranges::all_of(
            corners, [&](Point corner) { return cdt::orient(t[i], t[(i + 1) % 3], corner) <= 0; }))
      return false;
  return true;
}

/// The layers of some triangles.
class LayersMet {
 public:
  explicit LayersMet(const Overlay& overlay) : overlay_(&overlay) {}

  void add(TriangleId t) { covers_.push_back(overlay_->cover(t)); }

  [[nodiscard]] std::vector<LayerId> sorted() {
    cdt::keep_each_once(covers_);
    std::vector<LayerId> result;
    for (const CoverId cover : covers_) {
      const auto layers = overlay_->layers(cover);
      result.insert(result.end(), layers.begin(), layers.end());
    }
    cdt::keep_each_once(result);
    return result;
  }

 private:
  const Overlay* overlay_;
  std::vector<CoverId> covers_;
};

}  // namespace

std::optional<BorderPlace> nearest_border(const Overlay& overlay, Point p) {
  return nearest_edge(overlay, p, [&](EdgeId e) {
    const auto [left, right] = covers_beside(overlay, e);
    return left != right && !std::ranges::equal(overlay.layers(left), overlay.layers(right));
  });
}

std::optional<BorderPlace> nearest_border(const Overlay& overlay, Point p, LayerId layer) {
  return nearest_edge(overlay, p, [&](EdgeId e) {
    const auto [left, right] = covers_beside(overlay, e);
    return std::ranges::binary_search(overlay.layers(left), layer) !=
           std::ranges::binary_search(overlay.layers(right), layer);
  });
}

std::vector<LayerId> layers_in(const Overlay& overlay, const cdt::Box& box) {
  const Triangulation& mesh = overlay.triangulation();
  LayersMet met(overlay);
  if (!(box.low.x < box.high.x && box.low.y < box.high.y)) return {};
  const Point middle{std::midpoint(box.low.x, box.high.x), std::midpoint(box.low.y, box.high.y)};
  spread_out(
      mesh, middle, 0,
      [&](EdgeId e) {
        return touches(box, mesh.point(mesh.from(e)), mesh.point(mesh.to(e))) ? 0.0 : 1.0;
      },
      [&](TriangleId t) {
        if (overlaps(box, corners_of(mesh, t))) met.add(t);
      });
  return met.sorted();
}

std::vector<LayerId> layers_near(const Overlay& overlay, Point p, double radius) {
  const Triangulation& mesh = overlay.triangulation();
  LayersMet met(overlay);
  // Less than the radius: what is as far only touches.
  const double most = std::nextafter(radius, 0.0);
  if (!(radius > 0)) return {};
  spread_out(
      mesh, p, most,
      [&](EdgeId e) {
        return distance(p, nearest_on_segment(p, mesh.point(mesh.from(e)), mesh.point(mesh.to(e))));
      },
      [&](TriangleId t) { met.add(t); });
  return met.sorted();
}

}  // namespace loft::overlay
