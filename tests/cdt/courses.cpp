// SPDX-License-Identifier: MIT
#include "tests/cdt/courses.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

namespace loft::cdt {

namespace {

using Rational = boost::multiprecision::cpp_rational;

/// The square of the distance of p from the segment ab.
Rational squared_distance(Point a, Point b, Point p) {
  const Rational x = Rational(b.x) - Rational(a.x);
  const Rational y = Rational(b.y) - Rational(a.y);
  Rational from_x = Rational(p.x) - Rational(a.x);
  Rational from_y = Rational(p.y) - Rational(a.y);
  const Rational whole = x * x + y * y;
  const Rational along = from_x * x + from_y * y;
  if (along > 0) {
    const Rational share = along >= whole ? Rational(1) : Rational(along / whole);
    from_x -= share * x;
    from_y -= share * y;
  }
  return from_x * from_x + from_y * from_y;
}

double reach(Point p) { return std::max(std::abs(p.x), std::abs(p.y)); }

bool is_on_line(Point a, Point b, Point p) {
  const Rational bound = Rational(std::max(reach(a), reach(b))) * Rational(0x1p-50);
  return squared_distance(a, b, p) <= bound * bound;
}

}  // namespace

std::string wrong_course(const Triangulation& mesh) {
  for (std::uint32_t i = 0; i < mesh.segment_bound(); ++i) {
    if (!mesh.is_segment(SegmentId(i))) continue;
    const Segment& segment = mesh.segment(SegmentId(i));
    const Point a = mesh.point(segment.from);
    const Point b = mesh.point(segment.to);
    VertexId at = segment.from;
    for (const EdgeId e : mesh.pieces(SegmentId(i))) {
      if (mesh.from(e) != at) return "the pieces of s" + std::to_string(i) + " are not joined";
      at = mesh.to(e);
      if (at != segment.to && !is_on_line(a, b, mesh.point(at)))
        return "s" + std::to_string(i) + " leads off its line";
    }
    if (at != segment.to) return "s" + std::to_string(i) + " does not lead to its end";
  }
  return "";
}

}  // namespace loft::cdt
