// SPDX-License-Identifier: MIT
#include "reconstruct/tile/contacts.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "mesh/box_tree.h"
#include "reconstruct/origin.h"
#include "reconstruct/plane/nearest.h"

namespace loft {

namespace {

using cdt::Point;

Box3 box_around(std::span<const Point> points, double margin) {
  Box3 box = no_box;
  for (const Point p : points) {
    box.low = {std::min(box.low[0], p.x - margin), std::min(box.low[1], p.y - margin), 0};
    box.high = {std::max(box.high[0], p.x + margin), std::max(box.high[1], p.y + margin), 0};
  }
  return box;
}

/// One of the two slices.
struct Loops {
  const Region& region;
  std::vector<Point> points;         // places in the overlay, of the vertices of loops
  std::vector<std::uint8_t> is_one;  // with a vertex of the other slice
};

Loops loops(const Region& region, Point shift) {
  Loops loops{region, {}, {}};
  for (const Point p : region.loop_points()) loops.points.push_back({p.x + shift.x, p.y + shift.y});
  loops.is_one.assign(loops.points.size(), 0);
  return loops;
}

/// Moves vertices of the upper slice to those of the lower that they touch. False if one touches
/// several.
bool unite_vertices(Loops& lower, Loops& upper, double contact) {
  std::vector<Box3> boxes;
  for (const Point& p : lower.points) boxes.push_back(box_around({&p, 1}, contact));
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < upper.points.size(); ++i) {
    const Point place = upper.points[i];
    bool is_clear = true;
    tree.for_each_meeting(box_around({&place, 1}, 0), [&](std::uint32_t k) {
      const Point other = lower.points[k];
      if (std::hypot(other.x - place.x, other.y - place.y) > contact) return;
      is_clear = is_clear && lower.is_one[k] == 0 && upper.is_one[i] == 0;
      lower.is_one[k] = 1;
      upper.is_one[i] = 1;
      upper.points[i] = other;
    });
    if (!is_clear) return false;
  }
  return true;
}

/// Leads the sides of one slice through the vertices of the other.
class Paths {
 public:
  Paths(const Loops& own, const Loops& other, double contact) : own_(own) {
    find_sides();
    find_touched(other, contact);
  }

  LoopPaths run() {
    std::ranges::sort(touched_);
    LoopPaths paths;
    auto touched = touched_.begin();
    for (std::uint32_t i = 0; i < sides_.size(); ++i) {
      paths.side_starts.push_back(static_cast<std::uint32_t>(paths.points.size()));
      paths.points.push_back(sides_[i][0]);
      for (; touched != touched_.end() && std::get<0>(*touched) == i; ++touched)
        paths.points.push_back(std::get<2>(*touched));
    }
    paths.side_starts.push_back(static_cast<std::uint32_t>(paths.points.size()));
    for (const std::uint32_t start : own_.region.loop_starts)
      paths.loop_starts.push_back(paths.side_starts[start]);
    return paths;
  }

 private:
  void find_sides() {
    for (std::size_t i = 0; i < own_.region.loop_count(); ++i) {
      const auto loop = own_.region.loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k)
        sides_.push_back({own_.points[loop[k]], own_.points[loop[(k + 1) % loop.size()]]});
    }
  }

  void find_touched(const Loops& other, double contact) {
    std::vector<Box3> boxes;
    for (const Segment& side : sides_) boxes.push_back(box_around(side, contact));
    const BoxTree tree(boxes);
    for (std::size_t i = 0; i < other.points.size(); ++i) {
      if (other.is_one[i] != 0) continue;
      const Point p = other.points[i];
      tree.for_each_meeting(box_around({&p, 1}, 0), [&](std::uint32_t side) {
        const auto& [a, b] = sides_[side];
        if (distance(p, a, b) > contact) return;
        touched_.emplace_back(side, (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y), p);
      });
    }
  }

  const Loops& own_;
  std::vector<Segment> sides_;
  std::vector<std::tuple<std::uint32_t, double, Point>> touched_;  // side, how far along it, where
};

/// The same for the same place, whichever path it is of.
Point stirred(Point p, unsigned stir, double contact) {
  constexpr double share = 0x1p-3;
  const double turn = 1e3 * stir * ((p.x + 1.7 * p.y) / contact * 0x1p-24);
  return {p.x + share * contact * std::cos(turn), p.y + share * contact * std::sin(turn)};
}

}  // namespace

std::optional<std::array<LoopPaths, 2>> meet_exactly(const Region& lower, const Region& upper,
                                                     Point shift, double contact, unsigned stir) {
  Loops below = loops(lower, {});
  Loops above = loops(upper, shift);
  if (!unite_vertices(below, above, contact)) return {};
  std::array paths{Paths(below, above, contact).run(), Paths(above, below, contact).run()};
  if (stir > 0)
    for (LoopPaths& path : paths)
      for (Point& p : path.points) p = stirred(p, stir, contact);
  return paths;
}

}  // namespace loft
