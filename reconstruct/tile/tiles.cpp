// SPDX-License-Identifier: MIT
#include "reconstruct/tile/tiles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "cdt/predicates.h"
#include "cdt/regions.h"
#include "mesh/predicates.h"
#include "mesh/triangle_pairs.h"
#include "reconstruct/tile/crossings.h"
#include "reconstruct/tile/slab.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::SegmentId;
using cdt::Triangulation;
using cdt::VertexId;

/// Makes the sheets and walls of a lifted slab.
class Tiling {
 public:
  Tiling(const Slab& slab, const Lift& lift, cdt::Triangulation& wall)
      : slab_(slab), mesh_(slab.overlay()), lift_(lift), wall_(wall) {}

  TileSet run() {
    tiles_.inner = lift_.inner();
    tiles_.tiles.reserve(mesh_.triangle_bound());
    add_sheets();
    for (const Level level : {Level::lower, Level::upper})
      for (std::uint32_t i = 0; i < slab_.region(level).loop_vertices.size(); ++i)
        add_wall(level, i);
    return std::move(tiles_);
  }

  /// Whether a wall had to be closed without regard to its shape.
  [[nodiscard]] bool is_forced() const { return is_forced_; }

 private:
  /// Sheets of the lower region have the solid below them, those of the upper one above.
  void add_sheets() {
    for (std::uint32_t t = 0; t < mesh_.triangle_bound(); ++t) {
      const EdgeId e = Triangulation::edge(cdt::TriangleId(t));
      if (!slab_.is_sheet(e)) continue;
      std::uint32_t a = lift_.node(e);
      std::uint32_t b = lift_.node(Triangulation::next(e));
      if (slab_.side(e) == Side::upper) std::swap(a, b);
      add({a, b, lift_.node(Triangulation::prev(e))}, FaceKind::sheet);
    }
  }

  void add(std::array<std::uint32_t, 3> nodes, FaceKind kind) {
    tiles_.tiles.push_back({nodes, kind});
  }

  /// The vertical polygon between a contour edge in its slice and the sheets beside its pieces.
  /// It looks away from the side on which its own slice is inside.
  void add_wall(Level level, std::uint32_t edge) {
    const auto [first, end] = slab_.segments(level, edge);
    const SegmentId last(end.index() - 1);
    const std::uint32_t from = lift_.node(slab_.index(mesh_.segment(first).from, level), level);
    const std::uint32_t to = lift_.node(slab_.index(mesh_.segment(last).to, level), level);
    roof_.clear();
    for (std::uint32_t s = first.index(); s < end.index(); ++s) add_roof(SegmentId(s), level);
    if (roof_.size() == 2 && roof_.front() == from && roof_.back() == to) return;

    polygon_.clear();
    if (level == Level::lower) {
      polygon_ = {from, to};
      polygon_.insert(polygon_.end(), roof_.rbegin(), roof_.rend());
    } else {
      polygon_ = roof_;
      polygon_.insert(polygon_.end(), {to, from});
    }
    polygon_.erase(std::unique(polygon_.begin(), polygon_.end()), polygon_.end());
    while (polygon_.size() > 1 && polygon_.front() == polygon_.back()) polygon_.pop_back();
    if (polygon_.size() >= 3) fill_upright(place(from), place(to));
  }

  /// The nodes above or below a contour edge's segment, from its start to its end.
  void add_roof(SegmentId s, Level level) {
    const cdt::Segment& segment = mesh_.segment(s);
    const auto whole = mesh_.find_edge(segment.from, segment.to);
    const auto is_s = [&](cdt::Passage passage) { return passage.segment() == s; };
    if (whole && std::ranges::any_of(mesh_.passages(*whole), is_s)) {
      add_piece(*whole, level);
    } else {
      for (const EdgeId e : mesh_.pieces(s)) add_piece(e, level);
    }
  }

  /// A piece's own slice is inside on its left. The sheet beside it is there, if the other slice is
  /// outside; else on the right, if the other slice is inside; else both slices end here, and the
  /// walls of both meet half way.
  void add_piece(EdgeId e, Level level) {
    const Side own = level == Level::lower ? Side::lower : Side::upper;
    const EdgeId f = mesh_.twin(e);
    if (slab_.side(e) == own) {
      add_roof(lift_.node(e));
      add_roof(lift_.node(Triangulation::next(e)));
    } else if (slab_.is_sheet(f)) {
      add_roof(lift_.node(Triangulation::next(f)));
      add_roof(lift_.node(f));
    } else {
      add_roof(lift_.node(mesh_.from(e)));
      add_roof(lift_.node(mesh_.to(e)));
    }
  }

  void add_roof(std::uint32_t node) {
    if (roof_.empty() || roof_.back() != node) roof_.push_back(node);
  }

  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(slab_.lower(), slab_.upper(), tiles_.inner, node);
  }

  /// Triangulates polygon_, counter-clockwise as seen from outside, over the line from -> to. How
  /// does not depend on the line's direction: it is seen from the same side, turned or not.
  void fill_upright(const Vec3& from, const Vec3& to) {
    const bool is_along_x = std::abs(to[0] - from[0]) >= std::abs(to[1] - from[1]);
    const auto along = [&](const Vec3& p) {
      const Point flat = slab_.in_overlay(p);
      return is_along_x ? flat.x : flat.y;
    };
    const auto [low, high] = std::minmax({along(from), along(to)});
    const double bottom = slab_.lower().z;
    flat_.clear();
    for (const std::uint32_t node : polygon_) {
      const Vec3 p = place(node);
      flat_.push_back({(along(p) - low) / (high - low), (p[2] - bottom) / slab_.height()});
    }
    const std::size_t count = tiles_.tiles.size();
    if (polygon_.size() > 3) fill_polygon(along(to) < along(from));
    if (tiles_.tiles.size() == count + polygon_.size() - 2) return;
    // A triangle; or rounding has bent the roof into the base: then what counts is to close it.
    tiles_.tiles.resize(count);
    is_forced_ =
        is_forced_ || polygon_.size() > 3 || cdt::orient(flat_[0], flat_[1], flat_[2]) == 0;
    for (std::size_t i = 1; i + 1 < polygon_.size(); ++i)
      add({polygon_[0], polygon_[i], polygon_[i + 1]}, FaceKind::wall);
  }

  /// The polygon's constrained Delaunay triangulation: of all ways to cut it the one with the best
  /// shapes. Adds nothing if the polygon crosses itself. `is_turned`: it goes round clockwise.
  void fill_polygon(bool is_turned) {
    wall_.clear();
    const auto ring = wall_.insert(flat_, cdt::closed);
    if (wall_.vertex_count() != polygon_.size()) return;
    corner_.assign(wall_.vertex_bound(), Origin::none);
    const auto segments = wall_.segments(ring);
    for (std::size_t i = 0; i < segments.size(); ++i)
      corner_[segments[i].from.index()] = polygon_[i];
    const auto is_inside = cdt::odd_parity(wall_);
    for (std::uint32_t t = 0; t < wall_.triangle_bound(); ++t) {
      if (!is_inside[t]) continue;
      const EdgeId e = Triangulation::edge(cdt::TriangleId(t));
      std::uint32_t a = corner_[wall_.from(e).index()];
      std::uint32_t b = corner_[wall_.to(e).index()];
      if (is_turned) std::swap(a, b);
      add({a, b, corner_[wall_.apex(e).index()]}, FaceKind::wall);
    }
  }

  const Slab& slab_;
  const Triangulation& mesh_;
  const Lift& lift_;
  TileSet tiles_;
  bool is_forced_ = false;

  // Of the wall at hand.
  std::vector<std::uint32_t> roof_;
  std::vector<std::uint32_t> polygon_;
  std::vector<Point> flat_;
  Triangulation& wall_;
  std::vector<std::uint32_t> corner_;
};

/// Slices that come nearer to each other than that may do so by rounding alone: a share of what
/// makes a triangle tight.
double contact_of(double tight) { return tight * 0x1p-4; }

/// Lengths of a slab that matter for rounding.
struct Scale {
  double shear;  // small against the slices, some times a rounding
  double tight;  // triangles lower than that are tested for what rounding does to them
};

Scale scale(const Region& lower, const Region& upper) {
  cdt::Box box;
  double farthest = 0;
  for (const Region* region : {&lower, &upper}) {
    for (const Point p : region->loop_points()) {
      box.add(p);
      farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
    }
  }
  const auto power = [](double length) {
    return length > 0 ? std::exp2(std::ceil(std::log2(length))) : 0;
  };
  const double size =
      power(box.is_empty() ? 0 : std::max(box.high.x - box.low.x, box.high.y - box.low.y));
  farthest = power(farthest);
  return {std::max(size * 0x1p-18, farthest * 0x1p-50),
          std::max(size * 0x1p-28, farthest * 0x1p-44)};
}

/// Whether the tiles and the two regions together have no rim, and nothing but the contours is in
/// the slice planes.
bool fit_together(const Region& lower, const Region& upper, const TileSet& tiles) {
  const auto lower_count = static_cast<std::uint32_t>(lower.points.size());
  const auto contour_count = lower_count + static_cast<std::uint32_t>(upper.points.size());
  struct Edge {
    std::uint32_t from;
    std::uint32_t to;
    int turns;  // 1 if from is less than to, else -1
    bool is_contour;
  };
  std::vector<Edge> edges;
  const auto add = [&](std::uint32_t from, std::uint32_t to, bool is_contour) {
    const auto [low, high] = std::minmax(from, to);
    edges.push_back({low, high, from < to ? 1 : -1, is_contour});
  };
  for (const Tile& tile : tiles.tiles) {
    const auto [least, most] = std::ranges::minmax(tile.nodes);
    if (most < lower_count || (least >= lower_count && most < contour_count)) return false;
    for (unsigned i = 0; i < 3; ++i) add(tile.nodes[i], tile.nodes[(i + 1) % 3], false);
  }
  for (const Region* region : {&lower, &upper}) {
    const std::uint32_t first = region == &lower ? 0 : lower_count;
    for (std::size_t i = 0; i < region->loop_count(); ++i) {
      const auto loop = region->loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t from = first + loop[k];
        const std::uint32_t to = first + loop[(k + 1) % loop.size()];
        if (region == &lower) {
          add(to, from, true);
        } else {
          add(from, to, true);
        }
      }
    }
  }
  std::ranges::sort(edges, {}, [](const Edge& e) { return std::pair(e.from, e.to); });
  for (std::size_t i = 0; i < edges.size();) {
    const Edge& first = edges[i];
    int turns = 0;
    bool is_contour = false;
    for (; i < edges.size() && edges[i].from == first.from && edges[i].to == first.to; ++i) {
      turns += edges[i].turns;
      is_contour = is_contour || edges[i].is_contour;
    }
    const bool is_in_slice =
        first.to < lower_count || (first.from >= lower_count && first.to < contour_count);
    if (turns != 0 || (is_in_slice && !is_contour)) return false;
  }
  return true;
}

/// That often a slab is sheared anew before its slices are left apart.
constexpr int most_shears = 12;

/// Slices that come within rounding of each other are merged that often, where slivers by rounding
/// are in the way: stirred a little, these are wide enough to be split.
constexpr unsigned most_stirs = 4;

/// What is asked of an overlay.
enum class Overlay { exact, rounded };

/// Tiles before their crossings are collapsed.
struct Draft {
  TileSet tiles;
  bool is_doubtful;  // whether they have to be tested
};

/// None if the overlay does not do.
std::optional<Draft> draft(Slab& slab, double tight, Overlay overlay, TileWorkspace& workspace) {
  const bool is_exact = slab.is_exact();
  if (overlay == Overlay::exact && !is_exact) return {};
  const Lift lift(slab);
  if (!lift.is_complete()) return {};
  Tiling tiling(slab, lift, workspace.wall);
  TileSet tiles = tiling.run();
  if (!is_exact && !fit_together(slab.lower(), slab.upper(), tiles)) return {};
  return Draft{std::move(tiles), !is_exact || tiling.is_forced() || slab.is_tight(tight)};
}

/// A way to tile a slab.
struct Attempt {
  Point shear;
  Overlay overlay;
  double tight;
  double contact;  // within which slices are merged; 0: they are not
  bool collapses = true;
};

/// The tiles of a slab whose slices come within rounding of each other: as if they met exactly
/// there, so that it does not matter which way they were rounded. None if these are not valid.
std::optional<TileSet> tile_merged(const Region& lower, const Region& upper, const Attempt& how,
                                   unsigned stir, std::size_t& pairs_left,
                                   TileWorkspace& workspace) {
  auto slab = Slab::merged(lower, upper, how.shear, how.contact, stir);
  if (!slab) return {};
  auto drafted = draft(*slab, 0, Overlay::rounded, workspace);
  if (!drafted || !fit_together(lower, upper, drafted->tiles)) return {};
  if (how.collapses) collapse_crossings(lower, upper, drafted->tiles, true);
  if (tiles_meet(lower, upper, drafted->tiles, pairs_left)) return {};
  return std::move(drafted->tiles);
}

/// The tiles of a slab that is sheared on the way. None if they are not valid.
std::optional<TileSet> tile_sheared(const Region& lower, const Region& upper, const Attempt& how,
                                    std::size_t& pairs_left, TileWorkspace& workspace) {
  Slab slab(lower, upper, how.shear, std::move(workspace.overlay));
  const bool is_near = how.contact > 0 && slab.has_near_contact(how.contact);
  for (unsigned stir = 0; is_near && stir < most_stirs; ++stir) {
    if (auto tiles = tile_merged(lower, upper, how, stir, pairs_left, workspace)) {
      workspace.overlay = slab.release();
      return tiles;
    }
  }
  auto drafted = draft(slab, how.tight, how.overlay, workspace);
  workspace.overlay = slab.release();
  if (!drafted) return {};
  const bool is_decided = how.collapses && collapse_crossings(lower, upper, drafted->tiles, true);
  const bool is_doubtful = drafted->is_doubtful || how.shear != Point{};
  drafted->tiles.is_plain = !is_doubtful && is_decided && !is_near;
  if (is_doubtful && tiles_meet(lower, upper, drafted->tiles, pairs_left)) return {};
  return std::move(drafted->tiles);
}

/// One of the slices is empty: nothing could coincide.
TileSet tile_end(const Region& lower, const Region& upper, TileWorkspace& workspace) {
  Slab slab(lower, upper, {}, std::move(workspace.overlay));
  const Lift lift(slab);
  TileSet tiles = Tiling(slab, lift, workspace.wall).run();
  workspace.overlay = slab.release();
  return tiles;
}

/// Where contours of both slices meet within rounding of each other, as three lines through one
/// point may, the overlay can't be exact. Then the slab is sheared a little before it is tiled, in
/// no special direction, and back again: a shear keeps tiles valid, and nothing meets by chance.
/// Where a slice has slivers that are little wider than rounding, no overlay is exact: then one
/// will do if all that is asked of its tiles holds.
std::optional<TileSet> tile_moved(const Region& lower, const Region& upper, Point shift,
                                  std::size_t most_pairs, bool collapses,
                                  TileWorkspace& workspace) {
  if (!lower.has_loops() || !upper.has_loops()) return tile_end(lower, upper, workspace);
  const Scale lengths = scale(lower, upper);
  std::size_t pairs_left = most_pairs;
  for (const Overlay overlay : {Overlay::exact, Overlay::rounded}) {
    for (int attempt = 0; attempt < most_shears; ++attempt) {
      const double turn = 2.399963 * attempt;  // the golden angle
      const double step = attempt * lengths.shear;
      const Point shear{shift.x + step * std::cos(turn), shift.y + step * std::sin(turn)};
      const bool is_first = overlay == Overlay::exact && attempt == 0;
      const Attempt here{shear, overlay, lengths.tight, is_first ? contact_of(lengths.tight) : 0,
                         collapses};
      if (auto tiles = tile_sheared(lower, upper, here, pairs_left, workspace)) return tiles;
      if (pairs_left == 0) return std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace

bool tiles_meet(const Region& lower, const Region& upper, const TileSet& tiles,
                std::size_t& pairs_left) {
  std::vector<Corners> corners;
  std::vector<TrianglePairs::Vertices> nodes;
  for (const Tile& tile : tiles.tiles) {
    auto& places = corners.emplace_back();
    for (unsigned i = 0; i < 3; ++i) places[i] = place_of(lower, upper, tiles.inner, tile.nodes[i]);
    nodes.push_back(tile.nodes);
    if (collinear(places[0], places[1], places[2])) return true;
  }
  const std::size_t node_count = lower.points.size() + upper.points.size() + tiles.inner.size();
  return !TrianglePairs(corners, nodes, node_count).all_of([&](std::uint32_t i, std::uint32_t j) {
    if (pairs_left == 0) return false;
    --pairs_left;
    return !triangles_meet(corners[i], corners[j]);
  });
}

double doubt(const Region& lower, const Region& upper) { return scale(lower, upper).tight; }

double contact(const Region& lower, const Region& upper) { return contact_of(doubt(lower, upper)); }

std::optional<TileSet> tile_plain(const Region& lower, const Region& upper, double doubt,
                                  bool is_solid, TileWorkspace& workspace) {
  if (!lower.has_loops() || !upper.has_loops()) return {};
  Slab slab(lower, upper, {}, std::move(workspace.overlay));
  std::optional<Draft> drafted;
  if (slab.is_oriented() && !slab.has_near_contact(contact_of(doubt)))
    drafted = draft(slab, doubt, Overlay::exact, workspace);
  workspace.overlay = slab.release();
  if (!drafted || drafted->is_doubtful) return {};
  if (!collapse_crossings(lower, upper, drafted->tiles, is_solid)) return {};
  drafted->tiles.is_plain = true;
  return std::move(drafted->tiles);
}

std::optional<TileSet> tile_moved(const Region& lower, const Region& upper, Point shift,
                                  std::size_t most_pairs) {
  TileWorkspace workspace;
  return tile_moved(lower, upper, shift, most_pairs, true, workspace);
}

std::optional<TileSet> tile_with_crossings(const Region& lower, const Region& upper,
                                           std::size_t most_pairs) {
  TileWorkspace workspace;
  return tile_moved(lower, upper, {}, most_pairs, false, workspace);
}

void drop_unused_inner(std::vector<Tile>& tiles, std::vector<InnerVertex>& inner,
                       std::uint32_t contour_count) {
  constexpr std::uint32_t unused = Origin::none;
  std::vector<std::uint32_t> number(inner.size(), unused);
  for (const Tile& tile : tiles)
    for (const std::uint32_t node : tile.nodes)
      if (node >= contour_count) number[node - contour_count] = 0;
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == unused) continue;
    inner[count] = inner[i];
    number[i] = count++;
  }
  inner.resize(count);
  for (Tile& tile : tiles)
    for (std::uint32_t& node : tile.nodes)
      if (node >= contour_count) node = contour_count + number[node - contour_count];
}

TileSet tile_apart(const Region& lower, const Region& upper) {
  TileWorkspace workspace;
  Region nothing;
  nothing.z = lower.z + (upper.z - lower.z) / 2;
  nothing.loop_starts = {0};
  TileSet tiles = tile_end(lower, nothing, workspace);
  TileSet above = tile_end(nothing, upper, workspace);
  const auto lower_count = static_cast<std::uint32_t>(lower.points.size());
  const auto upper_count = static_cast<std::uint32_t>(upper.points.size());
  for (Tile& tile : tiles.tiles)
    for (std::uint32_t& node : tile.nodes)
      if (node >= lower_count) node += upper_count;
  const auto inner_count = static_cast<std::uint32_t>(tiles.inner.size());
  for (Tile& tile : above.tiles)
    for (std::uint32_t& node : tile.nodes)
      node += lower_count + (node >= upper_count ? inner_count : 0);
  tiles.inner.insert(tiles.inner.end(), above.inner.begin(), above.inner.end());
  tiles.tiles.insert(tiles.tiles.end(), above.tiles.begin(), above.tiles.end());
  tiles.is_linked = false;
  return tiles;
}

TileSet tile(const Region& lower, const Region& upper, TileWorkspace& workspace) {
  if (auto tiles = tile_moved(lower, upper, {}, any_number, true, workspace))
    return std::move(*tiles);
  return tile_apart(lower, upper);
}

TileSet tile(const Region& lower, const Region& upper) {
  TileWorkspace workspace;
  return tile(lower, upper, workspace);
}

}  // namespace loft
