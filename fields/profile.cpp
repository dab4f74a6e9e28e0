// SPDX-License-Identifier: MIT
#include "fields/profile.h"

#include <algorithm>
#include <cmath>

#include "cdt/predicates.h"
#include "cdt/queries.h"
#include "fields/if_any.h"
#include "fields/patch.h"

namespace loft::fields {

using cdt::WayPart;

namespace {

/// What one sees from the parts of a way.
class Viewer {
 public:
  Viewer(const Field& field, Smoothness smoothness) : field_(field), smoothness_(smoothness) {}

  /// At a place that is on an edge of the part's triangle, or rounded to it.
  [[nodiscard]] std::optional<double> at_edge(EdgeId e, Point place) const {
    return if_any(field_.edge_value(e, place, smoothness_));
  }
  /// At a place that is exactly in the part or on its border.
  [[nodiscard]] std::optional<double> at(const WayPart& part, Point place) const {
    const Triangulation& mesh = field_.mesh();
    const EdgeId first = part.triangle.is_none() ? field_.seen_from(part.along, Side::left)
                                                 : Triangulation::edge(part.triangle);
    EdgeId e = first;
    do {
      if (mesh.from(e) != Triangulation::infinite && mesh.point(mesh.from(e)) == place)
        return if_any(field_.corner_value(e));
      e = Triangulation::next(e);
    } while (e != first);
    if (part.triangle.is_none()) return at_edge(first, place);
    do {
      if (cdt::orient(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), place) == 0)
        return at_edge(e, place);
      e = Triangulation::next(e);
    } while (e != first);
    const Patch patch(field_, part.triangle, smoothness_);
    return patch.has_values() ? std::optional(patch.value(place)) : std::nullopt;
  }

 private:
  const Field& field_;
  Smoothness smoothness_;
};

/// Goes along a line, segment by segment.
class Surveyor {
 public:
  Surveyor(const Field& field, Smoothness smoothness)
      : mesh_(field.mesh()), viewer_(field, smoothness) {}

  void survey(Point a, Point b) {
    start_ = a;
    start_distance_ = points_.empty() ? 0 : points_.back().distance;
    const cdt::Way way = cdt::passed_by(mesh_, a, b);
    if (points_.empty()) points_.push_back({.place = a, .distance = 0, .before = {}, .after = {}});
    if (way.parts.empty()) {
      if (!way.start.is_none() && mesh_.point(way.start) != a) touch(way.start);
    } else {
      enter(way, b);
      for (std::size_t i = 0; i < way.parts.size(); ++i)
        leave(way.parts[i], i + 1 < way.parts.size() ? &way.parts[i + 1] : nullptr, b);
    }
    if (points_.back().place != b || points_.size() == 1) add(b, {}, {});
  }

  /// A line that goes nowhere.
  [[nodiscard]] std::vector<ProfilePoint> finish() {
    if (!points_.empty()) {
      if (!points_.front().before) points_.front().before = points_.front().after;
      if (!points_.back().after) points_.back().after = points_.back().before;
    }
    return std::move(points_);
  }

 private:
  void add(Point place, std::optional<double> before, std::optional<double> after) {
    const Vector d = way(start_, place);
    const double distance =
        std::max(points_.back().distance, start_distance_ + std::sqrt(dot(d, d)));
    points_.push_back({.place = place, .distance = distance, .before = before, .after = after});
  }

  /// To where the first part begins: at the start, or where the hull is met.
  void enter(const cdt::Way& way, Point b) {
    const WayPart& first = way.parts.front();
    if (!way.entry.is_none()) {
      const Point place = crossing(way.entry, b);
      add(place, {}, viewer_.at_edge(mesh_.twin(way.entry), place));
    } else if (!way.start.is_none() && mesh_.point(way.start) != start_) {
      const Point place = mesh_.point(way.start);
      add(place, {}, viewer_.at(first, place));
    } else {
      points_.back().after = viewer_.at(first, start_);
    }
  }

  void leave(const WayPart& part, const WayPart* next, Point b) {
    if (!part.exit.is_none()) {
      const Point place = crossing(part.exit, b);
      add(place, viewer_.at_edge(part.exit, place),
          next == nullptr ? std::nullopt : viewer_.at_edge(mesh_.twin(part.exit), place));
    } else if (!part.end.is_none()) {
      const Point place = mesh_.point(part.end);
      add(place, viewer_.at(part, place),
          next == nullptr ? std::nullopt : viewer_.at(*next, place));
    } else {
      add(b, viewer_.at(part, b), {});
    }
  }

  /// A corner of the hull that the line only touches.
  void touch(VertexId v) {
    EdgeId e = mesh_.edge(v);
    while (mesh_.is_infinite(Triangulation::triangle(e)) && mesh_.rotated(e) != mesh_.edge(v))
      e = mesh_.rotated(e);
    const WayPart beside{
        .triangle = Triangulation::triangle(e), .along = {}, .exit = {}, .end = {}};
    const Point place = mesh_.point(v);
    const std::optional<double> value = viewer_.at(beside, place);
    add(place, value, value);
  }

  /// Of a line along the edge, rounded as the triangulation does.
  [[nodiscard]] Point crossing(EdgeId e, Point b) const {
    VertexId from = mesh_.from(e);
    VertexId to = mesh_.to(e);
    if (const auto passages = mesh_.passages(e); !passages.empty()) {
      const cdt::Segment& segment = mesh_.segment(passages.front().segment());
      from = segment.from;
      to = segment.to;
    }
    return cdt::intersection(start_, b, mesh_.point(from), mesh_.point(to));
  }

  const Triangulation& mesh_;
  Viewer viewer_;
  std::vector<ProfilePoint> points_;
  Point start_;  // of this segment
  double start_distance_ = 0;
};

}  // namespace

std::vector<ProfilePoint> profile(const Field& field, std::span<const Point> line,
                                  Smoothness smoothness) {
  Surveyor surveyor(field, smoothness);
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i] != line[i - 1]) surveyor.survey(line[i - 1], line[i]);
  return surveyor.finish();
}

Climb climb(std::span<const ProfilePoint> profile) {
  Climb sum;
  std::optional<double> last;
  const auto go_to = [&](std::optional<double> value) {
    if (last && value) (*value > *last ? sum.up : sum.down) += std::abs(*value - *last);
    last = value;
  };
  for (const ProfilePoint& point : profile) {
    go_to(point.before);
    go_to(point.after);
  }
  return sum;
}

}  // namespace loft::fields
