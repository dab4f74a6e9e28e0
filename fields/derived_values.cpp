// SPDX-License-Identifier: MIT
// The values at corners where nothing gives one: on soft lines and beside barriers.
#include <cmath>
#include <limits>
#include <unordered_set>
#include <vector>

#include "cdt/each_once.h"
#include "cdt/sector.h"
#include "fields/field_parts.h"
#include "fields/fit.h"
#include "fields/kept.h"

namespace loft::fields {

namespace {

/// What a plane is fitted to: at least so many values, unless there are fewer.
constexpr std::size_t enough_values = 8;
/// Rings are looked at until so many triangles were, if there is any value.
constexpr std::size_t most_triangles = 4096;

/// Whether p comes before q on the way from a to b, which both are on or rounded to.
bool is_before(Point p, Point q, Point a, Point b) {
  return std::abs(b.x - a.x) > std::abs(b.y - a.y) ? (p.x < q.x) == (a.x < b.x) && p.x != q.x
                                                   : (p.y < q.y) == (a.y < b.y) && p.y != q.y;
}

/// The triangles around a corner that no wall or barrier parts from it, ring by ring.
class Rings {
 public:
  Rings(const Field& field, EdgeId e) : field_(field) {
    cdt::visit_sector(
        field.mesh(), e, [&](EdgeId side) { return field.is_separating(side); },
        [&](EdgeId here) { enter(Triangulation::triangle(here)); });
  }

  [[nodiscard]] const std::vector<TriangleId>& outermost() const { return outermost_; }
  [[nodiscard]] std::size_t size() const { return seen_.size(); }
  /// Whether there is another ring.
  [[nodiscard]] bool widen() {
    const std::vector<TriangleId> inner = std::move(outermost_);
    outermost_.clear();
    for (const TriangleId t : inner)
      for (unsigned corner = 0; corner < 3; ++corner)
        if (const EdgeId e = Triangulation::edge(t, corner); !field_.is_separating(e))
          enter(Triangulation::triangle(field_.mesh().twin(e)));
    return !outermost_.empty();
  }

 private:
  void enter(TriangleId t) {
    if (!field_.mesh().is_infinite(t) && seen_.insert(t).second) outermost_.push_back(t);
  }

  const Field& field_;
  std::unordered_set<TriangleId> seen_;
  std::vector<TriangleId> outermost_;
};

}  // namespace

double Field::derived_value(EdgeId e) const {
  const VertexId v = mesh_.from(e);
  if (v == Triangulation::infinite || is_infinite(e)) return values_[e.index()];
  Kept kept(derived_state_[v.index()], epoch_);
  if (kept.holds()) return derived_[e.index()];
  if (!kept.begin()) return find_derived_value(e);
  EdgeId here = e;
  do {
    const bool is_given = values_[here.index()] == values_[here.index()];
    if (!is_given && !is_infinite(here)) derived_[here.index()] = find_derived_value(here);
    here = mesh_.rotated(here);
  } while (here != e);
  kept.keep(true);
  return derived_[e.index()];
}

/// Where there are soft lines, that of the surface without them: at a place on walls and barriers,
/// on that side of the one that the sector begins or ends at.
double Field::find_derived_value(EdgeId e) const {
  if (firm_)
    if (const double value = firm_value(e); value == value) return value;
  // Beyond the hull of all else there may be values where barriers enclose none inside of it.
  return fit_from_around(e);
}

double Field::firm_value(EdgeId e) const {
  const EdgeId first =
      cdt::sector_begin(mesh_, e, [&](EdgeId side) { return is_separating(side); });
  if (const auto value = firm_value_beside(first, true)) return *value;
  EdgeId last = mesh_.rotated(e);
  while (last != e && !is_separating(last)) last = mesh_.rotated(last);
  if (const auto value = firm_value_beside(last, false)) return *value;
  return firm_->value(mesh_.point(mesh_.from(e)), Smoothness::linear, Side::left, Outside::nearest)
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

/// The value at from(e), on a side of e, in the field without soft lines, if a wall or barrier is
/// along e. The place may be off it by rounding, so it is looked for along that line.
std::optional<double> Field::firm_value_beside(EdgeId e, bool is_on_left) const {
  bool is_forward = false;
  const std::optional<cdt::Passage> passage = first_separator(e, is_forward);
  if (!passage) return std::nullopt;
  const cdt::Segment& segment = mesh_.segment(passage->segment());
  const LineId line = lines_[segment.constraint.index()]->firm;
  const std::uint32_t number =
      passage->segment().index() - mesh_.first_segment(segment.constraint).index();
  const Triangulation& firm = firm_->mesh_;
  const cdt::SegmentId same(firm.first_segment(cdt::ConstraintId(line.index())).index() + number);
  const Point place = mesh_.point(mesh_.from(e));
  const Point start = firm.point(firm.segment(same).from);
  const Point end = firm.point(firm.segment(same).to);
  // The piece that goes on from the place as e does.
  for (const EdgeId piece : firm.pieces(same)) {
    const Point to = firm.point(firm.to(piece));
    if (is_forward ? !is_before(place, to, start, end) : is_before(to, place, start, end)) continue;
    const EdgeId seen = is_on_left == is_forward ? piece : firm.twin(piece);
    if (firm_->is_infinite(seen)) return std::nullopt;
    return firm_->edge_value(seen, place);
  }
  return std::nullopt;
}

double Field::fit_from_around(EdgeId e) const {
  Rings rings(*this, e);
  std::vector<Around> around;
  const Point at = mesh_.point(mesh_.from(e));
  do {
    for (const TriangleId t : rings.outermost())
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId c = Triangulation::edge(t, corner);
        const double given = values_[c.index()];
        if (given == given && mesh_.point(mesh_.from(c)) != at)
          around.push_back({mesh_.point(mesh_.from(c)), given});
      }
    // In an order that depends on nothing but the coordinates.
    cdt::keep_each_once(around);
    if (around.size() < enough_values) continue;
    if (const auto value = plane_value(at, around)) return *value;
  } while ((around.empty() || rings.size() < most_triangles) && rings.widen());
  if (around.empty()) return std::numeric_limits<double>::quiet_NaN();
  return nearest_plane_value(at, around);
}

}  // namespace loft::fields
