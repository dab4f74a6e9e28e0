// SPDX-License-Identifier: MIT
#include "fields/classes.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace loft::fields {

using cdt::EdgeId;
using cdt::Triangulation;
using cdt::VertexId;

// Points.

PointId Classes::insert(Point p, double value) { return insert({&p, 1}, {&value, 1})[0]; }

std::vector<PointId> Classes::insert(std::span<const Point> points,
                                     std::span<const double> values) {
  if (!values.empty() && values.size() != points.size())
    throw std::invalid_argument("classes: " + std::to_string(points.size()) + " points and " +
                                std::to_string(values.size()) + " values");
  std::vector<cdt::Polyline> polylines;
  polylines.reserve(points.size());
  for (const Point& p : points) polylines.push_back({{&p, 1}});
  std::vector<PointId> ids = mesh_.insert(polylines);
  changed_.clear();
  grow();
  for (std::size_t i = 0; i < ids.size(); ++i) list(ids[i], values.empty() ? 0 : values[i]);
  sort_changed();
  return ids;
}

void Classes::move(PointId id, Point to) {
  check_known(id);
  if (!Triangulation::is_usable(to))
    throw std::invalid_argument("classes: a coordinate of point " + std::to_string(id.index()) +
                                " is not usable");
  const std::uint32_t before = class_of_[mesh_.first_vertex(id).index()];
  unlist(id);
  mesh_.move(id, {&to, 1});
  changed_.clear();
  grow();
  list(id, value(id));
  if (class_of_[mesh_.first_vertex(id).index()] == before) changed_.clear();
}

void Classes::set_value(PointId id, double value) {
  check_known(id);
  values_[id.index()] = value;
  changed_.clear();
}

void Classes::remove(PointId id) {
  check_known(id);
  unlist(id);
  mesh_.remove(id);
  changed_.clear();
}

void Classes::check_known(PointId id) const {
  if (!is_point(id))
    throw std::invalid_argument("classes: there is no point " + std::to_string(id.index()));
}

/// Makes room for all that is in the triangulation.
void Classes::grow() {
  const std::size_t vertices = mesh_.vertex_bound();
  first_here_.resize(vertices);
  class_of_.resize(vertices, no_class);
  differences_.resize(vertices);
  for (auto& kept : separators_)
    if (kept) kept->standings.resize(vertices);
  values_.resize(point_bound());
  next_here_.resize(point_bound());
}

/// A point has come to where it is.
void Classes::list(PointId id, double value) {
  const VertexId v = mesh_.first_vertex(id);
  values_[id.index()] = value;
  if (first_here_[v.index()].is_none()) enter(v);
  next_here_[id.index()] = std::exchange(first_here_[v.index()], id);
  ++table_.count(class_of_[v.index()]);
  changed_.push_back(id);
}

void Classes::unlist(PointId id) {
  const VertexId v = mesh_.first_vertex(id);
  PointId* link = &first_here_[v.index()];
  while (*link != id) link = &next_here_[link->index()];
  *link = next_here_[id.index()];
  --table_.count(class_of_[v.index()]);
}

/// A vertex gets its first point.
void Classes::enter(VertexId v) {
  signs_.clear();
  for (auto& kept : separators_) {
    if (!kept) continue;
    kept->standings[v.index()] = kept->line.standing(mesh_.point(v));
    signs_.push_back(kept->standings[v.index()].sign());
  }
  class_of_[v.index()] = table_.number(signs_);
}

void Classes::sort_changed() { std::ranges::sort(changed_); }

// Separators.

SeparatorId Classes::insert_separator(std::span<const Point> points) {
  Separator line({points.begin(), points.end()});
  const auto spare = std::ranges::find_if(separators_, [](const auto& one) { return !one; });
  const SeparatorId id(static_cast<std::uint32_t>(spare - separators_.begin()));
  if (spare == separators_.end()) separators_.emplace_back();
  Kept& kept = separators_[id.index()].emplace(Kept{std::move(line), {}, {}});
  kept.vertices = place(points);
  grow();
  find_standings(
      {.gone = {}, .come = {{&kept.line, {0, kept.line.pieces().size()}}, kept.vertices}});
  for (const VertexId v : beside_.vertices()) kept.standings[v.index()] = differences_[v.index()];
  classify_all();
  return id;
}

namespace {

/// How many points two lines have in common at their beginnings, and then at their ends.
std::pair<std::size_t, std::size_t> common_ends(std::span<const Point> a,
                                                std::span<const Point> b) {
  const auto first = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
  std::size_t last = 0;
  const std::size_t most = std::min(a.size(), b.size()) - first;
  while (last < most && a[a.size() - 1 - last] == b[b.size() - 1 - last]) ++last;
  return {first, last};
}

}  // namespace

void Classes::move(SeparatorId id, std::span<const Point> points) {
  Kept& kept = known(id);
  Separator line({points.begin(), points.end()});
  changed_.clear();
  const auto [first, last] = common_ends(kept.line.points(), points);
  std::vector<VertexId> vertices = place(points.subspan(first, points.size() - first - last));
  vertices.insert(vertices.begin(), kept.vertices.begin(),
                  kept.vertices.begin() + static_cast<std::ptrdiff_t>(first));
  vertices.insert(vertices.end(), kept.vertices.end() - static_cast<std::ptrdiff_t>(last),
                  kept.vertices.end());
  grow();
  find_standings({.gone = {{&kept.line, own_pieces(kept.line, line)}, kept.vertices},
                  .come = {{&line, own_pieces(line, kept.line)}, vertices}});
  const auto number = static_cast<std::size_t>(
      std::ranges::count_if(separators_.begin(), separators_.begin() + id.index(),
                            [](const auto& one) { return !!one; }));
  for (const VertexId v : beside_.vertices()) {
    if (first_here_[v.index()].is_none()) continue;
    Standing& standing = kept.standings[v.index()];
    const Sign before = standing.sign();
    standing += differences_[v.index()];
    if (standing.sign() != before) change_sign(v, number, standing.sign());
  }
  sort_changed();
  take_away(std::span(kept.vertices).subspan(first, kept.vertices.size() - first - last));
  kept.line = std::move(line);
  kept.vertices = std::move(vertices);
}

void Classes::translate(SeparatorId id, Point by) {
  const std::span<const Point> now = known(id).line.points();
  std::vector<Point> moved(now.begin(), now.end());
  for (Point& p : moved) p = {p.x + by.x, p.y + by.y};
  move(id, moved);
}

void Classes::remove(SeparatorId id) {
  take_away(known(id).vertices);
  separators_[id.index()].reset();
  classify_all();
}

std::vector<SeparatorId> Classes::separators() const {
  std::vector<SeparatorId> result;
  for (std::uint32_t i = 0; i < separators_.size(); ++i)
    if (separators_[i]) result.emplace_back(i);
  return result;
}

Classes::Kept& Classes::known(SeparatorId id) {
  if (!is_separator(id))
    throw std::invalid_argument("classes: there is no separator " + std::to_string(id.index()));
  return *separators_[id.index()];
}

std::vector<VertexId> Classes::place(std::span<const Point> points) {
  std::vector<VertexId> vertices;
  vertices.reserve(points.size());
  for (const Point& p : points) vertices.push_back(mesh_.insert(p));
  return vertices;
}

void Classes::take_away(std::span<const VertexId> vertices) {
  for (const VertexId v : vertices) mesh_.remove(v);
}

/// The vertices beside all that is gone and has come; all there are where these have no triangle.
void Classes::find_beside(const Move& move) {
  beside_.begin(mesh_);
  bool is_flat = false;
  for (const Half& half : {move.gone, move.come})
    for (std::size_t i = half.some.own.first; i < half.some.own.last; ++i)
      is_flat |= !beside_.add(half.some.line->pieces()[i], half.vertices[i == 0 ? 0 : i - 1]);
  if (!is_flat) return;
  for (std::uint32_t i = 1; i < mesh_.vertex_bound(); ++i)
    if (mesh_.is_vertex(VertexId(i))) beside_.add(VertexId(i));
}

/// What a move adds to the standings of vertices: of those beside it, and of those behind them,
/// which no piece parts from one that it winds around.
void Classes::find_standings(const Move& move) {
  find_beside(move);
  const StandingChange change(move.gone.some, move.come.some);
  for (const VertexId v : beside_.vertices()) differences_[v.index()] = change.at(mesh_.point(v));
  for (std::size_t i = 0; i < beside_.vertices().size(); ++i) {
    const VertexId v = beside_.vertices()[i];
    const std::int32_t winding = differences_[v.index()].winding;
    const EdgeId first = mesh_.edge(v);
    if (winding == 0 || first.is_none()) continue;
    EdgeId e = first;
    do {
      const VertexId w = mesh_.to(e);
      if (w != Triangulation::infinite && beside_.add(w)) differences_[w.index()] = {winding, 0};
      e = mesh_.rotated(e);
    } while (e != first);
  }
}

// Classes.

void Classes::change_sign(VertexId v, std::size_t place, Sign sign) {
  std::uint32_t& number = class_of_[v.index()];
  const std::uint32_t before = number;
  number = table_.with(before, place, sign);
  for (PointId p = first_here_[v.index()]; !p.is_none(); p = next_here_[p.index()]) {
    --table_.count(before);
    ++table_.count(number);
    changed_.push_back(p);
  }
}

/// The separators are others: so are all vectors.
void Classes::classify_all() {
  table_.begin(separators().size());
  changed_.clear();
  for (std::size_t v = 0; v < first_here_.size(); ++v) {
    if (first_here_[v].is_none()) continue;
    signs_.clear();
    for (const auto& kept : separators_)
      if (kept) signs_.push_back(kept->standings[v].sign());
    class_of_[v] = table_.number(signs_);
    for (PointId p = first_here_[v]; !p.is_none(); p = next_here_[p.index()]) {
      ++table_.count(class_of_[v]);
      changed_.push_back(p);
    }
  }
  sort_changed();
}

Sign Classes::sign(PointId point, SeparatorId separator) const {
  return separators_[separator.index()]->standings[mesh_.first_vertex(point).index()].sign();
}

std::vector<Sign> Classes::signs(Point place) const {
  std::vector<Sign> result;
  for (const auto& kept : separators_)
    if (kept) result.push_back(kept->line.sign(place));
  return result;
}

std::vector<ClassCount> Classes::classes() const {
  std::vector<ClassCount> result;
  table_.for_each([&](const std::vector<Sign>& signs, std::uint32_t, std::size_t count) {
    result.push_back({signs, count});
  });
  return result;
}

std::vector<PointId> Classes::points_with(std::span<const Sign> signs) const {
  std::vector<PointId> result;
  for (std::uint32_t i = 0; i < point_bound(); ++i)
    if (is_point(PointId(i)) && std::ranges::equal(this->signs(PointId(i)), signs))
      result.emplace_back(i);
  return result;
}

}  // namespace loft::fields
