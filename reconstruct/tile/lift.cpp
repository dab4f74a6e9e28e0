// SPDX-License-Identifier: MIT
#include "reconstruct/tile/lift.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "cdt/predicates.h"
#include "reconstruct/tile/middle.h"
#include "reconstruct/tile/sheet_heights.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;
using cdt::VertexId;

/// Rounding may spoil a round of splits, more than a few times it can't.
constexpr int most_rounds = 8;

/// An end is refined where its edges are further from its height than that share of the slab.
constexpr double coarseness = 0.1;

double distance(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

}  // namespace

Lift::Lift(Slab& slab)
    : slab_(slab),
      mesh_(slab.overlay()),
      lower_count_(static_cast<std::uint32_t>(slab.lower().points.size())),
      contour_count_(lower_count_ + static_cast<std::uint32_t>(slab.upper().points.size())) {
  lift_vertices();
  decide_columns();
  for (int round = 0; round < most_rounds && !is_complete_; ++round) {
    const std::vector<Steiner> chords = find_chords();
    is_complete_ = chords.empty();
    if (!insert(chords)) break;
  }
  if (!is_complete_) insert(find_flat());
  insert(find_coarse_ends());
}

std::uint32_t Lift::node(EdgeId corner) const {
  const VertexId v = mesh_.from(corner);
  const bool is_upper_of_column =
      heights_[v.index()] == Height::by_wedge && column_heights_[corner.index()] == Height::upper;
  return is_upper_of_column ? node(slab_.index(v, Level::upper), Level::upper) : node(v);
}

std::vector<Lift::Wedge> Lift::wedges(VertexId column) const {
  std::vector<EdgeId> contour_edges;
  const EdgeId first = mesh_.edge(column);
  EdgeId e = first;
  do {
    if (mesh_.is_constrained(e)) contour_edges.push_back(e);
    e = mesh_.rotated(e);
  } while (e != first);
  std::vector<Wedge> found;
  for (std::size_t i = 0; i < contour_edges.size(); ++i)
    if (slab_.is_sheet(contour_edges[i]))
      found.push_back({contour_edges[i], contour_edges[(i + 1) % contour_edges.size()]});
  return found;
}

/// Where the bounding contour edges are of one slice, its height; where an edge is of both, the
/// height of the slice that the sheet is inside of; otherwise what leaves fewer chords.
Level Lift::choose(const Wedge& wedge) const {
  const Level own = slab_.side(wedge.first) == Side::lower ? Level::lower : Level::upper;
  const bool first_is_own = slab_.is_contour(wedge.first, own);
  const bool last_is_own = slab_.is_contour(wedge.last, own);
  const bool first_is_other = slab_.is_contour(wedge.first, other(own));
  const bool last_is_other = slab_.is_contour(wedge.last, other(own));
  if ((first_is_own && first_is_other) || (last_is_own && last_is_other)) return own;
  if (first_is_own && last_is_own) return own;
  if (first_is_other && last_is_other) return other(own);
  return chords(wedge, other(own)) < chords(wedge, own) ? other(own) : own;
}

/// How many edges from the column into the wedge, its bounds included, would be chords.
int Lift::chords(const Wedge& wedge, Level level) const {
  int count = 0;
  for (EdgeId e = wedge.first;; e = mesh_.rotated(e)) {
    // The far end, seen from the triangle of the wedge that e bounds.
    const EdgeId far = e == wedge.last ? mesh_.twin(e) : Triangulation::next(e);
    if (height(far) == height(level) && !slab_.is_contour(e, level)) ++count;
    if (e == wedge.last && e != wedge.first) break;
    if (mesh_.rotated(e) == wedge.first) break;
  }
  return count;
}

void Lift::set_heights(const Wedge& wedge, Level level) {
  EdgeId e = wedge.first;
  do {
    column_heights_[e.index()] = height(level);
    e = mesh_.rotated(e);
  } while (e != wedge.last);
}

void Lift::decide_columns() {
  for (std::uint32_t i = 1; i < mesh_.vertex_bound(); ++i)
    if (heights_[i] == Height::by_wedge) columns_.push_back(VertexId(i));
  std::ranges::sort(columns_, {}, [&](VertexId v) { return mesh_.point(v); });
  if (!columns_.empty()) column_heights_.assign(mesh_.edge_bound(), Height::by_wedge);
  // All before any is set, so that the order of places does not matter.
  for (const VertexId v : columns_)
    for (const Wedge& wedge : wedges(v))
      choices_[{v, mesh_.passages(wedge.first).front().segment()}] = choose(wedge);
  set_columns();
}

/// Also after splits: contour edges at a column stay, so wedges are known by their first one.
void Lift::set_columns() {
  if (!columns_.empty()) column_heights_.assign(mesh_.edge_bound(), Height::by_wedge);
  for (const VertexId v : columns_)
    for (const Wedge& wedge : wedges(v))
      set_heights(wedge, choices_.at({v, mesh_.passages(wedge.first).front().segment()}));
}

/// Contour vertices have the heights of their slices, crossings lie half way.
void Lift::lift_vertices() {
  nodes_.assign(mesh_.vertex_bound(), Origin::none);
  heights_.assign(mesh_.vertex_bound(), Height::between);
  const double half_way = slab_.lower().z + slab_.height() / 2;
  for (std::uint32_t i = 1; i < mesh_.vertex_bound(); ++i) {
    const VertexId v(i);
    const std::uint32_t lower = slab_.index(v, Level::lower);
    const std::uint32_t upper = slab_.index(v, Level::upper);
    if (lower != Origin::none) {
      nodes_[i] = node(lower, Level::lower);
      heights_[i] = upper != Origin::none ? Height::by_wedge : Height::lower;
    } else if (upper != Origin::none) {
      nodes_[i] = node(upper, Level::upper);
      heights_[i] = Height::upper;
    } else if (mesh_.is_vertex(v)) {
      add_inner(v, half_way, VertexKind::crossing);
    }
  }
}

void Lift::add_inner(VertexId v, double z, VertexKind kind) {
  assert(slab_.lower().z <= z && z <= slab_.upper().z);
  if (nodes_.size() <= v.index()) {
    nodes_.resize(v.index() + 1, Origin::none);
    heights_.resize(v.index() + 1, Height::between);
  }
  nodes_[v.index()] = contour_count_ + static_cast<std::uint32_t>(inner_.size());
  inner_.push_back({slab_.place(v, z), kind});
}

/// Whether both ends of a sheet triangle's edge are in one slice, whose contour it is not.
bool Lift::is_chord(EdgeId e) const {
  const Height from = height(e);
  if (from != height(Triangulation::next(e))) return false;
  if (from == Height::lower) return !slab_.is_contour(e, Level::lower);
  if (from == Height::upper) return !slab_.is_contour(e, Level::upper);
  return false;
}

/// Whether all three corners of a sheet triangle are in one slice.
bool Lift::is_flat(EdgeId e) const {
  const Height here = height(e);
  return (here == Height::lower || here == Height::upper) &&
         height(Triangulation::next(e)) == here && height(Triangulation::prev(e)) == here;
}

/// What has to leave the slice planes: every chord, and every triangle of contour edges only.
/// Ends first, from the middle outwards, so that they become round; then forks, short chords
/// first, across the necks.
std::vector<Lift::Steiner> Lift::find_chords() const {
  SheetHeights heights(slab_);
  const double half_way = slab_.lower().z + slab_.height() / 2;
  std::vector<Steiner> found;
  std::set<const CircleCell*> found_cells;
  for (std::uint32_t t = 0; t < mesh_.triangle_bound(); ++t) {
    const EdgeId first = Triangulation::edge(TriangleId(t));
    if (!slab_.is_sheet(first)) continue;
    bool has_chord = false;
    for (const EdgeId e : {first, Triangulation::next(first), Triangulation::prev(first)}) {
      if (!is_chord(e)) continue;
      has_chord = true;
      const bool is_contour = mesh_.is_constrained(e);
      if (!is_contour && mesh_.twin(e) < e) continue;
      if (const auto* const cell = heights.cell(e); cell != nullptr && is_level(*cell, height(e))) {
        has_chord = true;
        if (found_cells.insert(cell).second)
          found.push_back({heights.is_end(e) ? -heights.depth(e, cell->centre) : cell->diameter,
                           cell->centre,
                           heights.height(e, cell->centre),
                           {VertexId::none(), VertexId::none(), VertexId::none()}});
        continue;
      }
      const Point a = mesh_.point(mesh_.from(e));
      const Point b = mesh_.point(mesh_.to(e));
      const Point place = middle(a, b);
      found.push_back({heights.is_end(e) ? -heights.depth(e, place) : distance(a, b),
                       place,
                       is_contour ? half_way : heights.height(e, place),
                       {mesh_.from(e), mesh_.to(e), VertexId::none()}});
    }
    if (!has_chord && is_flat(first)) found.push_back(in_middle_of(first, heights));
  }
  return found;
}

/// Whether all corners of a cell have one height.
bool Lift::is_level(const CircleCell& cell, Height height) const {
  return std::ranges::all_of(cell.triangles, [&](TriangleId t) {
    const EdgeId e = Triangulation::edge(t);
    return this->height(e) == height && this->height(Triangulation::next(e)) == height &&
           this->height(Triangulation::prev(e)) == height;
  });
}

/// At the centroid of the triangle left of an edge.
Lift::Steiner Lift::in_middle_of(EdgeId e, SheetHeights& heights) const {
  const VertexId corners[3] = {mesh_.from(e), mesh_.to(e), mesh_.apex(e)};
  const Point place =
      middle(mesh_.point(corners[0]), mesh_.point(corners[1]), mesh_.point(corners[2]));
  return {0, place, heights.height(e, place), {corners[0], corners[1], corners[2]}};
}

/// Where a chord cannot be split, the triangle beside it at least must not stay in the plane.
std::vector<Lift::Steiner> Lift::find_flat() const {
  SheetHeights heights(slab_);
  std::vector<Steiner> found;
  for (std::uint32_t t = 0; t < mesh_.triangle_bound(); ++t) {
    const EdgeId e = Triangulation::edge(TriangleId(t));
    if (slab_.is_sheet(e) && is_flat(e)) found.push_back(in_middle_of(e, heights));
  }
  return found;
}

/// The edges of ends that are far from the height of the surface there.
std::vector<Lift::Steiner> Lift::find_coarse_ends() const {
  SheetHeights heights(slab_);
  std::vector<Steiner> found;
  for (std::uint32_t i = 0; i < mesh_.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!slab_.is_sheet(e) || mesh_.is_constrained(e) || mesh_.twin(e) < e) continue;
    if (!heights.is_end(e)) continue;
    const Point place = middle(mesh_.point(mesh_.from(e)), mesh_.point(mesh_.to(e)));
    const double z = heights.height(e, place);
    const double off = std::abs(z - (z_at(e) + z_at(Triangulation::next(e))) / 2);
    if (off > coarseness * slab_.height())
      found.push_back({-off, place, z, {mesh_.from(e), mesh_.to(e), VertexId::none()}});
  }
  return found;
}

double Lift::z_at(EdgeId corner) const {
  switch (height(corner)) {
    case Height::lower:
      return slab_.lower().z;
    case Height::upper:
      return slab_.upper().z;
    default:
      return inner_[node(mesh_.from(corner)) - contour_count_].place[2];
  }
}

/// Of a Steiner vertex's edge or triangle: the longest side.
double Lift::extent(const Steiner& steiner) const {
  const auto [a, b, c] = steiner.corners;
  if (a.is_none()) return 0;
  const double side = distance(mesh_.point(a), mesh_.point(b));
  if (c.is_none()) return side;
  return std::max(
      {side, distance(mesh_.point(b), mesh_.point(c)), distance(mesh_.point(c), mesh_.point(a))});
}

/// Inserts Steiner vertices in the order of their ranks. Many are the same but for rounding, as
/// middles of two chords over one contour edge are equally deep: then the shorter edge comes first.
/// One whose edge an earlier one has flipped away is left out; but of equal ones none flips away
/// another, so that neither ids nor places decide. Returns whether there was anything to do.
bool Lift::insert(const std::vector<Steiner>& unsorted) {
  std::vector<std::tuple<float, float, Point, const Steiner*>> sorted;
  for (const Steiner& steiner : unsorted)
    sorted.emplace_back(static_cast<float>(steiner.rank), static_cast<float>(extent(steiner)),
                        steiner.place, &steiner);
  std::ranges::sort(sorted);
  const auto order = [&](std::size_t i) {
    return std::pair(std::get<0>(sorted[i]), std::get<1>(sorted[i]));
  };
  bool is_changed = false;
  for (std::size_t i = 0, behind = 0; i < sorted.size(); i = behind) {
    std::vector<const Steiner*> equal;
    for (; behind < sorted.size() && order(behind) == order(i); ++behind)
      if (is_there(*std::get<3>(sorted[behind]))) equal.push_back(std::get<3>(sorted[behind]));
    for (const Steiner* const steiner : equal) {
      const auto v = is_there(*steiner) ? split(*steiner) : split_at(steiner->place);
      if (!v) continue;
      add_inner(*v, steiner->z, VertexKind::steiner);
      is_changed = true;
    }
  }
  if (is_changed) {
    slab_.refresh();
    set_columns();
  }
  return is_changed;
}

/// Whether no earlier one has flipped away what a Steiner vertex is to split.
bool Lift::is_there(const Steiner& steiner) const {
  const auto [a, b, c] = steiner.corners;
  if (a.is_none()) return true;
  const auto e = mesh_.find_edge(a, b);
  return e && (c.is_none() || mesh_.apex(*e) == c);
}

std::optional<VertexId> Lift::split(const Steiner& steiner) {
  const auto [a, b, c] = steiner.corners;
  if (a.is_none()) return split_at(steiner.place);
  const EdgeId e = *mesh_.find_edge(a, b);
  if (c.is_none()) return split(e, steiner.place);
  return slab_.split(Triangulation::triangle(e), steiner.place);
}

/// In the triangle, or on the edge, that is there.
std::optional<VertexId> Lift::split_at(Point place) {
  const cdt::Location found = mesh_.locate(place);
  if (found.kind == cdt::Location::Kind::edge) return slab_.split(found.edge, place);
  if (found.kind != cdt::Location::Kind::triangle) return {};
  return slab_.split(Triangulation::triangle(found.edge), place);
}

/// At a point on the edge; where a triangle beside it is so thin that the rounded point is beyond
/// it, a little into the other triangle; where both are, beside the edge, which is flipped away.
std::optional<VertexId> Lift::split(EdgeId e, Point place) {
  if (const auto v = slab_.split(e, place)) return v;
  constexpr double shares[] = {0x1p-40, 0x1p-30, 0x1p-20, 0x1p-10};
  for (const double share : shares) {
    for (const EdgeId side : {e, mesh_.twin(e)}) {
      if (mesh_.is_infinite(Triangulation::triangle(side))) continue;
      const Point apex = mesh_.point(mesh_.apex(side));
      const Point inside{place.x + share * (apex.x - place.x),
                         place.y + share * (apex.y - place.y)};
      if (const auto v = slab_.split(e, inside)) return v;
    }
  }
  for (const double share : shares) {
    for (const EdgeId side : {e, mesh_.twin(e)}) {
      const Point a = mesh_.point(mesh_.from(side));
      const Point b = mesh_.point(mesh_.to(side));
      const Point beside{place.x - share * (b.y - a.y), place.y + share * (b.x - a.x)};
      const auto t = triangle_beside(side, beside);
      if (!t) continue;
      if (const auto v = slab_.split(*t, beside)) return v;
    }
  }
  return {};
}

/// The triangle with a point left of an edge, if no constrained edge is in between.
std::optional<TriangleId> Lift::triangle_beside(EdgeId e, Point point) const {
  constexpr int most_steps = 16;
  const auto is_beyond = [&](EdgeId side) {
    return cdt::orient(mesh_.point(mesh_.from(side)), mesh_.point(mesh_.to(side)), point) < 0;
  };
  for (int step = 0; step < most_steps; ++step) {
    if (mesh_.is_infinite(Triangulation::triangle(e))) return {};
    EdgeId ahead = Triangulation::next(e);
    if (!is_beyond(ahead)) ahead = Triangulation::next(ahead);
    if (!is_beyond(ahead)) return Triangulation::triangle(e);
    if (mesh_.is_constrained(ahead)) return {};
    e = mesh_.twin(ahead);
  }
  return {};
}

}  // namespace loft
