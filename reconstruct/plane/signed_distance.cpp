// SPDX-License-Identifier: MIT
#include "reconstruct/plane/signed_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "reconstruct/plane/nearest.h"

namespace loft {

namespace {

using cdt::Point;

/// Places whose squares of distances differ by less, as a share of them, are equally near: they
/// differ by rounding.
constexpr double equal_share = 1e-6;

/// Where equally near places are further apart than that share of their distance, they are several.
constexpr double least_apart = 1e-4;

/// Of equally near places so many are told apart; among more there is no direction.
constexpr std::size_t most_feet = 16;

/// The edge that is the nearest one to p. Where a corner is nearest, that of the next one around it
/// decides on which side of the boundary p is: the one that deviates least from the direction to p.
class NearestEdge {
 public:
  explicit NearestEdge(Point p) : p_(p) {}

  /// Returns the square of the distance within which edges count.
  double look(const Segment& edge) {
    const auto& [from, to] = edge;
    const Point q = foot(p_, from, to);
    const double squared = (p_.x - q.x) * (p_.x - q.x) + (p_.y - q.y) * (p_.y - q.y);
    if (squared > bound()) return bound();
    note_foot(q, squared);
    if (squared > best_) return bound();
    const Point along{to.x - from.x, to.y - from.y};
    const double across = along.x * (p_.y - q.y) - along.y * (p_.x - q.x);
    const double straight = across * across / (along.x * along.x + along.y * along.y);
    if (squared == best_ && straight <= straightness_) return bound();
    straightness_ = straight;
    nearest_ = edge;
    best_ = squared;
    return bound();
  }

  [[nodiscard]] double bound() const { return best_ * (1 + equal_share); }
  [[nodiscard]] bool is_found() const { return straightness_ >= 0; }

  [[nodiscard]] SignedDistance::Value value() const {
    const auto& [from, to] = nearest_;
    const Point q = foot(p_, from, to);
    const Point along{to.x - from.x, to.y - from.y};
    const double across = along.x * (p_.y - q.y) - along.y * (p_.x - q.x);
    const double distance = std::sqrt(best_);
    if (!(distance > 0)) {
      const double length = std::hypot(along.x, along.y);
      return {0, {along.y / length, -along.x / length}, q};
    }
    const double sign = across > 0 ? -1 : 1;
    const Point way = feet_count_ == 1 ? Point{p_.x - q.x, p_.y - q.y} : mean_way();
    return {sign * distance, {sign * way.x / distance, sign * way.y / distance}, q};
  }

 private:
  void note_foot(Point q, double squared) {
    if (squared * (1 + equal_share) < best_) feet_count_ = 0;
    for (std::size_t i = 0; i < std::min(feet_count_, most_feet); ++i)
      if (std::hypot(q.x - feet_[i].x, q.y - feet_[i].y) <= least_apart * std::sqrt(squared))
        return;
    if (feet_count_ < most_feet) feet_[feet_count_] = q;
    ++feet_count_;
  }

  /// From the equally near places; 0 if there are too many.
  [[nodiscard]] Point mean_way() const {
    if (feet_count_ > most_feet) return {};
    Point sum{};
    for (std::size_t i = 0; i < feet_count_; ++i)
      sum = {sum.x + p_.x - feet_[i].x, sum.y + p_.y - feet_[i].y};
    const auto count = static_cast<double>(feet_count_);
    return {sum.x / count, sum.y / count};
  }

  Point p_;
  double best_ = std::numeric_limits<double>::infinity();
  double straightness_ = -1;  // of the direction to p across the best edge, squared
  Segment nearest_{};
  std::array<Point, most_feet> feet_;  // the places that are equally near
  std::size_t feet_count_ = 0;
};

NearestEdge find_nearest(const SegmentTree& tree, Point p) {
  NearestEdge nearest(p);
  tree.visit_near(p, nearest.bound(), [&](const Segment& edge) { return nearest.look(edge); });
  return nearest;
}

/// The cosine of the angle that edges may face away from where they are asked to: not quite 120
/// degrees, which edges of regular polygons have between them, so that rounding would choose.
constexpr double least_facing = -0.499;

}  // namespace

SignedDistance::Value SignedDistance::at(Point p) const { return find_nearest(tree_, p).value(); }

SignedDistance::Value SignedDistance::at(Point p, Point facing) const {
  if (facing.x == 0 && facing.y == 0) return at(p);
  const auto does_face = [=](const Segment& edge) {
    const Point along{edge[1].x - edge[0].x, edge[1].y - edge[0].y};
    const double faces = along.y * facing.x - along.x * facing.y;
    return faces >= 0 ||
           faces * faces <= least_facing * least_facing * (along.x * along.x + along.y * along.y);
  };
  NearestEdge nearest(p);
  tree_.visit_some_near(p, nearest.bound(), [&](const Segment& edge) {
    return does_face(edge) ? nearest.look(edge) : nearest.bound();
  });
  return nearest.is_found() ? nearest.value() : at(p);
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
