// SPDX-License-Identifier: MIT
// What a box falls into: an overlay in which what is left of a separator is a layer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "fields/classes.h"
#include "overlay/faces.h"

namespace loft::fields {

using overlay::LayerId;
using overlay::Overlay;
using overlay::Ring;

namespace {

/// A square around all that matters, whose border stands for infinity.
class FarSquare {
 public:
  explicit FarSquare(const cdt::Box& box)
      : centre_{box.low.x + (box.high.x - box.low.x) / 2, box.low.y + (box.high.y - box.low.y) / 2},
        half_(8 * std::max({box.high.x - box.low.x, box.high.y - box.low.y, least_half})) {}

  /// Where on the border one gets from a to b and on: 0 to 8, counter-clockwise from its lowest
  /// corner on the left.
  [[nodiscard]] double place_of_end(Point a, Point b) const {
    const double x = (b.x - a.x) / half_;
    const double y = (b.y - a.y) / half_;
    const Point from{(b.x - centre_.x) / half_, (b.y - centre_.y) / half_};
    const double to_x = x == 0 ? far : ((x > 0 ? 1 : -1) - from.x) / x;
    const double to_y = y == 0 ? far : ((y > 0 ? 1 : -1) - from.y) / y;
    const auto across = [](double place) { return std::clamp(place, -1.0, 1.0) + 1; };
    if (to_x < to_y) {
      const double height = across(from.y + to_x * y);
      return x > 0 ? 2 + height : 8 - height;
    }
    const double width = across(from.x + to_y * x);
    return y > 0 ? 6 - width : width;
  }

  [[nodiscard]] Point at(double place) const {
    const double along = std::fmod(place, 2.0) - 1;
    switch (static_cast<int>(place / 2) % 4) {
      case 0:
        return on_plane(along, -1);
      case 1:
        return on_plane(1, along);
      case 2:
        return on_plane(-along, 1);
      default:
        return on_plane(-1, -along);
    }
  }

  /// From one place counter-clockwise to another, and so many times around: the corners.
  void add_way(Ring& ring, double from, double to, int turns) const {
    if (to < from) to += sides;
    to += turns * sides;
    if (from <= to)
      for (double corner = 2 * std::floor(from / 2) + 2; corner < to; corner += 2)
        ring.push_back(at(std::fmod(corner, sides)));
    else
      for (double corner = 2 * std::ceil(from / 2) - 2; corner > to; corner -= 2)
        ring.push_back(at(std::fmod(corner + sides, sides)));
  }

 private:
  static constexpr double sides = 8;  // of length 2 in units of half_
  static constexpr double far = 1e300;
  static constexpr double least_half = 1e-40;

  [[nodiscard]] Point on_plane(double x, double y) const {
    return {centre_.x + x * half_, centre_.y + y * half_};
  }

  Point centre_;
  double half_;
};

/// How often a ring winds around a place, counted as Standing does.
std::int32_t winding_around(const Ring& ring, Point p) {
  Standing sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point next = ring[i + 1 == ring.size() ? 0 : i + 1];
    if (ring[i] != next)
      sum += SeparatorPiece{SeparatorPiece::Part::between, ring[i], next}.standing(p);
  }
  return sum.winding;
}

/// How far a place is from the line through two others.
double distance_from_line(Point a, Point b, Point p) {
  const double cross = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  return std::abs(cross) / std::hypot(b.x - a.x, b.y - a.y);
}

/// Of a line's points and the corners of a box, that which is furthest from the line's ends: there
/// it is no matter that these are rounded.
Point clear_place(const Separator& line, const Ring& corners) {
  const auto points = line.points();
  std::vector<Point> places(points.begin(), points.end());
  places.insert(places.end(), corners.begin(), corners.end());
  const SeparatorPiece& first = line.pieces().front();
  const SeparatorPiece& last = line.pieces().back();
  return std::ranges::max(places, {}, [&](Point p) {
    return std::min(distance_from_line(first.a, first.b, p), distance_from_line(last.a, last.b, p));
  });
}

/// The closed line of which Separator speaks.
Ring closed_line(const Separator& line, const FarSquare& square, const Ring& corners) {
  const auto points = line.points();
  const double first = square.place_of_end(points[1], points[0]);
  const double last = square.place_of_end(points[points.size() - 2], points.back());
  const auto ring_with = [&](int turns) {
    Ring ring{square.at(first)};
    ring.insert(ring.end(), points.begin(), points.end());
    ring.push_back(square.at(last));
    square.add_way(ring, last, first, turns);
    return ring;
  };
  // Where both ends are nearly at one place, rounding may have them in the wrong order.
  const Point p = clear_place(line, corners);
  const Ring ring = ring_with(0);
  const std::int32_t missing = line.standing(p).winding - winding_around(ring, p);
  return missing == 0 ? ring : ring_with(missing);
}

/// The signs of a face in the layers 1 to n.
std::vector<Sign> face_signs(std::span<const LayerId> layers, std::size_t count) {
  std::vector<Sign> signs(count, Sign::right);
  for (const LayerId layer : layers)
    if (layer.index() > 0) signs[layer.index() - 1] = Sign::left;
  return signs;
}

Ring box_corners(const cdt::Box& box) {
  return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
}

}  // namespace

std::vector<ClassFace> Classes::faces(const cdt::Box& box) const {
  Overlay overlay;
  const LayerId frame = overlay.add_layer("frame");
  const Ring corners = box_corners(box);
  overlay.insert(frame, corners);
  cdt::Box all = box;
  for (const SeparatorId id : separators())
    for (const Point& p : separator(id).points()) all.add(p);
  const FarSquare square(all);
  for (const SeparatorId id : separators())
    overlay.insert(overlay.add_layer("left", overlay::FillRule::positive),
                   closed_line(separator(id), square, corners));
  std::vector<ClassFace> result;
  for (overlay::Face& face : overlay::faces(overlay))
    if (face.layers.front() == frame)
      result.push_back({face_signs(face.layers, separators().size()), std::move(face.polygon)});
  return result;
}

}  // namespace loft::fields
