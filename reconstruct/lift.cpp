// SPDX-License-Identifier: MIT
#include "reconstruct/lift.h"

#include <algorithm>

#include "reconstruct/nearest.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;
using cdt::VertexId;

/// Steiner vertices keep that share of the slab's height away from the slices.
constexpr double least_share = 1e-3;

/// Rounding may spoil a round of splits, more than a few times it can't.
constexpr int most_rounds = 8;

/// How far a point is from the contours of either slice that bound its sheet.
class SheetDistances {
 public:
  explicit SheetDistances(const Slab& slab)
      : slab_(slab), sheet_of_(slab.overlay().triangle_count(), Origin::none) {}

  /// The height of the surface over a point in the sheet triangle left of e: where shape-based
  /// interpolation would put it; a dome if the sheet touches one slice only.
  double height(EdgeId e, Point p) {
    const Sheet& sheet = sheets_[sheet_of(e)];
    const double lower = sheet.lower.distance(p);
    const double upper = sheet.upper.distance(p);
    const double z = slab_.lower().z;
    const double height = slab_.height();
    double share = lower / (lower + upper);
    if (sheet.upper.is_empty()) share = std::min(lower / height, 0.5);
    if (sheet.lower.is_empty()) share = 1 - std::min(upper / height, 0.5);
    return z + std::clamp(share, least_share, 1 - least_share) * height;
  }

 private:
  struct Sheet {
    NearestSegment lower;
    NearestSegment upper;
  };

  std::uint32_t sheet_of(EdgeId e) {
    const TriangleId t = Triangulation::triangle(e);
    if (sheet_of_[t.index()] == Origin::none) explore(t);
    return sheet_of_[t.index()];
  }

  void explore(TriangleId start) {
    const Triangulation& mesh = slab_.overlay();
    const auto id = static_cast<std::uint32_t>(sheets_.size());
    std::vector<NearestSegment::Segment> bounds[2];
    std::vector<TriangleId> front{start};
    sheet_of_[start.index()] = id;
    while (!front.empty()) {
      const TriangleId t = front.back();
      front.pop_back();
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = Triangulation::edge(t, corner);
        if (mesh.is_constrained(e)) {
          for (const Level level : {Level::lower, Level::upper})
            if (slab_.is_contour(e, level))
              bounds[static_cast<int>(level)].push_back(
                  {mesh.point(mesh.from(e)), mesh.point(mesh.to(e))});
        } else if (const TriangleId beyond = Triangulation::triangle(mesh.twin(e));
                   sheet_of_[beyond.index()] == Origin::none) {
          sheet_of_[beyond.index()] = id;
          front.push_back(beyond);
        }
      }
    }
    sheets_.push_back({NearestSegment(std::move(bounds[0])), NearestSegment(std::move(bounds[1]))});
  }

  const Slab& slab_;
  std::vector<std::uint32_t> sheet_of_;
  std::vector<Sheet> sheets_;
};

Point middle(Point a, Point b) { return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2}; }

Point middle(Point a, Point b, Point c) {
  return {a.x + ((b.x - a.x) + (c.x - a.x)) / 3, a.y + ((b.y - a.y) + (c.y - a.y)) / 3};
}

}  // namespace

Lift::Lift(Slab& slab)
    : slab_(slab),
      mesh_(slab.overlay()),
      lower_count_(static_cast<std::uint32_t>(slab.lower().points.size())) {
  decide_columns();
  lift_crossings();
  for (int round = 0; round < most_rounds && raise_chords(); ++round) {
    slab_.refresh();
    restore_columns();
  }
}

std::uint32_t Lift::node(EdgeId corner) const {
  const VertexId v = mesh_.from(corner);
  switch (height(corner)) {
    case Height::lower:
      return node(slab_.index(v, Level::lower), Level::lower);
    case Height::upper:
      return node(slab_.index(v, Level::upper), Level::upper);
    default:
      return node(v);
  }
}

std::uint32_t Lift::node(VertexId v) const {
  for (const Level level : {Level::lower, Level::upper})
    if (slab_.is_vertex(v, level)) return node(slab_.index(v, level), level);
  return lower_count_ + static_cast<std::uint32_t>(slab_.upper().points.size()) +
         inner_index_[v.index()];
}

Lift::Height Lift::height(EdgeId corner) const {
  const VertexId v = mesh_.from(corner);
  const bool is_lower = slab_.is_vertex(v, Level::lower);
  const bool is_upper = slab_.is_vertex(v, Level::upper);
  if (is_lower && is_upper) return column_heights_[corner.index()];
  if (is_lower) return Height::lower;
  return is_upper ? Height::upper : Height::between;
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
  for (std::uint32_t i = 1; i <= mesh_.vertex_count(); ++i)
    if (slab_.is_column(VertexId(i))) columns_.push_back(VertexId(i));
  std::ranges::sort(columns_, {}, [&](VertexId v) { return mesh_.point(v); });
  if (!columns_.empty()) column_heights_.assign(mesh_.edge_count(), Height::undecided);
  for (const VertexId v : columns_) {
    for (const Wedge& wedge : wedges(v)) {
      const Level level = choose(wedge);
      set_heights(wedge, level);
      choices_[{v, mesh_.passages(wedge.first).front().segment()}] = level;
    }
  }
}

/// After splits: contour edges at a column stay, so wedges are known by their first one.
void Lift::restore_columns() {
  if (!columns_.empty()) column_heights_.assign(mesh_.edge_count(), Height::undecided);
  for (const VertexId v : columns_)
    for (const Wedge& wedge : wedges(v))
      set_heights(wedge, choices_.at({v, mesh_.passages(wedge.first).front().segment()}));
}

void Lift::lift_crossings() {
  inner_index_.assign(mesh_.vertex_count() + 1, Origin::none);
  const double half_way = slab_.lower().z + slab_.height() / 2;
  for (std::uint32_t i = 1; i <= mesh_.vertex_count(); ++i) {
    const VertexId v(i);
    if (!slab_.is_vertex(v, Level::lower) && !slab_.is_vertex(v, Level::upper))
      add_inner(v, half_way, VertexKind::crossing);
  }
}

void Lift::add_inner(VertexId v, double z, VertexKind kind) {
  if (inner_index_.size() <= v.index()) inner_index_.resize(v.index() + 1, Origin::none);
  inner_index_[v.index()] = static_cast<std::uint32_t>(inner_.size());
  const Point p = mesh_.point(v);
  inner_.push_back({{p.x, p.y, z}, kind});
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
/// In the order of the places, so that the result does not depend on ids.
std::vector<Lift::Steiner> Lift::find_chords() const {
  SheetDistances distances(slab_);
  const double half_way = slab_.lower().z + slab_.height() / 2;
  std::vector<Steiner> found;
  for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
    const EdgeId first = Triangulation::edge(TriangleId(t));
    if (!slab_.is_sheet(first)) continue;
    bool has_chord = false;
    for (const EdgeId e : {first, Triangulation::next(first), Triangulation::prev(first)}) {
      if (!is_chord(e)) continue;
      has_chord = true;
      const bool is_contour = mesh_.is_constrained(e);
      if (!is_contour && mesh_.twin(e) < e) continue;
      const Point place = middle(mesh_.point(mesh_.from(e)), mesh_.point(mesh_.to(e)));
      found.push_back({place,
                       is_contour ? half_way : distances.height(e, place),
                       {mesh_.from(e), mesh_.to(e), VertexId::none()}});
    }
    if (has_chord || !is_flat(first)) continue;
    const VertexId corners[3] = {mesh_.from(first), mesh_.to(first), mesh_.apex(first)};
    const Point place =
        middle(mesh_.point(corners[0]), mesh_.point(corners[1]), mesh_.point(corners[2]));
    found.push_back({place, distances.height(first, place), {corners[0], corners[1], corners[2]}});
  }
  std::ranges::sort(found, {}, &Steiner::place);
  return found;
}

/// Splits what find_chords() found. Heights are those over the sheets as they were before.
/// Returns whether there was anything to do.
bool Lift::raise_chords() {
  bool is_changed = false;
  for (const Steiner& steiner : find_chords()) {
    if (const auto v = split(steiner)) {
      add_inner(*v, steiner.z, VertexKind::steiner);
      is_changed = true;
    }
  }
  return is_changed;
}

std::optional<VertexId> Lift::split(const Steiner& steiner) {
  const auto e = mesh_.find_edge(steiner.corners[0], steiner.corners[1]);
  if (!e) return {};  // a split nearby has flipped it away
  if (steiner.corners[2].is_none()) return slab_.split(*e, steiner.place);
  if (mesh_.apex(*e) != steiner.corners[2]) return {};
  return slab_.split(Triangulation::triangle(*e), steiner.place);
}

}  // namespace loft
