// SPDX-License-Identifier: MIT
// The gradients at corners of triangles, each fitted to the values around in its sector.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
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

/// What is opposite a vertex, all around, beginning with the smallest neighbour.
class Opposite {
 public:
  /// Precondition: there is a finite triangle on the left of e.
  Opposite(const Triangulation& mesh, EdgeId e) {
    EdgeId here = e;
    do {
      const VertexId neighbour = mesh.to(here);
      is_parted_ = neighbour == Triangulation::infinite || mesh.is_constrained(here) ||
                   count_ == edges_.size();
      if (is_parted_) return;
      edges_[count_++] = Triangulation::next(here);
      here = mesh.rotated(here);
    } while (here != e);
    const auto place = [&](EdgeId opposite) { return mesh.point(mesh.from(opposite)); };
    const auto end = edges_.begin() + static_cast<std::ptrdiff_t>(count_);
    std::rotate(edges_.begin(),
                std::min_element(edges_.begin(), end,
                                 [&](EdgeId a, EdgeId b) { return place(a) < place(b); }),
                end);
  }

  /// Whether constrained edges or the hull meet the vertex, or more edges than this is made for.
  [[nodiscard]] bool is_parted() const { return is_parted_; }
  [[nodiscard]] std::span<const EdgeId> edges() const { return {edges_.data(), count_}; }

  static constexpr std::size_t most = 16;

 private:
  std::array<EdgeId, most> edges_;
  std::size_t count_ = 0;
  bool is_parted_ = false;
};

/// The values around, each once.
class Surroundings {
 public:
  /// Precondition: there is a value, and it is not there yet.
  void add_new(VertexId v, Point p, double value) {
    vertices_[count_] = v;
    places_[count_++] = {p, value};
  }
  void add(VertexId v, Point p, double value) {
    if (!has(v) || !has({p, value})) add_new(v, p, value);
  }
  [[nodiscard]] std::span<const Around> places() const { return {places_.data(), count_}; }

 private:
  [[nodiscard]] bool has(VertexId v) const {  // often asked: without a branch for each
    bool is_there = false;
    for (std::size_t i = 0; i < count_; ++i) is_there |= vertices_[i] == v;
    return is_there;
  }
  [[nodiscard]] bool has(const Around& around) const {
    return std::ranges::find(places(), around) != places().end();
  }

  static constexpr std::size_t most = 2 * Opposite::most;
  std::array<Around, most> places_;
  std::array<VertexId, most> vertices_;
  std::size_t count_ = 0;
};

}  // namespace

Vector Field::corner_gradient(EdgeId e) const {
  if (is_infinite(e)) return {};
  Rise& rise = rises_[mesh_.from(e).index()];
  Kept kept(rise.state, epoch_);
  if (kept.holds()) return kept.is_same_all_around() ? rise.gradient : gradients_[e.index()];
  bool reads_derived = false;
  if (!kept.begin()) return find_gradient(e, reads_derived);
  if (const auto gradient = find_whole_gradient(e, reads_derived)) {
    rise.gradient = *gradient;
    kept.keep(reads_derived, true);
    return *gradient;
  }
  const auto parts = [&](EdgeId side) { return parts_gradients(*this, side); };
  const EdgeId first = cdt::sector_begin(mesh_, e, parts);
  EdgeId here = first;
  do {
    const Vector gradient =
        is_infinite(here) ? Vector{} : find_sector_gradient(here, reads_derived);
    here = cdt::visit_sector(mesh_, here, parts,
                             [&](EdgeId corner) { gradients_[corner.index()] = gradient; });
  } while (here != first);
  kept.keep(reads_derived);
  return gradients_[e.index()];
}

Vector Field::find_gradient(EdgeId e, bool& reads_derived) const {
  if (const auto gradient = find_whole_gradient(e, reads_derived)) return *gradient;
  return find_sector_gradient(e, reads_derived);
}

/// Where no line meets the vertex, as nearly everywhere: from the corners of the triangles around
/// and of those beside them, in an order that does not depend on the edge.
std::optional<Vector> Field::find_whole_gradient(EdgeId e, bool& reads_derived) const {
  const Opposite opposite(mesh_, e);
  if (opposite.is_parted()) return std::nullopt;
  reads_derived = reads_derived || is_derived(e);
  const double value = corner_value(e);
  if (!(value == value)) return Vector{};
  Surroundings around;
  const auto value_of = [&](EdgeId corner) {
    reads_derived = reads_derived || is_derived(corner);
    return corner_value(corner);
  };
  for (const EdgeId side : opposite.edges()) {
    const VertexId v = mesh_.from(side);
    if (const double there = value_of(side); there == there)
      around.add_new(v, mesh_.point(v), there);
  }
  for (const EdgeId side : opposite.edges()) {
    if (mesh_.is_constrained(side) && parts_gradients(*this, side)) continue;
    const EdgeId apex = Triangulation::prev(mesh_.twin(side));
    const VertexId v = mesh_.from(apex);
    if (v == Triangulation::infinite) continue;
    if (const double there = value_of(apex); there == there) around.add(v, mesh_.point(v), there);
  }
  if (around.places().empty()) return Vector{};
  return fit_gradient(mesh_.point(mesh_.from(e)), value, around.places());
}

/// From what is in the sector: the corners of its triangles and of those beside them; if it is not
/// all around the vertex, also of those beside these, as there is less.
Vector Field::find_sector_gradient(EdgeId e, bool& reads_derived) const {
  std::vector<Around> around;
  const auto look_at = [&](EdgeId corner) {
    reads_derived = reads_derived || is_derived(corner);
    const double value = corner_value(corner);
    if (value == value && mesh_.from(corner) != mesh_.from(e))
      around.push_back({mesh_.point(mesh_.from(corner)), value});
  };
  reads_derived = reads_derived || is_derived(e);
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
  rises_[v.index()].state = 0;
  const EdgeId first = mesh_.edge(v);
  if (first.is_none()) return;
  EdgeId here = first;
  do {
    const EdgeId opposite = Triangulation::next(here);
    rises_[mesh_.from(opposite).index()].state = 0;
    const EdgeId beyond = mesh_.twin(opposite);
    rises_[mesh_.apex(beyond).index()].state = 0;
    for (const EdgeId side : {Triangulation::next(beyond), Triangulation::prev(beyond)})
      rises_[mesh_.apex(mesh_.twin(side)).index()].state = 0;
    here = mesh_.rotated(here);
  } while (here != first);
}

}  // namespace loft::fields
