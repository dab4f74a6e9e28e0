// SPDX-License-Identifier: MIT
#include "reconstruct/plane/signed_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reconstruct/plane/nearest.h"

namespace loft {

namespace {

using cdt::Point;

/// The edge that is the nearest one to p. Where a corner is nearest, that of the next one around it
/// decides on which side of the boundary p is: the one that deviates least from the direction to p.
class NearestEdge {
 public:
  explicit NearestEdge(Point p) : p_(p) {}

  /// Returns the square of the distance to the nearest one so far.
  double look(const Segment& edge) {
    const auto& [from, to] = edge;
    const Point q = foot(p_, from, to);
    const double squared = (p_.x - q.x) * (p_.x - q.x) + (p_.y - q.y) * (p_.y - q.y);
    if (squared > best_) return best_;
    const Point along{to.x - from.x, to.y - from.y};
    const double across = along.x * (p_.y - q.y) - along.y * (p_.x - q.x);
    const double straight = across * across / (along.x * along.x + along.y * along.y);
    if (squared == best_ && straight <= straightness_) return best_;
    straightness_ = straight;
    nearest_ = edge;
    return best_ = squared;
  }

  [[nodiscard]] double squared_distance() const { return best_; }
  [[nodiscard]] const Segment& edge() const { return nearest_; }
  [[nodiscard]] bool is_found() const { return straightness_ >= 0; }

  [[nodiscard]] SignedDistance::Value value() const {
    const auto& [from, to] = nearest_;
    const Point q = foot(p_, from, to);
    const Point along{to.x - from.x, to.y - from.y};
    const double across = along.x * (p_.y - q.y) - along.y * (p_.x - q.x);
    const double distance = std::sqrt(best_);
    if (!(distance > 0)) {
      const double length = std::hypot(along.x, along.y);
      return {0, {along.y / length, -along.x / length}};
    }
    const double sign = across > 0 ? -1 : 1;
    return {sign * distance, {sign * (p_.x - q.x) / distance, sign * (p_.y - q.y) / distance}};
  }

 private:
  Point p_;
  double best_ = std::numeric_limits<double>::infinity();
  double straightness_ = -1;  // of the direction to p across the best edge, squared
  Segment nearest_{};
};

NearestEdge find_nearest(const SegmentTree& tree, Point p) {
  NearestEdge nearest(p);
  tree.visit_near(p, nearest.squared_distance(),
                  [&](const Segment& edge) { return nearest.look(edge); });
  return nearest;
}

/// The cosine of the angle that edges may face away from where they are asked to.
constexpr double least_facing = -0.5;

}  // namespace

SignedDistance::Value SignedDistance::at(Point p) const { return find_nearest(tree_, p).value(); }

SignedDistance::Value SignedDistance::at(Point p, Point facing) const {
  const auto does_face = [=](const Segment& edge) {
    const Point along{edge[1].x - edge[0].x, edge[1].y - edge[0].y};
    const double faces = along.y * facing.x - along.x * facing.y;
    return faces >= least_facing * std::hypot(along.x, along.y);
  };
  const NearestEdge of_all = find_nearest(tree_, p);
  if (does_face(of_all.edge())) return of_all.value();
  NearestEdge nearest(p);
  tree_.visit_some_near(p, nearest.squared_distance(), [&](const Segment& edge) {
    return does_face(edge) ? nearest.look(edge) : nearest.squared_distance();
  });
  return nearest.is_found() ? nearest.value() : of_all.value();
}

std::optional<SignedDistance::Corner> SignedDistance::corner_near(Point p, double most) const {
  double squared_distance = most * most;
  std::optional<double> squared_edge;
  tree_.visit_some_near(p, squared_distance, [&](const Segment& edge) {
    const Point along{edge[1].x - edge[0].x, edge[1].y - edge[0].y};
    const double squared_length = along.x * along.x + along.y * along.y;
    for (const Point end : edge) {
      const double squared = (end.x - p.x) * (end.x - p.x) + (end.y - p.y) * (end.y - p.y);
      if (squared > squared_distance) continue;
      const bool is_same = squared_edge && squared == squared_distance;
      squared_edge = is_same ? std::min(*squared_edge, squared_length) : squared_length;
      squared_distance = squared;
    }
    return squared_distance;
  });
  if (!squared_edge) return std::nullopt;
  return Corner{std::sqrt(squared_distance), std::sqrt(*squared_edge)};
}

}  // namespace loft
