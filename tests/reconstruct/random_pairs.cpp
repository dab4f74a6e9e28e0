// SPDX-License-Identifier: MIT
#include "tests/reconstruct/random_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "tests/reconstruct/stacks.h"

namespace loft::stacks {

namespace {

using cdt::Point;
using Contours = std::vector<Contour>;

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  /// A number from 0 to n - 1.
  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  /// 10 to the power of minus 1 to minus `most`.
  double small(std::uint64_t most) {
    return std::pow(10.0, -1.0 - static_cast<double>(below(most)));
  }

  Contours polygons() { return random_slice(0, random_, false).contours; }

  Contours on_grid() {
    Contours contours(1 + below(4));
    const std::uint64_t size = 3 + below(10);
    for (Contour& contour : contours) {
      contour.points.resize(3 + below(8));
      for (Point& p : contour.points) p = {grid(size), grid(size)};
    }
    return contours;
  }

  Contours mask() {
    return random_mask(0, random_, 3 + static_cast<int>(below(6)), uniform(0.05, 0.95)).contours;
  }

  /// Star-shaped, the radius between these.
  Contour star(std::size_t n, double low, double high, Point centre = {}) {
    Contour contour;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      const double radius = uniform(low, high);
      contour.points.push_back(
          {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return contour;
  }

  /// Rings whose holes are joined to them by a channel, of no width or of a hair's.
  Contours keyholes() {
    Contours contours;
    const std::uint64_t count = 1 + below(2);
    for (std::uint64_t k = 0; k < count; ++k) {
      const Point centre{5.0 * static_cast<double>(k), 0};
      Contour ring = star(5 + below(12), 2, 2.4, centre);
      Contour hole = star(4 + below(6), 0.5, 1.5, centre);
      if (below(2) == 0) std::ranges::reverse(hole.points);
      const double width = below(2) == 0 ? 0 : small(9);
      hole.points.push_back({hole.points[0].x, hole.points[0].y + width});
      ring.points.push_back({ring.points[0].x, ring.points[0].y - width});
      ring.points.insert(ring.points.begin() + 1, hole.points.begin(), hole.points.end());
      std::swap(ring.points[0], ring.points.back());
      contours.push_back(std::move(ring));
    }
    return contours;
  }

  Contours spikes() {
    Contours contours = below(2) == 0 ? on_grid() : Contours{star(4 + below(8), 1, 2)};
    for (Contour& contour : contours) {
      auto& points = contour.points;
      const std::size_t at = below(points.size());
      const Point base = points[at];
      const Point tip{base.x + std::round(uniform(-4, 4)), base.y + std::round(uniform(-4, 4))};
      points.insert(points.begin() + static_cast<std::ptrdiff_t>(at), {base, tip});
    }
    return contours;
  }

  /// Twice round, exactly or nearly.
  Contours twice_round() {
    Contours contours = below(2) == 0 ? on_grid() : Contours{star(4 + below(8), 1, 2)};
    const double off = below(2) == 0 ? 0 : small(12);
    for (Contour& contour : contours) {
      const std::vector<Point> once = contour.points;
      for (const Point p : once)
        contour.points.push_back({p.x + off * uniform(-1, 1), p.y + off * uniform(-1, 1)});
    }
    return contours;
  }

  /// Rectangles side by side: every side is shared.
  Contours tiled() {
    const auto cuts = [&] {
      std::vector<double> at{0};
      const std::uint64_t count = 2 + below(3);
      for (std::uint64_t i = 0; i < count; ++i) at.push_back(at.back() + 1.0 + grid(3));
      return at;
    };
    const auto xs = cuts();
    const auto ys = cuts();
    Contours contours;
    for (std::size_t i = 0; i + 1 < xs.size(); ++i)
      for (std::size_t j = 0; j + 1 < ys.size(); ++j)
        if (below(3) != 0)
          contours.push_back(
              {{{xs[i], ys[j]}, {xs[i + 1], ys[j]}, {xs[i + 1], ys[j + 1]}, {xs[i], ys[j + 1]}},
               {}});
    return contours;
  }

  /// Sides of many points in one line, as far as rounding lets them.
  Contours in_line() {
    Contours contours{star(3 + below(4), 1, 3)};
    if (below(2) == 0) contours.push_back(star(3 + below(3), 0.2, 0.6));
    for (Contour& contour : contours) {
      const std::vector<Point> corners = std::exchange(contour.points, {});
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point a = corners[i];
        const Point b = corners[(i + 1) % corners.size()];
        const std::uint64_t pieces = 1 + below(6);
        for (std::uint64_t k = 0; k < pieces; ++k) {
          const double t = static_cast<double>(k) / static_cast<double>(pieces);
          contour.points.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
      }
    }
    return contours;
  }

  Contours any() {
    switch (below(8)) {
      case 0:
        return polygons();
      case 1:
        return on_grid();
      case 2:
        return mask();
      case 3:
        return keyholes();
      case 4:
        return spikes();
      case 5:
        return twice_round();
      case 6:
        return tiled();
      default:
        return in_line();
    }
  }

  /// Some points moved by up to `size`.
  Contours jittered(Contours contours, double size) {
    for (Contour& contour : contours)
      for (Point& p : contour.points)
        if (below(2) == 0) p = {p.x + size * uniform(-1, 1), p.y + size * uniform(-1, 1)};
    return contours;
  }

  static Contours turned(Contours contours, double by) {
    for (Contour& contour : contours)
      for (Point& p : contour.points)
        p = {p.x * std::cos(by) - p.y * std::sin(by), p.x * std::sin(by) + p.y * std::cos(by)};
    return contours;
  }

  /// Vertices exactly on the sides of the other slice's contours: coordinates of few bits.
  Contours on_sides_of(const Contours& others) {
    Contour contour;
    for (const Contour& other : others) {
      for (std::size_t i = 0; i < other.points.size(); ++i) {
        if (below(2) != 0) continue;
        const Point a = other.points[i];
        const Point b = other.points[(i + 1) % other.points.size()];
        const double t = static_cast<double>(below(5)) / 4;
        contour.points.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
      }
    }
    while (contour.points.size() < 3) contour.points.push_back({grid(7), grid(7)});
    return {contour};
  }

  /// A copy with some contours gone and some new: columns everywhere, and something else.
  Contours changed(Contours contours) {
    if (below(2) == 0 && contours.size() > 1) contours.erase(contours.begin());
    if (below(2) == 0) contours.push_back(on_grid().front());
    if (below(2) == 0) {
      auto& points = contours.back().points;
      points[below(points.size())] = {grid(7), grid(7)};
    }
    return contours;
  }

  double grid(std::uint64_t size) { return static_cast<double>(below(size)); }

 private:
  std::mt19937_64 random_;
};

void transform(std::vector<Slice>& slices, double scale, Point shift) {
  for (Slice& slice : slices)
    for (Contour& contour : slice.contours)
      for (Point& p : contour.points) p = {p.x * scale + shift.x, p.y * scale + shift.y};
}

constexpr std::array kinds{"polygons", "on a grid",    "masks",    "nearly copies",
                           "turned",   "a hair apart", "keyholes", "spikes",
                           "twice",    "shared sides", "in line",  "vertices on sides",
                           "far away", "tiny units",   "columns",  "mixed"};

}  // namespace

std::string kind_of_pair(std::uint64_t seed) { return kinds[seed % kinds.size()]; }

Pair random_pair(std::uint64_t seed) {
  Generator make(seed);
  Contours lower;
  Contours upper;
  double gap = 1;
  double scale = 1;
  Point shift{};
  const auto both = [&](Contours (Generator::*contours)()) {
    lower = (make.*contours)();
    upper = (make.*contours)();
  };
  switch (seed % kinds.size()) {
    case 0:
      both(&Generator::polygons);
      break;
    case 1:
      both(&Generator::on_grid);
      break;
    case 2:
      both(&Generator::mask);
      break;
    case 3:
      lower = make.any();
      upper = make.jittered(lower, make.small(15));
      break;
    case 4:
      lower = make.any();
      upper = Generator::turned(lower, make.small(16));
      break;
    case 5:
      both(&Generator::any);
      gap = 1e-9;
      break;
    case 6:
      both(&Generator::keyholes);
      break;
    case 7:
      both(&Generator::spikes);
      break;
    case 8:
      both(&Generator::twice_round);
      break;
    case 9:
      both(&Generator::tiled);
      break;
    case 10:
      lower = make.in_line();
      upper = make.below(2) == 0 ? make.in_line() : make.jittered(lower, make.small(15));
      break;
    case 11:
      lower = make.on_grid();
      upper = make.on_sides_of(lower);
      break;
    case 12:
      both(&Generator::any);
      shift = {1e6 + make.uniform(0, 1), -3e6};
      scale = make.small(5);
      break;
    case 13:
      both(&Generator::any);
      scale = make.small(12) * 1e-3;
      gap = scale;
      break;
    case 14:
      lower = make.any();
      upper = make.changed(lower);
      break;
    default:
      both(&Generator::any);
  }
  std::vector<Slice> slices{{0, std::move(lower)}, {gap, std::move(upper)}};
  transform(slices, scale, shift);
  constexpr std::array fills{Fill::even_odd, Fill::nonzero, Fill::keyhole_aware};
  return {std::move(slices), fills[make.below(fills.size())]};
}

}  // namespace loft::stacks
