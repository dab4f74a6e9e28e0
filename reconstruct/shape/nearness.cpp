// SPDX-License-Identifier: MIT
#include "reconstruct/shape/nearness.h"

#include <algorithm>

#include "mesh/box3.h"
#include "mesh/vec3.h"

namespace loft {

namespace {

constexpr unsigned all_corners = 0b111;

/// Pieces that may be looked at, for each triangle that may be near and in any case.
constexpr std::size_t pieces_for_each = 16;
constexpr std::size_t pieces_at_least = 256;

/// Halvings of an edge in search of the place where nearness ends.
constexpr int halvings = 5;

/// A cut nearer to an end than that would leave nearly all of the piece.
constexpr double least_share_of_edge = 0.03;

Vec3 scaled(double share, const Vec3& way) { return along({}, share, way); }

Box3 box(const Corners& t) { return box_around(t[0], t[1], t[2]); }

}  // namespace

double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = minus(b, a);
  const double whole = squared_length(way);
  const double share = whole > 0 ? std::clamp(dot(minus(p, a), way) / whole, 0.0, 1.0) : 0;
  return squared_length(minus(p, along(a, share, way)));
}

// By the region around the triangle that p is in (Ericson, "Real-Time Collision Detection", 5.1.5).
// Shares are between 0 and 1 whatever the rounding, so what is measured is a point of the triangle.
double squared_distance(const Vec3& p, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = minus(b, a);
  const Vec3 ac = minus(c, a);
  const Vec3 ap = minus(p, a);
  const double ab_ap = dot(ab, ap);
  const double ac_ap = dot(ac, ap);
  if (ab_ap <= 0 && ac_ap <= 0) return squared_length(ap);
  const Vec3 bp = minus(p, b);
  const double ab_bp = dot(ab, bp);
  const double ac_bp = dot(ac, bp);
  if (ab_bp >= 0 && ac_bp <= ab_bp) return squared_length(bp);
  const Vec3 cp = minus(p, c);
  const double ab_cp = dot(ab, cp);
  const double ac_cp = dot(ac, cp);
  if (ac_cp >= 0 && ab_cp <= ac_cp) return squared_length(cp);
  const double at_c = ab_ap * ac_bp - ab_bp * ac_ap;
  if (at_c <= 0 && ab_ap >= 0 && ab_bp <= 0)
    return squared_length(minus(ap, scaled(ab_ap / (ab_ap - ab_bp), ab)));
  const double at_b = ab_cp * ac_ap - ab_ap * ac_cp;
  if (at_b <= 0 && ac_ap >= 0 && ac_cp <= 0)
    return squared_length(minus(ap, scaled(ac_ap / (ac_ap - ac_cp), ac)));
  const double at_a = ab_bp * ac_cp - ab_cp * ac_bp;
  const double from_b = ac_bp - ab_bp;
  const double from_c = ab_cp - ac_cp;
  if (at_a <= 0 && from_b >= 0 && from_c >= 0)
    return squared_length(minus(bp, scaled(from_b / (from_b + from_c), minus(c, b))));
  const double whole = at_a + at_b + at_c;
  return squared_length(minus(minus(ap, scaled(at_b / whole, ab)), scaled(at_c / whole, ac)));
}

bool Nearness::all_near(const Corners& whole, std::span<const Corners> others) {
  used_.clear();
  start(whole, others);
  std::size_t left = pieces_at_least + pieces_for_each * others.size();
  while (!pieces_.empty()) {
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    candidates_.resize(piece.last);
    const auto those = candidates(piece);
    const auto found = std::ranges::find(those, all_corners, &Candidate::near);
    if (found != those.end()) {
      used_.push_back(found->triangle);
      continue;
    }
    unsigned near = 0;
    for (const Candidate& each : those) near |= each.near;
    if (near != all_corners || left-- == 0) return false;
    cut(piece, others);
  }
  std::ranges::sort(used_);
  used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
  return true;
}

void Nearness::start(const Corners& whole, std::span<const Corners> others) {
  pieces_.clear();
  candidates_.clear();
  boxes_.clear();
  const Box3 around = box(whole);
  for (std::size_t i = 0; i < others.size(); ++i) {
    boxes_.push_back(box(others[i]));
    if (!boxes_are_near(around, boxes_.back(), distance_)) continue;
    unsigned near = 0;
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (is_near(whole[corner], others[i], boxes_[i])) near |= 1U << corner;
    candidates_.push_back({static_cast<std::uint32_t>(i), near});
    if (near == all_corners) break;  // it is enough
  }
  pieces_.push_back({whole, 0, candidates_.size()});
}

void Nearness::cut(const Piece& piece, std::span<const Corners> others) {
  const std::size_t corner = corner_of_cut(piece);
  const std::size_t a = (corner + 1) % 3;
  const std::size_t b = (corner + 2) % 3;
  const auto& corners = piece.corners;
  const Vec3 middle =
      along(corners[a], share_of_cut(piece, a, others), minus(corners[b], corners[a]));
  near_cut_.clear();
  for (const Candidate& each : candidates(piece))
    near_cut_.push_back(is_near(middle, others[each.triangle], boxes_[each.triangle]));
  const auto bits = [](unsigned near, std::size_t first, std::size_t second, bool third) {
    return (near >> first & 1U) | (near >> second & 1U) << 1U | (third ? 0b100U : 0U);
  };
  push(piece, {corners[corner], corners[a], middle},
       [&](std::size_t i, unsigned near) { return bits(near, corner, a, near_cut_[i]); });
  push(piece, {corners[corner], corners[b], middle},
       [&](std::size_t i, unsigned near) { return bits(near, corner, b, near_cut_[i]); });
}

template <class Near>
void Nearness::push(const Piece& old, const Corners& corners, Near near) {
  const std::size_t start = candidates_.size();
  const Box3 around = box(corners);
  for (std::size_t i = 0; i < old.last - old.first; ++i) {
    const Candidate each = candidates_[old.first + i];
    const unsigned bits = near(i, each.near);
    if (bits != 0 || boxes_are_near(around, boxes_[each.triangle], distance_))
      candidates_.push_back({each.triangle, bits});
  }
  pieces_.push_back({corners, start, candidates_.size()});
}

std::size_t Nearness::corner_of_cut(const Piece& piece) const {
  std::size_t best = 0;
  bool best_is_shared = true;
  double longest = -1;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const unsigned ends = all_corners & ~(1U << corner);
    const bool is_shared = std::ranges::any_of(
        candidates(piece), [&](const Candidate& each) { return (each.near & ends) == ends; });
    const double length =
        squared_length(minus(piece.corners[(corner + 1) % 3], piece.corners[(corner + 2) % 3]));
    if (is_shared && !best_is_shared) continue;
    if (is_shared == best_is_shared && length <= longest) continue;
    best = corner;
    best_is_shared = is_shared;
    longest = length;
  }
  return best;
}

double Nearness::share_of_cut(const Piece& piece, std::size_t a,
                              std::span<const Corners> others) const {
  const std::size_t b = (a + 1) % 3;
  const Vec3& from = piece.corners[a];
  const Vec3 way = minus(piece.corners[b], from);
  double reach_of_a = 0;
  double reach_of_b = 1;
  for (const Candidate& each : candidates(piece)) {
    const bool is_near_a = (each.near >> a & 1U) != 0;
    const bool is_near_b = (each.near >> b & 1U) != 0;
    if (is_near_a && is_near_b) return 0.5;
    if (!is_near_a && !is_near_b) continue;
    const auto reaches = [&](double share) {
      return is_near(along(from, share, way), others[each.triangle], boxes_[each.triangle]);
    };
    double& reach = is_near_a ? reach_of_a : reach_of_b;
    if (!reaches(reach)) continue;  // another one reaches farther
    double near = reach;
    double far = is_near_a ? 1 : 0;
    for (int halving = 0; halving < halvings; ++halving) {
      const double middle = (near + far) / 2;
      (reaches(middle) ? near : far) = middle;
    }
    reach = near;
  }
  return std::clamp((reach_of_a + reach_of_b) / 2, least_share_of_edge, 1 - least_share_of_edge);
}

}  // namespace loft
