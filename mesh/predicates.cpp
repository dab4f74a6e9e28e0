// SPDX-License-Identifier: MIT
#include "mesh/predicates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "cdt/expansion.h"

namespace loft {

namespace {

using cdt::Expansion;
using cdt::Point;

using Sides = std::array<int, 3>;
using FlatTriangle = std::array<Point, 3>;

constexpr std::size_t next(std::size_t corner) { return (corner + 1) % 3; }
constexpr std::size_t previous(std::size_t corner) { return (corner + 2) % 3; }

bool boxes_meet(const Corners& p, const Corners& q) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [p_low, p_high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
    const auto [q_low, q_high] = std::minmax({q[0][axis], q[1][axis], q[2][axis]});
    if (p_high < q_low || q_high < p_low) return false;
  }
  return true;
}

/// Brings the corners that both triangles have to the front, in the same order; how many they are.
std::size_t align_common_corners(Corners& p, Corners& q) {
  std::size_t common = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = common; j < 3; ++j) {
      if (p[i] != q[j]) continue;
      std::swap(p[i], p[common]);
      std::swap(q[j], q[common]);
      ++common;
      break;
    }
  }
  return common;
}

/// The sides of q's corners about the plane of p; the first `common` corners are known to be in it.
Sides sides(const Corners& p, const Corners& q, std::size_t common) {
  Sides result{};
  for (std::size_t j = common; j < 3; ++j) result[j] = orient3d(p[0], p[1], p[2], q[j]);
  return result;
}

/// The same as far as floating point tells; whether it tells all.
bool find_sides(const Corners& p, const Corners& q, std::size_t common, Sides& sides_of_q) {
  for (std::size_t j = common; j < 3; ++j) {
    sides_of_q[j] = detail::orient3d_filter(p[0], p[1], p[2], q[j]);
    if (sides_of_q[j] == 0) return false;
  }
  return true;
}

bool all_in_plane(const Sides& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

/// Whether corners from `first` on are all beside the plane, on the same side.
bool all_on_one_side(const Sides& s, std::size_t first) {
  for (std::size_t i = first; i < 3; ++i) {
    if (s[i] == 0 || s[i] != s[first]) return false;
  }
  return true;
}

/// Whether the closed segment from u to w, on the given sides of the triangle's plane, has a point
/// in the closed triangle. Precondition: not both ends are in the plane.
bool segment_meets(const Vec3& u, const Vec3& w, int side_u, int side_w, const Corners& t) {
  if (side_u * side_w > 0) return false;
  const int first = orient3d(u, w, t[0], t[1]);
  const int second = orient3d(u, w, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = orient3d(u, w, t[2], t[0]);
  return first * third >= 0 && second * third >= 0;
}

/// Whether an edge of p that is not in q's plane has a point in the closed triangle q.
bool edge_meets(const Corners& p, const Sides& sides_of_p, const Corners& q) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next(i);
    if (sides_of_p[i] == 0 && sides_of_p[j] == 0) continue;
    if (segment_meets(p[i], p[j], sides_of_p[i], sides_of_p[j], q)) return true;
  }
  return false;
}

// --- Both triangles in one plane ---

Point without(std::size_t axis, const Vec3& p) { return {p[next(axis)], p[previous(axis)]}; }

FlatTriangle without(std::size_t axis, const Corners& p) {
  return {without(axis, p[0]), without(axis, p[1]), without(axis, p[2])};
}

int orient(const FlatTriangle& t) { return cdt::orient(t[0], t[1], t[2]); }

/// An axis along which the triangle's plane can be seen from its face.
std::size_t visible_axis(const Corners& p) {
  std::size_t axis = 2;
  while (axis > 0 && orient(without(axis, p)) == 0) --axis;
  return axis;
}

/// Counter-clockwise, the first corner kept.
FlatTriangle flattened(std::size_t axis, const Corners& p) {
  FlatTriangle flat = without(axis, p);
  if (orient(flat) < 0) std::swap(flat[1], flat[2]);
  return flat;
}

/// Whether a line along an edge of p has p on one side and all of q strictly on the other.
bool edge_separates(const FlatTriangle& p, const FlatTriangle& q) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto is_outside = [&](Point point) { return cdt::orient(p[i], p[next(i)], point) < 0; };
    if (std::ranges::all_of(q, is_outside)) return true;
  }
  return false;
}

/// Disjoint convex polygons are separated along an edge of one of them.
bool flat_triangles_meet(const FlatTriangle& p, const FlatTriangle& q) {
  return !edge_separates(p, q) && !edge_separates(q, p);
}

/// Whether the ray from p's first corner to `point` runs in p or along its side.
bool has_in_angle(const FlatTriangle& p, Point point) {
  return cdt::orient(p[0], p[1], point) >= 0 && cdt::orient(p[0], point, p[2]) >= 0;
}

/// For triangles with the same first corner: whether their angles there overlap.
bool angles_meet(const FlatTriangle& p, const FlatTriangle& q) {
  return has_in_angle(p, q[1]) || has_in_angle(p, q[2]) || has_in_angle(q, p[1]) ||
         has_in_angle(q, p[2]);
}

/// For triangles whose first `common` corners are the same, seen along an axis from which neither
/// is degenerate: whether they meet there.
bool seen_triangles_meet(const Corners& p, const Corners& q, std::size_t common, std::size_t axis) {
  if (common == 2) {
    return orient(without(axis, p)) == orient(without(axis, q));  // on the same side of the edge
  }
  const FlatTriangle flat_p = flattened(axis, p);
  const FlatTriangle flat_q = flattened(axis, q);
  return common == 1 ? angles_meet(flat_p, flat_q) : flat_triangles_meet(flat_p, flat_q);
}

/// The axis that the triangle is seen largest along, but for rounding.
std::size_t widest_axis(const Corners& p) {
  std::size_t widest = 0;
  double largest = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [a, b, c] = without(axis, p);
    const double area = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    if (!(area > largest)) continue;
    largest = area;
    widest = axis;
  }
  return widest;
}

/// Whether the triangles, both nearly in one plane, do not meet even in projection onto it.
bool are_seen_apart(const Corners& p, const Corners& q, std::size_t common) {
  const std::size_t axis = widest_axis(p);
  if (orient(without(axis, p)) == 0 || orient(without(axis, q)) == 0) return false;
  return !seen_triangles_meet(p, q, common, axis);
}

}  // namespace

namespace detail {

int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  using Difference = std::array<Expansion<2>, 3>;
  const auto from_d = [&](const Vec3& p) {
    return Difference{cdt::exact_diff(p[0], d[0]), cdt::exact_diff(p[1], d[1]),
                      cdt::exact_diff(p[2], d[2])};
  };
  const auto minor = [](const Difference& p, const Difference& q) {
    return p[0] * q[1] - q[0] * p[1];
  };
  const Difference ad = from_d(a);
  const Difference bd = from_d(b);
  const Difference cd = from_d(c);
  return (minor(cd, bd) * ad[2] + minor(ad, cd) * bd[2] + minor(bd, ad) * cd[2]).sign();
}

}  // namespace detail

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cdt::orient(without(axis, a), without(axis, b), without(axis, c)) != 0) return false;
  }
  return true;
}

/// Where the planes differ, the triangles can only meet on the line that the planes share. There
/// each has one segment, which ends on the triangle's edges; so if the triangles meet, then an edge
/// of one, not in the other's plane, meets the other.
bool triangles_meet(const Corners& first, const Corners& second) {
  if (!boxes_meet(first, second)) return false;
  Corners p = first;
  Corners q = second;
  const std::size_t common = align_common_corners(p, q);
  if (common == 3) return true;
  // Walls have thousands of triangles where contours cross that often. Most are told apart without
  // exact arithmetic in space.
  Sides sides_of_q{};
  if (!find_sides(p, q, common, sides_of_q)) {
    if (are_seen_apart(p, q, common)) return false;
    sides_of_q = sides(p, q, common);
  }
  if (all_on_one_side(sides_of_q, common)) return false;
  if (all_in_plane(sides_of_q)) return seen_triangles_meet(p, q, common, visible_axis(p));
  const Sides sides_of_p = sides(q, p, common);
  if (all_on_one_side(sides_of_p, common)) return false;
  if (common == 1) {
    // The segments of both begin in the common corner; the one that ends first ends on the edge
    // across from it.
    return segment_meets(p[1], p[2], sides_of_p[1], sides_of_p[2], q) ||
           segment_meets(q[1], q[2], sides_of_q[1], sides_of_q[2], p);
  }
  return edge_meets(p, sides_of_p, q) || edge_meets(q, sides_of_q, p);
}

}  // namespace loft
