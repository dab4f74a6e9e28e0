// SPDX-License-Identifier: MIT
#include "reconstruct/tiles.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "cdt/predicates.h"
#include "cdt/regions.h"
#include "reconstruct/box_tree.h"
#include "reconstruct/crossings.h"
#include "reconstruct/predicates.h"
#include "reconstruct/slab.h"

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
  Tiling(const Slab& slab, const Lift& lift) : slab_(slab), mesh_(slab.overlay()), lift_(lift) {}

  TileSet run() {
    tiles_.inner = lift_.inner();
    tiles_.tiles.reserve(mesh_.triangle_bound());
    add_sheets();
    for (std::uint32_t s = 0; s < mesh_.segment_bound(); ++s) add_wall(SegmentId(s));
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
  void add_wall(SegmentId s) {
    const Level level = slab_.level(s);
    const cdt::Segment& segment = mesh_.segment(s);
    const std::uint32_t from = lift_.node(slab_.index(segment.from, level), level);
    const std::uint32_t to = lift_.node(slab_.index(segment.to, level), level);
    find_roof(s, level);
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

  /// The nodes above or below a contour edge, from its start to its end.
  void find_roof(SegmentId s, Level level) {
    roof_.clear();
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

  /// Triangulates polygon_, counter-clockwise as seen from outside, over the line from -> to.
  void fill_upright(const Vec3& from, const Vec3& to) {
    const unsigned axis = std::abs(to[0] - from[0]) >= std::abs(to[1] - from[1]) ? 0 : 1;
    const double sign = to[axis] > from[axis] ? 1 : -1;
    flat_.clear();
    for (const std::uint32_t node : polygon_) {
      const Vec3 p = place(node);
      flat_.push_back({sign * p[axis], p[2]});
    }
    const std::size_t count = tiles_.tiles.size();
    if (polygon_.size() > 3) fill_polygon();
    if (tiles_.tiles.size() == count + polygon_.size() - 2) return;
    // A triangle; or rounding has bent the roof into the base: then what counts is to close it.
    tiles_.tiles.resize(count);
    is_forced_ =
        is_forced_ || polygon_.size() > 3 || cdt::orient(flat_[0], flat_[1], flat_[2]) == 0;
    for (std::size_t i = 1; i + 1 < polygon_.size(); ++i)
      add({polygon_[0], polygon_[i], polygon_[i + 1]}, FaceKind::wall);
  }

  /// The polygon's constrained Delaunay triangulation: of all ways to cut it the one with the best
  /// shapes. Adds nothing if the polygon crosses itself.
  void fill_polygon() {
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
      add({corner_[wall_.from(e).index()], corner_[wall_.to(e).index()],
           corner_[wall_.apex(e).index()]},
          FaceKind::wall);
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
  Triangulation wall_;
  std::vector<std::uint32_t> corner_;
};

/// Lengths of a slab that matter for rounding.
struct Scale {
  double shear;  // small against the slices, large against rounding
  double tight;  // triangles lower than that are tested for what rounding does to them
};

Scale scale(const Region& lower, const Region& upper) {
  cdt::Box box;
  double farthest = 0;
  for (const Region* region : {&lower, &upper}) {
    for (const Point p : region->points) {
      box.add(p);
      farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
    }
  }
  const double size = box.is_empty() ? 0 : std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return {std::max(size * 0x1p-18, farthest * 0x1p-34),
          std::max(size * 0x1p-28, farthest * 0x1p-44)};
}

/// Whether two tiles meet elsewhere than in common corners and edges (exact).
bool meet(const Region& lower, const Region& upper, const TileSet& tiles) {
  std::vector<Corners> corners;
  std::vector<Box3> boxes;
  for (const Tile& tile : tiles.tiles) {
    auto& places = corners.emplace_back();
    for (unsigned i = 0; i < 3; ++i) places[i] = place_of(lower, upper, tiles.inner, tile.nodes[i]);
    boxes.push_back(box_around(places[0], places[1], places[2]));
    if (collinear(places[0], places[1], places[2])) return true;
  }
  bool is_found = false;
  BoxTree(boxes).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    is_found = is_found || triangles_meet(corners[i], corners[j]);
  });
  return is_found;
}

/// That often a slab is sheared anew before its slices are left apart.
constexpr int most_shears = 12;

}  // namespace

TileSet tile_apart(const Region& lower, const Region& upper) {
  Region nothing;
  nothing.z = lower.z + (upper.z - lower.z) / 2;
  nothing.loop_starts = {0};
  TileSet tiles = tile(lower, nothing);
  TileSet above = tile(nothing, upper);
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

/// Where contours of both slices meet within rounding of each other, as three lines through one
/// point may, the overlay can't be exact. Then the slab is sheared a little before it is tiled, in
/// no special direction, and back again: a shear keeps tiles valid, and nothing meets by chance.
std::optional<TileSet> tile_moved(const Region& lower, const Region& upper, cdt::Point shift) {
  const Scale lengths = scale(lower, upper);
  const bool is_end = lower.is_empty() || upper.is_empty();  // nothing that could coincide
  for (int attempt = 0; attempt < most_shears; ++attempt) {
    const double turn = 2.399963 * attempt;  // the golden angle
    const double step = attempt * lengths.shear;
    Slab slab(lower, upper, {shift.x + step * std::cos(turn), shift.y + step * std::sin(turn)});
    if (!is_end && !slab.is_exact()) continue;
    const Lift lift(slab);
    Tiling tiling(slab, lift);
    TileSet tiles = tiling.run();
    if (is_end) return tiles;
    const bool is_doubtful =
        attempt > 0 || shift != cdt::Point() || tiling.is_forced() || slab.is_tight(lengths.tight);
    collapse_crossings(lower, upper, tiles);
    if (!is_doubtful || !meet(lower, upper, tiles)) return tiles;
  }
  return std::nullopt;
}

TileSet tile(const Region& lower, const Region& upper) {
  if (auto tiles = tile_moved(lower, upper, {})) return std::move(*tiles);
  return tile_apart(lower, upper);
}

}  // namespace loft
