// SPDX-License-Identifier: MIT
// The values at the corners of triangles: what samples and lines claim, sector by sector.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "cdt/each_once.h"
#include "fields/along.h"
#include "fields/field_parts.h"

namespace loft::fields {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// At a vertex that is gone there is nothing.
void Field::settle(VertexId v) {
  if (v == Triangulation::infinite) return;
  conflicts_.erase(v);
  derived_state_[v.index()] = 0;
  if (!mesh_.is_vertex(v)) return;
  if (mesh_.edge(v).is_none())
    settle_lone(v);
  else if (is_made_by_soft_lines(v))
    leave_open(v);
  else
    settle_sectors(v);
}

/// Such a vertex is on the surface that is there without them, even on other lines.
bool Field::is_made_by_soft_lines(VertexId v) const {
  return firm_ && firm_->mesh_.locate(mesh_.point(v)).kind != cdt::Location::Kind::vertex;
}

void Field::leave_open(VertexId v) {
  const EdgeId first = mesh_.edge(v);
  EdgeId e = first;
  do {
    values_[e.index()] = no_value;
    e = mesh_.rotated(e);
  } while (e != first);
}

void Field::settle_lone(VertexId v) {
  claims_.clear();
  claim_samples(v);
  lone_value_ = resolve(v);
}

/// Each sector between walls, barriers and the outside gets the value that is claimed in it. (What
/// is outside counts for nothing, unless there is no triangle at all.)
void Field::settle_sectors(VertexId v) {
  gather_ring(v);
  const bool is_flat =
      std::all_of(ring_.begin(), ring_.end(), [&](EdgeId e) { return is_infinite(e); });
  std::size_t begin = 0;
  do {
    claims_.clear();
    claim_samples(v);
    std::size_t end = begin;
    do {
      claim_along(ring_[end], end == begin, false);
      ++end;
    } while (end < ring_.size() && !splits_[end]);
    claim_along(ring_[end % ring_.size()], false, true);
    const bool counts = is_flat || !is_infinite(ring_[begin]);
    const double value = counts ? resolve(v) : no_value;
    for (std::size_t i = begin; i < end; ++i) values_[ring_[i].index()] = value;
    begin = end;
  } while (begin < ring_.size());
}

/// The edges from a vertex, counter-clockwise, from where a sector begins, if any does.
void Field::gather_ring(VertexId v) {
  ring_.clear();
  splits_.clear();
  const EdgeId first = mesh_.edge(v);
  std::size_t begin = 0;
  EdgeId e = first;
  bool was_outside = is_infinite(mesh_.twin(first));
  do {
    const bool is_outside = is_infinite(e);
    const bool splits = is_outside != was_outside || has_line(e, separates);
    if (splits && begin == 0 && !(splits_.empty())) begin = ring_.size();
    ring_.push_back(e);
    splits_.push_back(splits);
    was_outside = is_outside;
    e = mesh_.rotated(e);
  } while (e != first);
  if (splits_.front()) return;
  std::rotate(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(begin), ring_.end());
  std::rotate(splits_.begin(), splits_.begin() + static_cast<std::ptrdiff_t>(begin), splits_.end());
}

void Field::claim_samples(VertexId v) {
  for (SampleId s = first_sample_[v.index()]; !s.is_none(); s = samples_[s.index()].next_here) {
    const Given& given = samples_[s.index()];
    claims_.push_back({{.sample = s, .line = {}, .value = given.value}, given.order, 0});
  }
}

/// What the lines along an edge from a vertex claim for a sector there: features wherever they are
/// in it, walls where it begins, on its left, and where it ends, on its right.
void Field::claim_along(EdgeId e, bool is_first, bool is_last) {
  for (const cdt::Passage passage : mesh_.passages(e)) {
    const Values* known = line_along(passage);
    if (known == nullptr) continue;
    const Values& line = *known;
    const cdt::ConstraintId c = mesh_.segment(passage.segment()).constraint;
    const std::size_t segment = passage.segment().index() - mesh_.first_segment(c).index();
    if (line.kind == LineKind::feature) claim_at(e, c, segment, line.left);
    if (line.kind != LineKind::wall) continue;
    const bool is_forward = mesh_.is_forward(e, passage);
    if (is_first) claim_at(e, c, segment, is_forward ? line.left : line.right);
    if (is_last) claim_at(e, c, segment, is_forward ? line.right : line.left);
  }
}

/// The value of a segment of a line at the vertex that e starts from.
void Field::claim_at(EdgeId e, cdt::ConstraintId line, std::size_t segment,
                     std::span<const double> given) {
  const cdt::Segment& along = mesh_.segments(line)[segment];
  const VertexId v = mesh_.from(e);
  const double start = given[segment];
  const double end = given[(segment + 1) % given.size()];
  const LineId id(line.index());
  const std::uint64_t order = lines_[line.index()]->order;
  if (v == along.from || v == along.to) {
    const double value = v == along.from ? start : end;
    claims_.push_back({{.sample = {}, .line = id, .value = value}, order, 0});
    return;
  }
  const Along place(mesh_.point(along.from), mesh_.point(along.to));
  const double value = place.between(start, end, mesh_.point(v));
  claims_.push_back({{.sample = {}, .line = id, .value = value}, order, place.slack(start, end)});
}

/// The value that the claims come to; not a number if there are none.
double Field::resolve(VertexId v) {
  if (claims_.empty()) return no_value;
  if (claims_.size() == 1) return claims_.front().claim.value;
  cdt::keep_each_once(claims_,
                      [](const Claimed& c) { return std::tuple(c.claim.value, c.order, c.slack); });
  const Claimed& low = claims_.front();
  const Claimed& high = claims_.back();
  const auto exactest =
      std::min_element(claims_.begin(), claims_.end(),
                       [](const Claimed& a, const Claimed& b) { return a.slack < b.slack; });
  double taken = exactest->claim.value;
  if (high.claim.value - low.claim.value <= low.slack + high.slack) return taken;
  if (policy_ == OnConflict::first) {
    taken =
        std::min_element(claims_.begin(), claims_.end(), [](const Claimed& a, const Claimed& b) {
          return a.order < b.order;
        })->claim.value;
  } else {
    double sum = 0;
    for (const Claimed& c : claims_) sum += c.claim.value / static_cast<double>(claims_.size());
    taken = sum;
  }
  note_conflict(v, taken);
  return taken;
}

void Field::note_conflict(VertexId v, double taken) {
  Conflict conflict{.place = mesh_.point(v), .claims = {}, .taken = taken};
  for (const Claimed& c : claims_) conflict.claims.push_back(c.claim);
  conflicts_[v].push_back(std::move(conflict));
}

}  // namespace loft::fields
