// SPDX-License-Identifier: MIT
#include "fields/isolines.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "cdt/each_once.h"
#include "fields/level.h"

namespace loft::fields {

namespace {

/// For each level, the triangles that it goes through.
std::vector<std::vector<TriangleId>> crossed_by(const Field& field,
                                                std::span<const double> levels) {
  std::vector<std::vector<TriangleId>> crossed(levels.size());
  for (std::uint32_t i = 0; i < field.mesh().triangle_bound(); ++i) {
    const TriangleId t(i);
    if (!has_surface(field, t)) continue;
    const auto [least, most] = std::minmax({field.corner_value(Triangulation::edge(t, 0)),
                                            field.corner_value(Triangulation::edge(t, 1)),
                                            field.corner_value(Triangulation::edge(t, 2))});
    auto level = std::upper_bound(levels.begin(), levels.end(), least);
    for (; level != levels.end() && *level <= most; ++level)
      crossed[static_cast<std::size_t>(level - levels.begin())].push_back(t);
  }
  return crossed;
}

/// Joins what a level is in each triangle.
class Joiner {
 public:
  Joiner(const Field& field, double value) : field_(field), value_(value), level_(field, value) {}

  void join(std::span<const TriangleId> crossed, std::vector<Isoline>& lines) {
    seen_.assign(field_.mesh().triangle_bound(), false);
    for (const TriangleId t : crossed)
      if (!seen_[t.index()]) add(start_of(t), lines);
  }

 private:
  /// The edge on which the line through a triangle begins; one of that triangle if it is closed.
  [[nodiscard]] EdgeId start_of(TriangleId t) const {
    const EdgeId first = level_.falling_edge(t);
    EdgeId e = first;
    for (;;) {
      const EdgeId before = beyond(e);
      if (before.is_none()) return e;
      e = level_.falling_edge(Triangulation::triangle(before));
      if (e == first) return first;
    }
  }
  /// The edge on the other side, if the line goes on there.
  [[nodiscard]] EdgeId beyond(EdgeId e) const {
    if (field_.is_separating(e)) return {};
    const EdgeId twin = field_.mesh().twin(e);
    return has_surface(field_, Triangulation::triangle(twin)) ? twin : EdgeId();
  }
  void add(EdgeId start, std::vector<Isoline>& lines) {
    Isoline line{.level = value_, .is_closed = false, .points = {level_.crossing(start)}};
    EdgeId falling = start;
    for (;;) {
      seen_[Triangulation::triangle(falling).index()] = true;
      const EdgeId rising = level_.rising_edge(falling);
      if (const Point p = level_.crossing(rising); p != line.points.back())
        line.points.push_back(p);
      falling = beyond(rising);
      line.is_closed = falling == start;
      if (falling.is_none() || line.is_closed) break;
    }
    if (line.is_closed) close(line);
    if (line.points.size() >= (line.is_closed ? 3U : 2U)) lines.push_back(std::move(line));
  }
  /// It came back to its first point. Around a single one there is nothing.
  static void close(Isoline& line) {
    if (line.points.size() > 1 && line.points.back() == line.points.front()) line.points.pop_back();
    std::rotate(line.points.begin(), std::min_element(line.points.begin(), line.points.end()),
                line.points.end());
  }

  const Field& field_;
  double value_;
  Level level_;
  std::vector<bool> seen_;  // by triangle
};

}  // namespace

std::vector<Isoline> isolines(const Field& field, std::span<const double> levels) {
  std::vector<double> sorted(levels.begin(), levels.end());
  cdt::keep_each_once(sorted);
  const std::vector<std::vector<TriangleId>> crossed = crossed_by(field, sorted);
  std::vector<Isoline> lines;
  for (std::size_t i = 0; i < sorted.size(); ++i) Joiner(field, sorted[i]).join(crossed[i], lines);
  std::sort(lines.begin(), lines.end(), [](const Isoline& a, const Isoline& b) {
    return std::tie(a.level, a.points) < std::tie(b.level, b.points);
  });
  return lines;
}

}  // namespace loft::fields
