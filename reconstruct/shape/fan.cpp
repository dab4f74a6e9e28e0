// SPDX-License-Identifier: MIT
#include "reconstruct/shape/fan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/triangle_shape.h"
#include "reconstruct/shape/nearness.h"

namespace loft {

namespace {

using Halfedge = Surface::HalfedgeHandle;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// In sizes of a fan: a distance below that may be rounding, so whether it is 0 is decided exactly.
constexpr double doubtful_distance = 0x1p-40;

/// Cosine of the angle to the direction of view from which on a face counts as seen, the share of
/// its normal by which the view is turned to one that is not, and how often that is tried.
constexpr double least_facing = 0.1;
constexpr double turning = 0.5;
constexpr int most_turns = 16;

/// A point seen along the normal of a fan from its middle: x and y across, z along.
double area(const Vec3& a, const Vec3& b) { return a[0] * b[1] - a[1] * b[0]; }
double area(const Vec3& a, const Vec3& b, const Vec3& c) { return area(minus(b, a), minus(c, a)); }

/// The difference of heights where an edge from the middle to `end` crosses the edge ab; 0 if
/// they don't.
double gap(const Vec3& end, const Vec3& a, const Vec3& b) {
  const Vec3 ab = minus(b, a);
  const double whole = area(end, ab);
  if (whole == 0) return 0;
  const double t = area(a, ab) / whole;
  const double s = area(a, end) / whole;
  if (!(t >= 0 && t <= 1 && s >= 0 && s <= 1)) return 0;
  return std::abs(t * end[2] - (a[2] + s * ab[2]));
}

/// A unit vector at a right angle to a unit vector.
Vec3 across(const Vec3& normal) {
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::abs(normal[axis]) < std::abs(normal[least])) least = axis;
  Vec3 unit{};
  unit[least] = 1;
  Vec3 result = cross(normal, unit);
  make_unit(result);
  return result;
}

/// Whether p is in the closed cone from an apex through a triangle; never if that is flat.
bool is_in_cone(const Vec3& p, const Vec3& apex, const Corners& t) {
  const auto& [a, b, c] = t;
  const int inside = orient3d(a, b, c, apex);
  return inside != 0 && orient3d(a, b, p, apex) * inside >= 0 &&
         orient3d(b, c, p, apex) * inside >= 0 && orient3d(c, a, p, apex) * inside >= 0;
}

}  // namespace

bool Fan::read(const Surface& surface, Surface::VertexHandle v) {
  is_open_ = surface.is_boundary(v);
  collect(surface, v);
  if (spokes_.size() > largest_fan) return false;
  const OpenMesh::Vec3d& p = surface.point(v);
  middle_ = {p[0], p[1], p[2]};
  if (!is_open_) start_at_smallest();
  return look_along_normal();
}

void Fan::collect(const Surface& surface, Surface::VertexHandle v) {
  spokes_.clear();
  const auto next = [&](Halfedge h) {
    return surface.opposite_halfedge_handle(surface.prev_halfedge_handle(h));
  };
  Halfedge start = surface.halfedge_handle(v);
  if (is_open_) start = next(start);  // that of a vertex on a rim has the rim on its left
  Halfedge h = start;
  do {
    const OpenMesh::Vec3d& p = surface.point(surface.to_vertex_handle(h));
    spokes_.push_back({h, surface.face_handle(h), {p[0], p[1], p[2]}});
    h = next(h);
  } while (h != start && spokes_.size() <= largest_fan);
}

void Fan::find_swept(std::size_t target) {
  swept_.clear();
  for (std::size_t i = 0; i < faces(); ++i) {
    if (vanishes(i, target)) continue;
    const Corners face = moved(i, target);
    const auto& [a, b, c] = face;
    const int inside = orient3d(a, b, c, middle_);
    if (inside != 0) swept_.push_back({face, inside, extended(box_around(a, b, c), middle_)});
  }
}

bool Fan::sweeps(std::size_t target, const Corners& t) const {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vec3& p = t[corner];
    const std::size_t at = find(p);
    if (at == size() ? sweeps_point(p)
                     : starts_inside(target, at, t[(corner + 1) % 3]) ||
                           starts_inside(target, at, t[(corner + 2) % 3]))
      return true;
  }
  return false;
}

double Fan::distance(std::size_t target) const {
  if (!keeps_sides(target)) return infinity;
  const double distance = std::max(is_open_ ? distance_at_rim() : distance_at_middle(target),
                                   distance_at_crossings(target));
  return distance <= doubtful_distance * extent_ && changes_nothing(target) ? 0 : distance;
}

double Fan::worst_sine(std::size_t target) const {
  double worst = infinity;
  for (std::size_t i = 0; i < faces(); ++i)
    if (!vanishes(i, target)) worst = std::min(worst, smallest_sine(moved(i, target)));
  return worst;
}

std::size_t Fan::find(const Vec3& p) const {
  std::size_t i = 0;
  while (i < size() && place(i) != p) ++i;
  return i;
}

bool Fan::sweeps_point(const Vec3& p) const {
  return std::ranges::any_of(swept_, [&](const Swept& swept) {
    const auto& [a, b, c] = swept.face;
    return boxes_meet({p, p}, swept.box) && orient3d(a, b, c, p) * swept.inside >= 0 &&
           is_in_cone(p, middle_, swept.face);
  });
}

bool Fan::starts_inside(std::size_t target, std::size_t i, const Vec3& p) const {
  if (p == place(before(i)) || p == place(after(i)) || i == target) return false;
  for (const std::size_t face : {before(i), i}) {
    if (vanishes(face, target)) continue;
    const Vec3& other = face == i ? place(after(i)) : place(before(i));
    if (is_in_cone(p, place(i), {middle_, place(target), other})) return true;
  }
  return false;
}

void Fan::start_at_smallest() {
  const auto pair_at = [this](std::size_t i) {
    return std::array{spokes_[i].place, spokes_[after(i)].place};
  };
  std::size_t first = 0;
  for (std::size_t i = 1; i < size(); ++i)
    if (pair_at(i) < pair_at(first)) first = i;
  std::rotate(spokes_.begin(), spokes_.begin() + static_cast<std::ptrdiff_t>(first), spokes_.end());
}

bool Fan::find_normal() {
  std::vector<Vec3>& normals = face_normals_;
  normals.clear();
  normal_ = {};
  for (std::size_t i = 0; i < faces(); ++i) {
    normals.push_back(cross(minus(place(i), middle_), minus(place(after(i)), middle_)));
    normal_ = along(normal_, 1, normals.back());
  }
  if (!make_unit(normal_) || !std::ranges::all_of(normals, make_unit)) return false;
  for (int turn = 0; turn < most_turns; ++turn) {
    const auto worst = std::ranges::min_element(
        normals, {}, [this](const Vec3& normal) { return dot(normal, normal_); });
    if (dot(*worst, normal_) > least_facing) return true;
    normal_ = along(normal_, turning, *worst);
    if (!make_unit(normal_)) return false;
  }
  return true;  // it may do
}

bool Fan::look_along_normal() {
  if (!find_normal()) return false;
  const Vec3 x_axis = across(normal_);
  const Vec3 y_axis = cross(normal_, x_axis);
  extent_ = 0;
  for (Spoke& spoke : spokes_) {
    const Vec3 way = minus(spoke.place, middle_);
    spoke.seen = {dot(way, x_axis), dot(way, y_axis), dot(way, normal_)};
    extent_ = std::max({extent_, std::abs(way[0]), std::abs(way[1]), std::abs(way[2])});
  }
  double turn = 0;
  for (std::size_t i = 0; i < faces(); ++i) {
    const double sine = area(seen(i), seen(after(i)));
    if (!(sine > 0)) return false;
    turn += std::atan2(sine, seen(i)[0] * seen(after(i))[0] + seen(i)[1] * seen(after(i))[1]);
  }
  // Around a closed fan it is a multiple of a full turn, but for rounding.
  return turn < (is_open_ ? 2 : 3) * std::numbers::pi;
}

bool Fan::keeps_sides(std::size_t target) const {
  for (std::size_t i = 0; i < faces(); ++i) {
    if (vanishes(i, target)) continue;
    const std::size_t j = after(i);
    if (!(area(seen(target), seen(i), seen(j)) > 0)) return false;
    const Vec3 old_normal = cross(seen(i), seen(j));
    const Vec3 new_normal = cross(minus(seen(i), seen(target)), minus(seen(j), seen(target)));
    if (!(dot(old_normal, new_normal) > 0)) return false;
  }
  return true;
}

double Fan::distance_at_middle(std::size_t target) const {
  double most_inside = -infinity;
  double height = infinity;
  for (std::size_t i = 0; i < faces(); ++i) {
    if (vanishes(i, target)) continue;
    const Vec3& a = seen(target);
    const Vec3& b = seen(i);
    const Vec3& c = seen(after(i));
    const double whole = area(a, b, c);
    const Vec3 shares{area(b, c) / whole, area(c, a) / whole, area(a, b) / whole};
    const double inside = std::min({shares[0], shares[1], shares[2]});
    if (inside <= most_inside) continue;
    most_inside = inside;
    height = dot(shares, {a[2], b[2], c[2]});
  }
  return std::abs(height);
}

double Fan::distance_at_rim() const {
  return std::sqrt(squared_distance(middle_, spokes_.front().place, spokes_.back().place));
}

double Fan::distance_at_crossings(std::size_t target) const {
  double most = 0;
  for (std::size_t j = 0; j < size(); ++j) {
    if (j == target || vanishes(j, target) || vanishes(before(j), target)) continue;
    for (std::size_t i = 0; i < size(); ++i)
      if (i != target && i != j) most = std::max(most, gap(seen(i), seen(target), seen(j)));
  }
  return most;
}

bool Fan::changes_nothing(std::size_t target) const {
  if (is_open_ && !collinear(middle_, place(0), place(size() - 1))) return false;
  for (std::size_t i = 0; i < faces(); ++i)
    if (!vanishes(i, target) && orient3d(middle_, place(i), place(after(i)), place(target)) != 0)
      return false;
  return true;
}

}  // namespace loft
