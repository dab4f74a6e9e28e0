// SPDX-License-Identifier: MIT
#include "overlay/parts.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

namespace loft::overlay {

using cdt::TriangleId;
using cdt::Triangulation;

namespace {

/// Takes out what is at the same places in both: there was no change.
void leave_out_common(std::vector<BorderEdge>& gone, std::vector<BorderEdge>& come) {
  if (gone.empty() || come.empty()) return;
  const auto is_before = [](const BorderEdge& a, const BorderEdge& b) { return a.is_before(b); };
  std::ranges::sort(gone, is_before);
  std::ranges::sort(come, is_before);
  std::vector<BorderEdge> only_gone;
  std::vector<BorderEdge> only_come;
  std::ranges::set_difference(gone, come, std::back_inserter(only_gone), is_before);
  std::ranges::set_difference(come, gone, std::back_inserter(only_come), is_before);
  gone = std::move(only_gone);
  come = std::move(only_come);
}

}  // namespace

void Overlay::Parts::check_usable(LayerId layer, std::span<const Point> points) const {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("overlay: layer '" + layers[layer.index()].name + "', ring " +
                                std::to_string(layers[layer.index()].rings.size()) + ": " + what);
  };
  if (points.empty()) fail("has no point");
  for (const Point& p : points) {
    if (Triangulation::is_usable(p)) continue;
    std::ostringstream place;
    place << "point " << &p - points.data() << ' ' << p
          << " is not usable: coordinates are 0 or between 1e-50 and 1e75 in magnitude";
    fail(place.str());
  }
}

void Overlay::Parts::list(RingId ring, LayerId layer) {
  if (listings.size() <= ring.index()) listings.resize(ring.index() + 1);
  std::vector<RingId>& rings = layers[layer.index()].rings;
  listings[ring.index()] = {layer, static_cast<std::uint32_t>(rings.size())};
  rings.push_back(ring);
}

void Overlay::Parts::unlist(RingId ring) {
  const auto [layer, place] = listings[ring.index()];
  std::vector<RingId>& rings = layers[layer.index()].rings;
  rings[place] = rings.back();
  listings[rings[place].index()].place = place;
  rings.pop_back();
}

void Overlay::Parts::finish_edit() {
  if (is_in_batch) return;
  follow();
  ++revision;
  constexpr std::uint32_t spare = 4096;
  if (windings.size() > 2 * windings_at_rebuild + spare) flood_again();
}

/// Takes over what an edit did, in what it made and what changed its windings.
void Overlay::Parts::follow() {
  const cdt::Changes& changes = mesh.changes();
  follower.follow(changes);
  covers.grow(mesh.triangle_bound(), windings.cover_count());
  for (const TriangleId t : follower.unmade())
    if (!mesh.is_triangle(t)) covers.set(t, nothing);
  for (const TriangleId t : follower.remade()) cover_anew(t);
  for (const TriangleId t : follower.changed()) cover_anew(t);
  gather_edges(changes);
  for (auto& result : results)
    if (result) forget(*result);
  for (auto& result : results)
    if (result) update(*result);
}

/// Where borders may have changed, of any result.
void Overlay::Parts::gather_edges(const cdt::Changes& changes) {
  bordering.resize(mesh.triangle_bound());
  const auto add_bordering = [](std::vector<EdgeId>& edges, TriangleId t, unsigned corners) {
    for (unsigned corner = 0; corners >> corner != 0; ++corner)
      if ((corners >> corner & 1U) != 0) edges.push_back(Triangulation::edge(t, corner));
  };
  moved.clear();
  for (const TriangleId t : changes.moved) add_bordering(moved, t, bordering[t.index()]);
  gone.clear();
  for (const TriangleId t : follower.unmade())
    add_bordering(gone, t, std::exchange(bordering[t.index()], std::uint8_t{0}));
  doubtful.clear();
  constexpr std::uint8_t is_new = 1U << 3;
  const auto for_each_new = [&](auto visit) {
    for (const TriangleId t : follower.remade()) visit(t);
    for (const TriangleId t : follower.changed()) visit(t);
  };
  for_each_new([&](TriangleId t) { bordering[t.index()] |= is_new; });
  for_each_new([&](TriangleId t) {
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const EdgeId twin = mesh.twin(e);
      const bool has_turn =
          e < twin || (bordering[Triangulation::triangle(twin).index()] & is_new) == 0;
      if (mesh.is_constrained(e) && has_turn) doubtful.push_back(e);
    }
  });
  for_each_new([&](TriangleId t) { bordering[t.index()] &= static_cast<std::uint8_t>(~is_new); });
}

/// Takes the borders of triangles out that are no more.
void Overlay::Parts::forget(Result& result) {
  result.change = {};
  for (const EdgeId e : gone) take_border(result, e);
  move_borders(result);
}

void Overlay::Parts::move_borders(Result& result) const {
  for (const EdgeId e : moved) {
    const BorderEdge now = border_edge(mesh, e);
    const auto before = result.border.move(now);
    if (!before) continue;
    result.change.gone.push_back(*before);
    result.change.come.push_back(now);
  }
}

void Overlay::Parts::cover_anew(TriangleId t) { covers.set(t, windings.cover(follower[t])); }

/// Everything from nothing, as after edits that are as large as all there is.
void Overlay::Parts::rebuild() {
  flood_again();
  bordering.assign(mesh.triangle_bound(), 0);
  for (auto& result : results) {
    if (!result) continue;
    result->change.gone.assign(result->border.edges().begin(), result->border.edges().end());
    build_border(*result);
  }
}

/// Forgets windings and covers that are nowhere any more.
void Overlay::Parts::flood_again() {
  revision += 2;
  windings.forget();
  follower.begin();
  windings_at_rebuild = windings.size();
  covers.clear();
  covers.grow(mesh.triangle_bound(), windings.cover_count());
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) cover_anew(TriangleId(i));
  for (auto& result : results) {
    if (!result) continue;
    result->is_in.clear();
    learn_truths(*result);
  }
}

void Overlay::Parts::learn_truths(Result& result) {
  for (auto c = static_cast<std::uint32_t>(result.is_in.size()); c < windings.cover_count(); ++c)
    result.is_in.push_back(result.formula.is_true(windings.layers(CoverId(c))) ? 1 : 0);
}

/// Whether some covers belong to a result may have changed; all are settled before any border is.
void Overlay::Parts::check_truths(Result& result, std::span<const CoverId> some) {
  std::vector<CoverId> turned;
  for (const CoverId cover : some) {
    const std::uint32_t is_in = result.formula.is_true(windings.layers(cover)) ? 1 : 0;
    if (std::exchange(result.is_in[cover.index()], is_in) != is_in) turned.push_back(cover);
  }
  for (const CoverId cover : turned)
    covers.for_each(cover, [&](TriangleId t) { check_borders(result, t); });
}

void Overlay::Parts::update(Result& result) {
  learn_truths(result);
  for (const EdgeId e : doubtful) check_borders(result, e);
  sum_up(result);
}

void Overlay::Parts::add_border(Result& result, EdgeId e) {
  result.border.add(border_edge(mesh, e));
  note_bordering(e);
}

void Overlay::Parts::take_border(Result& result, EdgeId e) {
  if (const auto taken = result.border.take(e)) result.change.gone.push_back(*taken);
}

/// Whether an edge is on the border may have changed.
void Overlay::Parts::check_border(Result& result, EdgeId e) {
  const bool is_border = region(result).has_border(e);
  if (!is_border && !may_border(e)) return;
  if (is_border == result.border.has(e)) return;
  if (!is_border) return take_border(result, e);
  add_border(result, e);
  result.change.come.push_back(result.border.edges().back());
}

void Overlay::Parts::check_borders(Result& result, EdgeId e) {
  check_border(result, e);
  check_border(result, mesh.twin(e));
}

/// Covers differ across constrained edges alone.
void Overlay::Parts::check_borders(Result& result, TriangleId t) {
  for (unsigned corner = 0; corner < 3; ++corner)
    if (const EdgeId e = Triangulation::edge(t, corner); mesh.is_constrained(e))
      check_borders(result, e);
}

/// All of a result's border, which is in `come` then, as what there was is in `gone`.
void Overlay::Parts::build_border(Result& result) {
  bordering.resize(mesh.triangle_bound());
  covers.grow(mesh.triangle_bound(), windings.cover_count());  // in a batch there may be more
  result.change.come = find_border(result);
  for (const BorderEdge& edge : result.change.come) note_bordering(edge.edge);
  result.border.assign(result.change.come, mesh.edge_bound());
  sum_up(result);
}

/// By the triangles of the result; where these are many, by what is between covers anywhere, as it
/// lies in memory, which several results have in common.
std::vector<BorderEdge> Overlay::Parts::find_border(const Result& result) {
  const Regions where = region(result);
  std::vector<CoverId> within;
  std::size_t count = 0;
  for (std::uint32_t c = 1; c < result.is_in.size(); ++c) {
    if (result.is_in[c] == 0) continue;
    within.emplace_back(c);
    count += covers.count(CoverId(c));
  }
  constexpr std::size_t many = 4;
  if (many * count > mesh.triangle_bound()) return borders(where, known_fences());
  std::vector<BorderEdge> edges;
  for (const CoverId cover : within)
    covers.for_each(cover, [&](TriangleId t) {
      for (unsigned corner = 0; corner < 3; ++corner)
        if (const EdgeId e = Triangulation::edge(t, corner);
            mesh.is_constrained(e) && where.has_border(e))
          edges.push_back(border_edge(mesh, e));
    });
  return edges;
}

const std::vector<EdgeId>& Overlay::Parts::known_fences() {
  if (fences_revision != revision || is_in_batch) fences = find_fences(mesh, covers.by_triangle());
  fences_revision = revision;
  return fences;
}

void Overlay::Parts::sum_up(Result& result) {
  ResultChange& change = result.change;
  leave_out_common(change.gone, change.come);
  change.area = {};
  for (const BorderEdge& edge : change.gone) change.area.subtract_piece(edge.from, edge.to);
  for (const BorderEdge& edge : change.come) change.area.add_piece(edge.from, edge.to);
  result.area += change.area;
}

}  // namespace loft::overlay
