// SPDX-License-Identifier: MIT
#include "reconstruct/shape/cover.h"

#include <algorithm>
#include <cmath>

#include "mesh/vec3.h"

namespace loft {

namespace {

/// In sizes of a triangle: what is seen nearer to its edges than that may be on them.
constexpr double edge_width = 0x1p-40;

/// Twice the area, as seen; negative from behind.
double area_seen(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A triangle that was cut three times has at most six corners; nine if rounding makes notches.
struct Polygon {
  std::array<Vec3, 9> corners;
  std::size_t size = 0;

  void add(const Vec3& p) { corners[size++] = p; }
};

/// The part where a depth is not negative (Sutherland and Hodgman, 1974).
template <class Depth>
Polygon cut(const Polygon& whole, Depth depth) {
  Polygon part;
  for (std::size_t i = 0; i < whole.size; ++i) {
    const Vec3& a = whole.corners[i];
    const Vec3& b = whole.corners[i + 1 == whole.size ? 0 : i + 1];
    const double depth_a = depth(a);
    const double depth_b = depth(b);
    if (depth_a >= 0) part.add(a);
    if ((depth_a >= 0) != (depth_b >= 0))
      part.add(along(a, depth_a / (depth_a - depth_b), minus(b, a)));
  }
  return part;
}

}  // namespace

bool Cover::covers(const Corners& triangle, std::span<const std::uint32_t> among) {
  if (!look_at(triangle)) return false;
  const std::uint32_t first = face_at_middle(among);
  if (first == none) return false;
  front_.assign(1, first);
  seen_[first] = ++look_;
  while (!front_.empty()) {
    const std::uint32_t face = front_.back();
    front_.pop_back();
    const Seen corners = seen(face);
    if (!(area_seen(corners[0], corners[1], corners[2]) > 0) || !is_near(corners)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!enters(corners[i], corners[(i + 1) % 3])) continue;
      const std::uint32_t next = neighbours_[face][i];
      if (next == none) return false;
      if (seen_[next] == look_) continue;
      seen_[next] = look_;
      front_.push_back(next);
    }
  }
  return true;
}

bool Cover::look_at(const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  start_ = a;
  Vec3 x = minus(b, a);
  Vec3 z = cross(x, minus(c, a));
  if (!make_unit(x) || !make_unit(z)) return false;
  axes_ = {x, cross(z, x), z};
  const auto flat = [this](const Vec3& p) {
    const Vec3 way = minus(p, start_);
    return Vec3{dot(axes_[0], way), dot(axes_[1], way), 0};
  };
  const Seen corners{flat(a), flat(b), flat(c)};
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = corners[i];
    Vec3 way = minus(corners[(i + 1) % 3], from);
    size = std::max(size, length(way));
    if (!make_unit(way)) return false;
    inwards_[i] = {-way[1], way[0], way[1] * from[0] - way[0] * from[1]};
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    middle_[axis] = (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3;
  rounding_ = edge_width * size;
  return true;
}

Cover::Seen Cover::seen(std::uint32_t face) const {
  Seen result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 way = minus(faces_[face][i], start_);
    result[i] = {dot(axes_[0], way), dot(axes_[1], way), dot(axes_[2], way)};
  }
  return result;
}

std::uint32_t Cover::face_at_middle(std::span<const std::uint32_t> among) const {
  const auto is_there = [this](std::uint32_t face) {
    const Seen p = seen(face);
    return area_seen(p[0], p[1], middle_) >= 0 && area_seen(p[1], p[2], middle_) >= 0 &&
           area_seen(p[2], p[0], middle_) >= 0 && is_near(p);
  };
  const auto found = std::ranges::find_if(among, is_there);
  return found == among.end() ? none : *found;
}

bool Cover::is_near(const Seen& face) const {
  const auto is_within = [this](const Vec3& p) { return std::abs(p[2]) <= distance_; };
  if (std::ranges::all_of(face, is_within)) return true;
  Polygon part;
  for (const Vec3& p : face) part.add(p);
  for (std::size_t i = 0; i < 3; ++i) part = cut(part, [&](const Vec3& p) { return depth(i, p); });
  return std::all_of(part.corners.begin(),
                     part.corners.begin() + static_cast<std::ptrdiff_t>(part.size), is_within);
}

bool Cover::enters(const Vec3& from, const Vec3& to) const {
  double first = 0;
  double last = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double depth_from = depth(i, from) - rounding_;
    const double depth_to = depth(i, to) - rounding_;
    if (depth_from <= 0 && depth_to <= 0) return false;
    if (depth_from >= 0 && depth_to >= 0) continue;
    const double share = depth_from / (depth_from - depth_to);
    if (depth_from < 0)
      first = std::max(first, share);
    else
      last = std::min(last, share);
  }
  return first < last;
}

}  // namespace loft
