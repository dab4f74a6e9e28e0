// SPDX-License-Identifier: MIT
// The gradients at corners of triangles, each fitted to the values around in its sector.
#include <vector>

#include "cdt/each_once.h"
#include "cdt/sector.h"
#include "fields/field.h"
#include "fields/fit.h"
#include "fields/kept.h"

namespace loft::fields {

namespace {

/// Whether a gradient is another beyond an edge.
bool parts_gradients(const Field& field, EdgeId e) {
  return field.is_separating(e) || field.is_crease(e);
}

}  // namespace

Vector Field::corner_gradient(EdgeId e) const {
  if (is_infinite(e)) return {};
  const VertexId v = mesh_.from(e);
  Kept kept(gradient_state_[v.index()], epoch_);
  if (kept.holds()) return gradients_[e.index()];
  bool reads_derived = false;
  if (!kept.begin()) return find_gradient(e, reads_derived);
  const auto parts = [&](EdgeId side) { return parts_gradients(*this, side); };
  const EdgeId first = cdt::sector_begin(mesh_, e, parts);
  EdgeId here = first;
  do {
    const Vector gradient = is_infinite(here) ? Vector{} : find_gradient(here, reads_derived);
    here = cdt::visit_sector(mesh_, here, parts,
                             [&](EdgeId corner) { gradients_[corner.index()] = gradient; });
  } while (here != first);
  kept.keep(reads_derived);
  return gradients_[e.index()];
}

/// From what is in the sector: the corners of its triangles and of those beside them; if it is not
/// all around the vertex, also of those beside these, as there is less.
Vector Field::find_gradient(EdgeId e, bool& reads_derived) const {
  std::vector<Around> around;
  const auto look_at = [&](EdgeId corner) {
    reads_derived = reads_derived || values_[corner.index()] != values_[corner.index()];
    const double value = corner_value(corner);
    if (value == value && mesh_.from(corner) != mesh_.from(e))
      around.push_back({mesh_.point(mesh_.from(corner)), value});
  };
  reads_derived = reads_derived || values_[e.index()] != values_[e.index()];
  const auto parts = [&](EdgeId side) { return parts_gradients(*this, side); };
  const bool is_part = parts(cdt::sector_begin(mesh_, e, parts));
  cdt::visit_sector(mesh_, e, parts, [&](EdgeId here) {
    const EdgeId opposite = Triangulation::next(here);
    look_at(opposite);
    look_at(Triangulation::prev(here));
    if (!parts(opposite)) {
      const EdgeId beyond = mesh_.twin(opposite);
      look_at(Triangulation::prev(beyond));
      if (is_part)
        for (const EdgeId side : {Triangulation::next(beyond), Triangulation::prev(beyond)})
          if (!parts(side)) look_at(Triangulation::prev(mesh_.twin(side)));
    }
  });
  cdt::keep_each_once(around);
  const double value = corner_value(e);
  if (around.empty() || !(value == value)) return {};
  return fit_gradient(mesh_.point(mesh_.from(e)), value, around);
}

/// After something at a vertex: of those whose gradients look at it.
void Field::forget_gradients_around(VertexId v) {
  if (!mesh_.is_vertex(v)) return;
  gradient_state_[v.index()] = 0;
  const EdgeId first = mesh_.edge(v);
  if (first.is_none()) return;
  EdgeId here = first;
  do {
    const EdgeId opposite = Triangulation::next(here);
    gradient_state_[mesh_.from(opposite).index()] = 0;
    const EdgeId beyond = mesh_.twin(opposite);
    gradient_state_[mesh_.apex(beyond).index()] = 0;
    for (const EdgeId side : {Triangulation::next(beyond), Triangulation::prev(beyond)})
      gradient_state_[mesh_.apex(mesh_.twin(side)).index()] = 0;
    here = mesh_.rotated(here);
  } while (here != first);
}

}  // namespace loft::fields
