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

/// The points along a Hilbert curve; those in one cell of its grid by their coordinates, so that
/// equal ones follow each other.
std::vector<Stop> along_curve(std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.add(p);
  const double scale = 65536 / std::max({box.high.x - box.low.x, box.high.y - box.low.y, 1e-300});
  const auto cell = [&](double offset) {
    return static_cast<std::uint32_t>(std::min(offset * scale, 65535.0));
  };
  std::vector<Stop> stops(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    stops[i] = {hilbert_key(cell(points[i].x - box.low.x), cell(points[i].y - box.low.y)), i};
  std::vector<Stop> scratch;
  radix_sort(stops, scratch);
  for (auto first = stops.begin(); first != stops.end();) {
    const auto last =
        std::find_if(first, stops.end(), [&](const Stop& stop) { return stop.key != first->key; });
    if (last - first > 1)
      std::sort(first, last, [&](const Stop& s, const Stop& t) {
        return std::pair(points[s.index], s.index) < std::pair(points[t.index], t.index);
      });
    first = last;
  }
  return stops;
}

/// The constraints that have segments, by the numbers of their first vertices: so those that are
/// near in the plane, and in memory, follow each other.
std::vector<Stop> by_first_vertex(const Triangulation& mesh, std::span<const ConstraintId> ids) {
  std::vector<Stop> stops;
  for (std::uint32_t i = 0; i < ids.size(); ++i)
    if (!mesh.segments(ids[i]).empty()) stops.push_back({mesh.first_vertex(ids[i]).index(), i});
  std::vector<Stop> scratch;
  radix_sort(stops, scratch);
  return stops;
}

/// Rounds of insertion, each about three times as large as all before it: so that none finds the
/// points of a curve in the order of the curve (Amenta, Choi, Rote, "Incremental Constructions con
/// BRIO", 2003). They are drawn by a hash.
class Rounds {
 public:
  explicit Rounds(std::uint32_t count) : members_(count) {
    std::array<std::uint32_t, most> place{};
    for (std::uint32_t i = 0; i < count; ++i) ++place[round_of(i)];
    std::uint32_t sum = 0;
    for (unsigned round = most; round-- > 0;) sum += std::exchange(place[round], sum);
    for (std::uint32_t i = 0; i < count; ++i) members_[place[round_of(i)]++] = i;
  }

  [[nodiscard]] std::span<const std::uint32_t> members() const { return members_; }

 private:
  static constexpr unsigned most = 10;

  [[nodiscard]] static unsigned round_of(std::uint32_t i) {
    const std::uint32_t hash = (i + 1) * 0x9e37'79b1U;
    const int zeros = std::countl_zero((hash ^ hash >> 15) * 0x85eb'ca77U);
    return std::min(static_cast<unsigned>(zeros) / 2, most - 1);
  }

  std::vector<std::uint32_t> members_;  // round by round, in their own order in each
};

}  // namespace

/// Vertices that are near in the plane are to be near in memory: they are numbered along a curve
/// first, and then inserted in rounds. Returns the vertex of each point.
std::vector<VertexId> Triangulation::insert_in_rounds(std::span<const Point> points) {
  const std::vector<Stop> stops = along_curve(points);
  if (points.size() > points_.size()) reserve(points_.size() + points.size());
  const auto first = static_cast<std::uint32_t>(points_.size());
  std::vector<VertexId> vertices(points.size());
  for (const Stop& stop : stops) {
    const Point p = points[stop.index];
    if (points_.size() == first || points_.back() != p) points_.push_back(p);
    vertices[stop.index] = VertexId(static_cast<std::uint32_t>(points_.size() - 1));
  }
  const auto count = static_cast<std::uint32_t>(points_.size()) - first;
  vertex_edges_.resize(points_.size());
  uses_.resize(points_.size(), unused);
  std::vector<VertexId> instead;  // of numbers that are not used: a vertex was there
  const Rounds rounds(count);
  for (const std::uint32_t i : rounds.members()) {
    reserved_ = VertexId(first + i);
    const VertexId v = insert_near(point(reserved_), last_);
    if (v == VertexId(first + i)) continue;
    if (instead.empty()) instead.resize(count);
    instead[i] = v;
    ++vertex_count_;  // free_vertex() counts one less
    free_vertex(VertexId(first + i));
  }
  reserved_ = VertexId::none();
  for (VertexId& v : vertices) {
    if (!instead.empty() && !instead[v.index() - first].is_none()) v = instead[v.index() - first];
    ++uses_[v.index()];
  }
  if (locator_.is_outgrown(vertex_count(), points[0])) locator_.lay_out(points_, vertex_count());
  return vertices;
}

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
  const std::vector<VertexId> vertices = insert_in_rounds(points);
  std::vector<ConstraintId> ids;
  ids.reserve(polylines.size());
  const VertexId* first = vertices.data();
  for (const Polyline& polyline : polylines) {
    ids.push_back(new_constraint());
    describe(ids.back(), {first, polyline.points.size()}, polyline.ends);
    first += polyline.points.size();
  }
  if (epsilon_ > 0) {  // what is merged depends on the order
    for (const ConstraintId id : ids) lay_all(id);
  } else {
    for (const Stop& stop : by_first_vertex(*this, ids)) lay_all(ids[stop.index]);
  }
  if (known_snaps > 0) {
    for (const ConstraintId id : ids) note_edited(id);
    straighten(known_snaps);
  }
  end_edit();
  return ids;
}

}  // namespace loft::cdt
