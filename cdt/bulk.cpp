// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "cdt/triangulation.h"

namespace loft::cdt {

namespace {

/// A point's index, and where it is on the curve.
struct Stop {
  std::uint32_t key;
  std::uint32_t index;
};

/// How far along a Hilbert curve over a grid of 2^16 x 2^16 cells a cell is: quadrant by quadrant,
/// turning what is inside as the curve turns there. Without branches, which nothing could predict.
std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y) {
  std::uint32_t key = 0;
  for (unsigned bit = 16; bit-- > 0;) {
    const std::uint32_t right = x >> bit & 1;
    const std::uint32_t upper = y >> bit & 1;
    key = key << 2 | ((3 * right) ^ upper);
    const std::uint32_t is_lower = upper - 1;           // all bits or none
    const std::uint32_t is_turned = is_lower & -right;  // around the diagonal from the far corner
    const std::uint32_t exchanged = (x ^ y) & is_lower;
    x ^= exchanged ^ is_turned;
    y ^= exchanged ^ is_turned;
  }
  return key;
}

/// By key, eleven bits at a time.
void radix_sort(std::span<Stop> stops, std::vector<Stop>& scratch) {
  constexpr unsigned digit_bits = 11;
  constexpr std::uint32_t digits = 1U << digit_bits;
  scratch.resize(stops.size());
  std::span<Stop> from = stops;
  std::span<Stop> to = scratch;
  for (unsigned shift = 0; shift < 32; shift += digit_bits) {
    std::array<std::uint32_t, digits> place{};
    for (const Stop& stop : from) ++place[stop.key >> shift & (digits - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& count : place) sum += std::exchange(count, sum);
    for (const Stop& stop : from) to[place[stop.key >> shift & (digits - 1)]++] = stop;
    std::swap(from, to);
  }
  std::ranges::copy(from, stops.begin());  // three passes: the last one filled the scratch
}

/// In rounds, each about three times as large as all before it, each along a Hilbert curve: so that
/// no round finds the points of a curve in the order of the curve (Amenta, Choi, Rote, "Incremental
/// Constructions con BRIO", 2003). The rounds are drawn by a hash of the index.
std::vector<Stop> order_of_insertion(std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.add(p);
  const double scale = 65536 / std::max({box.high.x - box.low.x, box.high.y - box.low.y, 1e-300});
  const auto cell = [&](double offset) {
    return static_cast<std::uint32_t>(std::min(offset * scale, 65535.0));
  };
  const auto round_of = [&](std::uint32_t i) {
    const std::uint32_t hash = (i + 1) * 0x9e37'79b1U;
    return std::min(std::countl_zero((hash ^ hash >> 15) * 0x85eb'ca77U) / 2, 9);
  };
  std::array<std::uint32_t, 11> start{};
  for (std::uint32_t i = 0; i < points.size(); ++i) ++start[static_cast<unsigned>(round_of(i))];
  std::uint32_t sum = 0;
  for (unsigned round = 10; round-- > 0;) sum += std::exchange(start[round], sum);
  std::vector<Stop> order(points.size());
  auto place = start;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    order[place[static_cast<unsigned>(round_of(i))]++] = {
        hilbert_key(cell(points[i].x - box.low.x), cell(points[i].y - box.low.y)), i};
  std::vector<Stop> scratch;
  for (unsigned round = 0; round < 10; ++round)
    radix_sort({order.data() + start[round], place[round] - start[round]}, scratch);
  return order;
}

}  // namespace

std::vector<ConstraintId> Triangulation::insert(std::span<const Polyline> polylines) {
  std::size_t count = 0;
  for (const Polyline& polyline : polylines) {
    check_usable(polyline.points);
    count += polyline.points.size();
  }
  std::vector<Point> points;
  points.reserve(count);
  for (const Polyline& polyline : polylines)
    points.insert(points.end(), polyline.points.begin(), polyline.points.end());

  if (count == 0) return {};

  begin_edit();
  const std::size_t known_snaps = snaps_.size();
  std::vector<VertexId> vertices(count);
  const std::vector<Stop> order = order_of_insertion(points);
  std::array<Point, 128> ahead;  // points are far apart in memory: fetch many at a time
  for (std::size_t first = 0; first < count; first += ahead.size()) {
    const std::size_t size = std::min(ahead.size(), count - first);
    for (std::size_t k = 0; k < size; ++k) ahead[k] = points[order[first + k].index];
    for (std::size_t k = 0; k < size; ++k) {
      const VertexId v = insert_near(ahead[k], last_);
      ++uses_[v.index()];
      vertices[order[first + k].index] = v;
    }
  }
  if (locator_.is_outgrown(vertex_count(), points[0])) locator_.lay_out(points_, vertex_count());
  std::vector<ConstraintId> ids;
  ids.reserve(polylines.size());
  const VertexId* first = vertices.data();
  for (const Polyline& polyline : polylines) {
    ids.push_back(new_constraint());
    describe(ids.back(), {first, polyline.points.size()}, polyline.ends);
    first += polyline.points.size();
  }
  for (const ConstraintId id : ids) lay_all(id);
  if (known_snaps > 0) {
    for (const ConstraintId id : ids) note_edited(id);
    straighten(known_snaps);
  }
  end_edit();
  return ids;
}

}  // namespace loft::cdt
