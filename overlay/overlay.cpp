// SPDX-License-Identifier: MIT
#include "overlay/overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "cdt/predicates.h"
#include "overlay/distance.h"
#include "overlay/expression_difference.h"
#include "overlay/parts.h"

namespace loft::overlay {

using cdt::TriangleId;
using cdt::Triangulation;

Overlay::Overlay() : parts_(std::make_unique<Parts>()) {}
Overlay::~Overlay() = default;
Overlay::Overlay(Overlay&&) noexcept = default;
Overlay& Overlay::operator=(Overlay&&) noexcept = default;

// Layers.

LayerId Overlay::add_layer(std::string name, FillRule rule) {
  parts_->layers.push_back({std::move(name), rule, {}});
  parts_->windings.add_layer(rule);
  return LayerId(static_cast<std::uint32_t>(parts_->layers.size() - 1));
}

std::size_t Overlay::layer_count() const { return parts_->layers.size(); }
const std::string& Overlay::name(LayerId layer) const { return parts_->known(layer).name; }
FillRule Overlay::rule(LayerId layer) const { return parts_->known(layer).rule; }
std::span<const RingId> Overlay::rings(LayerId layer) const { return parts_->known(layer).rings; }
LayerId Overlay::layer(RingId ring) const { return parts_->listings[ring.index()].layer; }

// Edits.

RingId Overlay::insert(LayerId layer, std::span<const Point> points, Ends ends) {
  (void)parts_->known(layer);
  parts_->check_usable(layer, points);
  const RingId ring = parts_->mesh.insert(points, ends);
  parts_->list(ring, layer);
  parts_->finish_edit();
  return ring;
}

std::vector<RingId> Overlay::insert(std::span<const Shape> shapes) {
  std::vector<cdt::Polyline> polylines;
  std::size_t point_count = 0;
  for (const Shape& shape : shapes) {
    (void)parts_->known(shape.layer);
    parts_->check_usable(shape.layer, shape.points);
    polylines.push_back({shape.points, shape.ends});
    point_count += shape.points.size();
  }
  // As much again as there is: it costs less to begin anew than to follow.
  const bool is_large = !parts_->is_in_batch && point_count > parts_->mesh.vertex_count();
  if (is_large) parts_->mesh.record_changes(false);
  const std::vector<RingId> rings = parts_->mesh.insert(polylines);
  for (std::size_t i = 0; i < rings.size(); ++i) parts_->list(rings[i], shapes[i].layer);
  if (is_large) {
    parts_->mesh.record_changes(true);
    parts_->rebuild();
  } else {
    parts_->finish_edit();
  }
  return rings;
}

void Overlay::move(RingId ring, std::span<const Point> points) {
  parts_->check_known(ring);
  parts_->check_usable(layer(ring), points);
  parts_->mesh.move(ring, points);
  parts_->finish_edit();
}

void Overlay::translate(RingId ring, Point by) {
  parts_->check_known(ring);
  std::vector<Point> moved = parts_->mesh.points(ring);
  for (Point& p : moved) p = {p.x + by.x, p.y + by.y};
  parts_->check_usable(layer(ring), moved);
  parts_->mesh.move(ring, moved);
  parts_->finish_edit();
}

void Overlay::remove(RingId ring) {
  parts_->check_known(ring);
  parts_->unlist(ring);
  parts_->mesh.remove(ring);
  parts_->finish_edit();
}

/// In a batch of its own, unless there is one.
template <class Edits>
void Overlay::as_one_edit(Edits edits) {
  const bool is_own_batch = !parts_->is_in_batch;
  if (is_own_batch) begin_batch();
  edits();
  if (is_own_batch) end_batch();
}

void Overlay::translate(LayerId layer, Point by) { transform(layer, {.x0 = by.x, .y0 = by.y}); }

void Overlay::transform(LayerId layer, const Affine& map) {
  std::vector<std::vector<Point>> moved;
  for (const RingId ring : parts_->known(layer).rings) {
    moved.push_back(parts_->mesh.points(ring));
    for (Point& p : moved.back()) p = map(p);
    parts_->check_usable(layer, moved.back());
  }
  const std::vector<RingId>& rings = parts_->known(layer).rings;
  as_one_edit([&] {
    for (std::size_t i = 0; i < rings.size(); ++i) parts_->mesh.move(rings[i], moved[i]);
  });
}

void Overlay::clear(LayerId layer) {
  Layer& one = parts_->known(layer);
  as_one_edit([&] {
    for (const RingId ring : one.rings) parts_->mesh.remove(ring);
  });
  one.rings.clear();
}

void Overlay::begin_batch() {
  parts_->is_in_batch = true;
  parts_->mesh.begin_batch();
}

void Overlay::end_batch() {
  parts_->mesh.end_batch();
  parts_->is_in_batch = false;
  parts_->finish_edit();
}

// Results.

namespace {

/// A result of an expression, which is checked.
Result checked_result(Expression what, std::size_t layer_count) {
  for (const Expression::Term& term : what.terms())
    if (term.kind == Expression::Term::Kind::layer && term.layer.index() >= layer_count)
      throw std::invalid_argument("overlay: the expression has a layer that is not there");
  Result result(std::move(what));
  if (result.formula.is_true_outside())
    throw std::invalid_argument(
        "overlay: the expression is true where no layer is, so without bounds; subtract from a "
        "frame instead");
  return result;
}

}  // namespace

ResultId Overlay::watch(Expression what) {
  Result result = checked_result(std::move(what), layer_count());
  parts_->learn_truths(result);
  parts_->build_border(result);
  auto& results = parts_->results;
  const auto spare = std::ranges::find_if(results, [](const auto& other) { return !other; });
  const auto number = static_cast<std::uint32_t>(spare - results.begin());
  if (spare == results.end()) results.emplace_back();
  results[number].emplace(std::move(result));
  return ResultId(number);
}

void Overlay::set(ResultId result, Expression what) {
  Result& one = parts_->known(result);
  const auto layers = layers_of_difference(one.what, what);
  Result other = checked_result(std::move(what), layer_count());
  one.what = std::move(other.what);
  one.formula = std::move(other.formula);
  one.change = {};
  parts_->check_truths(
      one, layers ? parts_->windings.covers_with(*layers) : parts_->windings.all_covers());
  parts_->sum_up(one);
}

void Overlay::unwatch(ResultId result) {
  (void)parts_->known(result);
  parts_->results[result.index()].reset();
}

const Expression& Overlay::expression(ResultId result) const { return parts_->known(result).what; }
const ResultChange& Overlay::change(ResultId result) const { return parts_->known(result).change; }
const ExactArea& Overlay::area(ResultId result) const { return parts_->known(result).area; }

std::span<const BorderEdge> Overlay::border(ResultId result) const {
  return parts_->known(result).border.edges();
}

std::vector<TracedPolygon> Overlay::traces(ResultId result) const {
  const Result& one = parts_->known(result);
  return trace(parts_->region(one), one.border.edges());
}

MultiPolygon Overlay::polygons(ResultId result, Vertices vertices) const {
  MultiPolygon polygons;
  for (const TracedPolygon& traced : traces(result))
    polygons.push_back(points_of(parts_->mesh, traced, vertices == Vertices::needed));
  return polygons;
}

std::vector<Ring> Overlay::changed_rings(ResultId result, Vertices vertices) const {
  const Result& one = parts_->known(result);
  std::vector<Ring> rings;
  for (const TracedRing& ring : trace_through(parts_->region(one), one.change.come))
    rings.push_back(points_of(parts_->mesh, ring, vertices == Vertices::needed));
  std::ranges::sort(rings);
  return rings;
}

bool Overlay::is_in(ResultId result, TriangleId t) const {
  return parts_->region(parts_->known(result)).at(t) != 0;
}

// Covers.

CoverId Overlay::cover(TriangleId t) const { return parts_->covers.by_triangle()[t.index()]; }

std::span<const CoverId> Overlay::covers() const { return parts_->covers.by_triangle(); }

std::span<const LayerId> Overlay::layers(CoverId cover) const {
  return parts_->windings.layers(cover);
}

std::size_t Overlay::cover_bound() const { return parts_->windings.cover_count(); }

std::vector<TriangleId> Overlay::triangles(CoverId cover) const {
  std::vector<TriangleId> result;
  parts_->covers.for_each(cover, [&](TriangleId t) { result.push_back(t); });
  return result;
}

namespace {

/// What is in all of some covers, and what is in one of them and not in all.
class CoverAround {
 public:
  void add(std::span<const LayerId> layers) {
    ++count_;
    met_.insert(met_.end(), layers.begin(), layers.end());
  }

  [[nodiscard]] Cover summed_up() {
    std::ranges::sort(met_);
    Cover result;
    for (auto at = met_.begin(); at != met_.end();) {
      const auto next = std::upper_bound(at, met_.end(), *at);
      (next - at == count_ ? result.inside : result.on_border_of).push_back(*at);
      at = next;
    }
    return result;
  }

 private:
  std::ptrdiff_t count_ = 0;
  std::vector<LayerId> met_;
};

}  // namespace

Cover Overlay::cover(Point p) const {
  using Where = cdt::Location::Kind;
  const Triangulation& mesh = parts_->mesh;
  const cdt::Location place = mesh.locate(p);
  CoverAround around;
  const auto add_left_of = [&](EdgeId e) { around.add(layers(cover(Triangulation::triangle(e)))); };
  switch (place.kind) {
    case Where::nowhere:
    case Where::outside:
      break;
    case Where::triangle:
      add_left_of(place.edge);
      break;
    case Where::edge:
      add_left_of(place.edge);
      add_left_of(mesh.twin(place.edge));
      break;
    case Where::vertex:
      for (EdgeId e = place.edge;;) {
        add_left_of(e);
        if ((e = mesh.rotated(e)) == place.edge) break;
      }
  }
  return around.summed_up();
}

namespace {

double last_place(double x) {
  const double size = std::abs(x);
  return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
}

/// Whether a segment leads through a vertex that is not exactly on it.
bool bends_at(const Triangulation& mesh, cdt::SegmentId s, cdt::VertexId v) {
  const cdt::Segment& segment = mesh.segment(s);
  if (segment.from == v || segment.to == v) return false;
  return cdt::orient(mesh.point(segment.from), mesh.point(segment.to), mesh.point(v)) != 0;
}

}  // namespace

double Overlay::area_error_bound() const {
  const Triangulation& mesh = parts_->mesh;
  double sum = 0;
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!mesh.is_triangle(Triangulation::triangle(e)) || !mesh.is_constrained(e)) continue;
    const Point at = mesh.point(mesh.from(e));
    const double reach = (last_place(at.x) + last_place(at.y)) / 2;
    for (const cdt::Passage passage : mesh.passages(e))
      if (bends_at(mesh, passage.segment(), mesh.from(e)))
        sum += reach * distance(at, mesh.point(mesh.to(e)));
  }
  for (const cdt::Snap& snap : mesh.snaps()) {
    const cdt::Segment& segment = mesh.segment(snap.segment);
    const Point from = mesh.point(segment.from);
    const Point to = mesh.point(segment.to);
    const double largest =
        std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
    sum += 0x1p-50 * largest * distance(from, to);
  }
  return sum * (1 + 0x1p-20);
}

std::vector<RingId> Overlay::rings_without_inside() const {
  const Triangulation& mesh = parts_->mesh;
  std::vector<RingId> result;
  for (std::uint32_t i = 0; i < mesh.constraint_bound(); ++i) {
    const RingId ring(i);
    if (!mesh.is_constraint(ring) || mesh.ends(ring) == open) continue;
    std::vector<Point> points = mesh.points(ring);
    std::ranges::sort(points);
    if (std::unique(points.begin(), points.end()) - points.begin() < 3) result.push_back(ring);
  }
  return result;
}

const Triangulation& Overlay::triangulation() const { return parts_->mesh; }
std::size_t Overlay::revision() const { return parts_->revision; }

std::span<const cdt::TriangleId> Overlay::recovered() const { return parts_->follower.changed(); }

}  // namespace loft::overlay
