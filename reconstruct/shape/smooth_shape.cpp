// SPDX-License-Identifier: MIT
#include "reconstruct/shape/smooth_shape.h"

#include <algorithm>
#include <cmath>

namespace loft {

namespace {

using cdt::Point;

/// A tangent may differ from the chord of the slab by that, as a slope and as a share of it: more
/// comes from slices that show something else.
constexpr double most_turn = 1.5;

/// A tangent is believed over that many gaps of the one beside the slab; over a higher slab it
/// turns away from the chord by so much less.
constexpr double most_reach = 5;

/// At the end of the stack, where the slab is continued as a circle: that share of the turn at its
/// other end. All of it overshoots where shapes end flat.
constexpr double end_turn = 0.75;

/// No tangent is flatter than that, in radians.
constexpr double steepest = 1.5;

/// Bounds of the heights of ends, as shares of the slab: where the slice before tells a trend;
/// where it tells that the part is new (see SheetHeights for the reason); at the end of the stack,
/// where nothing is known.
struct Bounds {
  double lowest;
  double highest;
};
constexpr Bounds with_trend{0.1, 0.95};
constexpr Bounds single{0.7, 0.75};
constexpr Bounds unknown{0.5, 0.5};

/// A trend that leads beyond the next slice, in which the part is not, is the less believed the
/// further it does: that share of the slab beyond, the part ends as high as one that is new.
constexpr double most_beyond = 0.25;

/// How high an end may be, as a share of the slab, where its trend leads to that height.
double highest_by_trend(double height) {
  const double doubt = std::clamp((height - 1) / most_beyond, 0.0, 1.0);
  return with_trend.highest - doubt * (with_trend.highest - single.highest);
}

/// The steepest trend of an end, in depths: beyond, its shape hardly changes, but all that is left
/// of its height is rounding.
constexpr double most_trend = 1024;

/// Ways to the boundary along a line are found that near, in depths, in so many steps at most.
constexpr double nearness_of_way = 0.005;
constexpr int steps_of_way = 20;

/// From one slice to the next at one place: how the distance changes with z.
struct Chord {
  double angle;
  double length;

  Chord(double gap, double change)
      : angle(std::atan2(change, gap)), length(std::hypot(gap, change)) {}
};

/// The share of the second chord in the direction of the circle through both at their common point.
double share_of_second(const Chord& first, const Chord& second) {
  return first.length / (first.length + second.length);
}

/// How deep the middle of an end, `depth` deep in its own slice, would be in the slice before if
/// that were not hollow there: by how far the outline before is around its own, on both sides.
/// Negative if it is not.
double depth_around(const SliceShape& before, const SliceShape& slice, bool is_solid, Point middle,
                    double depth) {
  const SignedDistance::Value nearest = slice.distance.at(middle);
  if (nearest.distance == 0) return -1;
  const auto way_from_foot = [&](const SignedDistance::Value& value) {
    return Point{(middle.x - value.foot.x) / value.distance,
                 (middle.y - value.foot.y) / value.distance};
  };
  const Point outward = way_from_foot(nearest);
  double sum = 0;
  for (const double side : {1.0, -1.0}) {
    const auto there = slice.distance.at(middle, {side * outward.x, side * outward.y});
    const double around = before.depth(is_solid, there.foot, way_from_foot(there));
    if (around < 0) return -1;
    sum += around;
  }
  return depth + sum / 2;
}

}  // namespace

SmoothPassage::SmoothPassage(const Surroundings& slices, Point shift)
    : slices_(slices), shift_(shift) {
  for (const SliceShape*& slice : slices_)
    if (slice != nullptr && slice->distance.is_empty()) slice = nullptr;
}

std::array<SmoothPassage::Tangent, 2> SmoothPassage::tangents(const Weights& distances) const {
  const double gap = z(2) - z(1);
  const Chord chord(gap, distances[2] - distances[1]);
  std::array<double, 2> angles{chord.angle, chord.angle};
  std::array<Tangent, 2> tangents{};
  std::array<double, 2> shares{1, 1};  // of the slab's own chord in each tangent
  if (has(0)) {
    const double gap_below = z(1) - z(0);
    const Chord below(gap_below, distances[1] - distances[0]);
    const double belief = std::min(1.0, most_reach * gap_below / gap);
    shares[0] = 1 - belief * (1 - share_of_second(below, chord));
    angles[0] = shares[0] * chord.angle + (1 - shares[0]) * below.angle;
    tangents[0].weights[0] -= (1 - shares[0]) / gap_below;
    tangents[0].weights[1] += (1 - shares[0]) / gap_below;
  }
  if (has(3)) {
    const double gap_above = z(3) - z(2);
    const Chord above(gap_above, distances[3] - distances[2]);
    const double belief = std::min(1.0, most_reach * gap_above / gap);
    shares[1] = 1 - belief * share_of_second(chord, above);
    angles[1] = shares[1] * chord.angle + (1 - shares[1]) * above.angle;
    tangents[1].weights[2] -= (1 - shares[1]) / gap_above;
    tangents[1].weights[3] += (1 - shares[1]) / gap_above;
  }
  if (!has(0)) angles[0] += end_turn * (chord.angle - angles[1]);
  if (!has(3)) angles[1] += end_turn * (chord.angle - angles[0]);

  const double slope = (distances[2] - distances[1]) / gap;
  const double turn = most_turn * std::max(1.0, std::abs(slope));
  for (std::size_t i = 0; i < 2; ++i) {
    tangents[i].slope = std::clamp(std::tan(std::clamp(angles[i], -steepest, steepest)),
                                   slope - turn, slope + turn);
    tangents[i].weights[1] -= shares[i] / gap;
    tangents[i].weights[2] += shares[i] / gap;
  }
  return tangents;
}

SmoothPassage::Distances SmoothPassage::distances(const Vec3& p, Point facing, std::size_t first,
                                                  std::size_t last) const {
  Distances found;
  for (std::size_t i = first; i <= last; ++i) {
    if (!has(i)) continue;
    const double share = (z(i) - p[2]) / (z(2) - z(1));
    const auto [distance, outward, foot] =
        slices_[i]->distance.at({p[0] + share * shift_.x, p[1] + share * shift_.y}, facing);
    found.values[i] = distance;
    found.outward[i] = outward;
  }
  return found;
}

Sample SmoothPassage::sample(double value, double rise, const Weights& weights,
                             const Distances& distances) const {
  Sample sample{value, {0, 0, rise}};
  for (std::size_t i = 0; i < 4; ++i) {
    sample.gradient[0] += weights[i] * distances.outward[i].x;
    sample.gradient[1] += weights[i] * distances.outward[i].y;
  }
  sample.gradient[2] -=
      (shift_.x * sample.gradient[0] + shift_.y * sample.gradient[1]) / (z(2) - z(1));
  return sample;
}

Sample SmoothPassage::at(const Vec3& p, Point facing) const {
  const Distances found = distances(p, facing, 0, 3);
  const Weights& values = found.values;
  const auto [lower, upper] = tangents(values);

  // The cubic's basis (Hermite), and its derivatives by z.
  const double gap = z(2) - z(1);
  const double t = (p[2] - z(1)) / gap;
  const double u = 1 - t;
  const double from_upper = t * t * (3 - 2 * t);
  const double from_lower = 1 - from_upper;
  const double lower_tangent = t * u * u * gap;
  const double upper_tangent = -t * t * u * gap;
  const double rise = 6 * t * u / gap;
  const double lower_rise = u * (1 - 3 * t);
  const double upper_rise = t * (3 * t - 2);

  Weights weights{0, from_lower, from_upper, 0};
  for (std::size_t i = 0; i < 4; ++i)
    weights[i] += lower_tangent * lower.weights[i] + upper_tangent * upper.weights[i];
  return sample(
      from_lower * values[1] + from_upper * values[2] + lower_tangent * lower.slope +
          upper_tangent * upper.slope,
      rise * (values[2] - values[1]) + lower_rise * lower.slope + upper_rise * upper.slope, weights,
      found);
}

Sample SmoothPassage::even_at(const Vec3& p, Point facing) const {
  const Distances found = distances(p, facing, 1, 2);
  const double gap = z(2) - z(1);
  const double t = (p[2] - z(1)) / gap;
  return sample((1 - t) * found.values[1] + t * found.values[2],
                (found.values[2] - found.values[1]) / gap, {0, 1 - t, t, 0}, found);
}

SmoothEnd::SmoothEnd(const Surroundings& slices, std::size_t slice, Point middle, double depth,
                     Point across, Point lean)
    : slice_(slices[slice]),
      is_solid_(slice_->distance.at(middle).distance < 0),
      across_(across),
      lean_(lean),
      upwards_(slice == 1 ? 1 : -1),
      depth_(depth),
      trend_(0) {
  const double height = slices[2]->z - slices[1]->z;
  const SliceShape* before = slices[slice == 1 ? 0 : 3];
  Bounds bounds = before == nullptr ? unknown : single;
  bool has_trend = false;
  if (before != nullptr && !before->distance.is_empty()) {
    const double gap = std::abs(slice_->z - before->z);
    double there = before->depth(is_solid_, middle);
    if (there < 0) there = depth_around(*before, *slice_, is_solid_, middle, depth);
    if (there > 0) {
      trend_ = std::clamp((depth * depth - there * there - gap * gap) / gap, -most_trend * depth,
                          most_trend * depth);
      has_trend = true;
    }
  }
  const double top = (trend_ + std::hypot(trend_, 2 * depth)) / 2;
  if (has_trend) bounds = {with_trend.lowest, highest_by_trend(top / height)};
  scale_ = std::clamp(top, bounds.lowest * height, bounds.highest * height) / top;
}

/// By spheres around which there is no boundary (Hart, 1996).
double SmoothEnd::way_out(Point place, Point way, double nearest) const {
  double length = nearest;
  for (int step = 0; step < steps_of_way; ++step) {
    const double depth =
        slice_->depth(is_solid_, {place.x + length * way.x, place.y + length * way.y});
    length += std::max(depth, 0.0);
    if (depth < nearness_of_way * depth_) break;
  }
  return length;
}

SmoothEnd::Power SmoothEnd::power(Point place) const {
  const SignedDistance::Value boundary = slice_->distance.at(place);
  const double side = is_solid_ ? -1 : 1;
  const double depth = std::clamp(side * boundary.distance, 0.0, depth_);
  const double slope = 2 * side * (depth_ - depth);
  Power least{depth * (2 * depth_ - depth),
              {slope * boundary.outward.x, slope * boundary.outward.y}};
  if (across_ == Point{} || depth == 0) return least;
  const double ahead = way_out(place, across_, depth);
  const double behind = way_out(place, {-across_.x, -across_.y}, depth);
  if (ahead * behind < least.value)
    least = {ahead * behind, {(ahead - behind) * across_.x, (ahead - behind) * across_.y}};
  return least;
}

Sample SmoothEnd::at(const Vec3& p) const {
  const auto [value, gradient] = power({p[0], p[1]});
  const double root = std::sqrt(trend_ * trend_ + 4 * std::max(value, 1e-12 * depth_ * depth_));
  const double height = scale_ * (trend_ + root) / 2;
  const double slope = -scale_ / root;
  return {upwards_ * (p[2] - slice_->z) - height,
          {slope * gradient.x, slope * gradient.y, upwards_}};
}

}  // namespace loft
