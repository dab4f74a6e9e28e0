// SPDX-License-Identifier: MIT
#include "reconstruct/shape/smooth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "mesh/predicates.h"
#include "mesh/triangle_pairs.h"
#include "mesh/vec3.h"
#include "reconstruct/shape/edge_index.h"
#include "reconstruct/shape/freedom.h"
#include "reconstruct/shape/outlines.h"

namespace loft {

namespace {

using cdt::Point;

constexpr std::uint32_t none = Origin::none;

/// An edge is split where its middle is further from the smooth surface than that share of the
/// slab's height, at most that many times over. On 19 stacks a fourth round gained less than 2%.
constexpr double coarseness = 0.01;
constexpr int most_rounds = 3;

/// How far a vertex may go: new ones as a share of their edge, those of forks and ends as a share
/// of the slab's height.
constexpr double most_of_edge = 0.35;
constexpr double most_of_fork = 0.5;
constexpr double most_of_end = 1;

/// Vertices stay that share of the slab's height away from the slices.
constexpr double least_share = 0.02;

/// Where the function is flatter than that, its zero is not near.
constexpr double least_gradient = 0.2;
constexpr int newton_steps = 3;

/// A place is on the smooth surface if it is nearer than that share of the slab's height.
constexpr double nearness = 0.003;

/// Where bent tiles meet they are straightened by half, and wholly below that share.
constexpr double least_bend = 0.2;
constexpr int most_corrections = 12;

/// The same whichever end is named first.
Vec3 middle(const Vec3& a, const Vec3& b) {
  const Vec3& first = std::min(a, b);
  return along(first, 0.5, minus(std::max(a, b), first));
}

/// A way, cut off where it is longer than `most`.
Vec3 cut_off(const Vec3& way, double most) {
  const double distance = length(way);
  return distance > most ? along({}, most / distance, way) : way;
}

/// What a connected piece of the tiles is bent to; nothing if its slices do not tell.
using Shape = std::variant<std::monostate, SmoothPassage, SmoothEnd>;

/// The deepest known place of a part.
struct Depth {
  Point place;
  double depth = 0;
};

/// Pattern search (Hooke and Jeeves, 1961): to the best of eight places around, nearer by half
/// where none is better.
void deepen(Depth& deepest, const SignedDistance& distance) {
  const double side = distance.at(deepest.place).distance < 0 ? -1 : 1;
  constexpr double finest = 0.01;
  for (double step = deepest.depth / 2; step > finest * deepest.depth;) {
    Depth best = deepest;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        const Point place{deepest.place.x + step * x, deepest.place.y + step * y};
        const double depth = side * distance.at(place).distance;
        if (depth > best.depth) best = {place, depth};
      }
    }
    if (best.depth > deepest.depth) {
      deepest = best;
    } else {
      step /= 2;
    }
  }
}

/// The deepest place of each piece that ends in the slab, as near as a search from its corners and
/// middles of edges comes; of equally deep ones the first by coordinates.
std::vector<Depth> find_depths(const Region& lower, const Region& upper, const Surroundings& slices,
                               const Pieces& pieces, const TileSet& tiles) {
  std::vector<Depth> deepest(pieces.pieces.size());
  const auto shape = [&](const Piece& piece) -> const SignedDistance& {
    return slices[piece.lower.is_empty() ? 2 : 1]->distance;
  };
  for (std::uint32_t t = 0; t < tiles.tiles.size(); ++t) {
    const Piece& piece = pieces.pieces[pieces.of_tile[t]];
    if (!piece.is_end()) continue;
    Depth& known = deepest[pieces.of_tile[t]];
    const auto look = [&](const Vec3& p) {
      const Point place{p[0], p[1]};
      const double depth = std::abs(shape(piece).at(place).distance);
      if (depth > known.depth || (depth == known.depth && place < known.place))
        known = {place, depth};
    };
    const auto& nodes = tiles.tiles[t].nodes;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = place_of(lower, upper, tiles.inner, nodes[i]);
      look(p);
      look(middle(p, place_of(lower, upper, tiles.inner, nodes[(i + 1) % 3])));
    }
  }
  for (std::uint32_t i = 0; i < deepest.size(); ++i)
    if (deepest[i].depth > 0) deepen(deepest[i], shape(pieces.pieces[i]));
  return deepest;
}

/// What each piece is bent to.
std::vector<Shape> find_shapes(const BentSlab& slab, const TileSet& tiles) {
  const auto& [lower, upper, slices, pieces] = slab;
  const std::vector<Depth> depths = find_depths(lower, upper, slices, pieces, tiles);
  std::vector<Shape> shapes(pieces.pieces.size());
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.is_tip()) continue;  // a point or a line tells where it ends
    if (!piece.bends) continue;
    if (!piece.is_end()) {
      // What goes several ways at once is bent over each place as it is.
      const Point way = piece.registered_difference ? Point{} : piece.shift;
      shapes[i] = SmoothPassage(slices, {-way.x, -way.y});
    } else if (depths[i].depth > 0) {
      shapes[i] = SmoothEnd(slices, piece.lower.is_empty() ? 2 : 1, depths[i].place,
                            depths[i].depth, piece.lean);
    }
  }
  return shapes;
}

/// 0 where directions are against each other by more than 120 degrees.
Point unit(Point sum) {
  const double length = std::hypot(sum.x, sum.y);
  return length < 0.999 ? Point{} : Point{sum.x / length, sum.y / length};
}

/// At the points of both regions, one after the other.
std::vector<OutlinePoint> outlines_of(const Region& lower, const Region& upper) {
  std::vector<OutlinePoint> points = outline_points(lower);
  const std::vector<OutlinePoint> above = outline_points(upper);
  points.insert(points.end(), above.begin(), above.end());
  return points;
}

class Smoothing {
 public:
  Smoothing(const BentSlab& slab, std::span<const OutlinePoint> outlines, TileSet tiles)
      : lower_(slab.lower),
        upper_(slab.upper),
        plain_(std::move(tiles)),
        tiles_(plain_),
        piece_(slab.pieces.of_tile),
        shapes_(find_shapes(slab, plain_)),
        freedom_(slab, outlines, plain_),
        lower_count_(static_cast<std::uint32_t>(lower_.points.size())),
        contour_count_(lower_count_ + static_cast<std::uint32_t>(upper_.points.size())) {
    for (const OutlinePoint& point : outlines) facing_.push_back(unit(point.facing));
    facing_.resize(contour_count_ + plain_.inner.size());
  }

  TileSet run() {
    move_inner();
    for (int round = 0; round < most_rounds && refine(); ++round) {
    }
    for (int i = 0; i < most_corrections; ++i) {
      if (!straighten()) return std::move(tiles_);
    }
    return std::move(plain_);
  }

 private:
  /// How an inner vertex came to its place: from the middle of an edge, or from where it was.
  struct Move {
    std::array<std::uint32_t, 2> edge;  // none: it was there before
    Vec3 start;
    Vec3 way;
    Vec3 straight;  // where it would be if no edge were bent
    double share = 1;
  };

  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, tiles_.inner, node);
  }

  [[nodiscard]] Vec3 straight_place(std::uint32_t node) const {
    return node < contour_count_ ? place(node) : moves_[node - contour_count_].straight;
  }

  [[nodiscard]] bool is_contour(std::uint32_t a, std::uint32_t b) const {
    return std::max(a, b) < contour_count_ && (a < lower_count_) == (b < lower_count_);
  }

  [[nodiscard]] double height() const { return upper_.z - lower_.z; }

  /// The way from p to the smooth surface, no further than `most`, where it faces as contours do.
  [[nodiscard]] Vec3 way_to(const Shape& shape, const Vec3& p, double most, Point facing) const {
    if (const auto* passage = std::get_if<SmoothPassage>(&shape))
      return way_to([&](const Vec3& q) { return passage->at(q, facing); }, p, most);
    if (const auto* end = std::get_if<SmoothEnd>(&shape)) {
      const Vec3 upright = end->upright(p);
      const Vec3 way = way_to([&](const Vec3& q) { return end->at(q); }, upright, most);
      return minus(end->leant(along(upright, 1, way)), p);
    }
    return {};
  }

  template <class SampleAt>
  [[nodiscard]] Vec3 way_to(const SampleAt& sample_at, const Vec3& p, double most) const {
    Vec3 way{};
    for (int step = 0; step < newton_steps; ++step) {
      const Sample sample = sample_at(along(p, 1, way));
      const double steepness = std::max(length(sample.gradient), least_gradient);
      if (std::abs(sample.value) < nearness * height() * steepness) break;
      way = along(way, -sample.value / (steepness * steepness), sample.gradient);
      const double least = least_share * height();
      way[2] = std::clamp(p[2] + way[2], lower_.z + least, upper_.z - least) - p[2];
      way = cut_off(way, most);
    }
    return way;
  }

  /// The vertices that forks, ends and crossings have already.
  void move_inner() {
    std::vector<std::uint32_t> piece(tiles_.inner.size(), none);
    for (std::uint32_t t = 0; t < tiles_.tiles.size(); ++t)
      for (const std::uint32_t node : tiles_.tiles[t].nodes)
        if (node >= contour_count_) piece[node - contour_count_] = piece_[t];
    for (std::uint32_t i = 0; i < tiles_.inner.size(); ++i) {
      const Vec3 start = tiles_.inner[i].place;
      const Shape& shape = shapes_[piece[i]];
      const bool is_end = std::holds_alternative<SmoothEnd>(shape);
      const double most = (is_end ? most_of_end : most_of_fork) * height();
      const double freedom = freedom_.of_node(contour_count_ + i, piece[i]);
      const Vec3 way = along({}, freedom, way_to(shape, start, most, {}));
      moves_.push_back({{none, none}, start, way, start});
      tiles_.inner[i].place = along(start, 1, way);
    }
  }

  /// Splits every edge whose middle is off the smooth surface. Returns whether there was one.
  bool refine() {
    std::vector<Tile> tiles;
    std::vector<std::uint32_t> pieces;
    for (std::uint32_t t = 0; t < tiles_.tiles.size(); ++t) {
      const Tile& tile = tiles_.tiles[t];
      const std::uint32_t piece = piece_[t];
      std::array<std::uint32_t, 3> split;
      for (std::size_t i = 0; i < 3; ++i)
        split[i] = middle_of(tile.nodes[i], tile.nodes[(i + 1) % 3], piece);
      cut(tile, split, tiles);
      pieces.resize(tiles.size(), piece);
    }
    const bool is_changed = tiles.size() != tiles_.tiles.size();
    tiles_.tiles = std::move(tiles);
    piece_ = std::move(pieces);
    return is_changed;
  }

  /// The node that an edge is split at; none if it stays.
  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b, std::uint32_t piece) {
    if (is_contour(a, b)) return none;
    const auto [node, is_known] = middles_.at(a, b);
    if (is_known) return node;
    const Vec3 start = middle(place(a), place(b));
    const Vec3 straight = middle(straight_place(a), straight_place(b));
    const Point facing = unit({facing_[a].x + facing_[b].x, facing_[a].y + facing_[b].y});
    const double freedom = freedom_.of_edge(a, b, piece);
    const double most = most_of_edge * length(minus(place(a), place(b)));
    Vec3 way = minus(straight, start);
    if (freedom > 0) {
      // Its ends were given way by as much: the smooth surface is further from it than from them.
      const double given = (1 - freedom) / freedom * length(way);
      const Vec3 bent = way_to(shapes_[piece], start, most + given, facing);
      way = along(bent, 1 - freedom, minus(way, bent));
    }
    way = cut_off(way, most);
    if (!(length(way) > coarseness * height())) return none;
    node = contour_count_ + static_cast<std::uint32_t>(tiles_.inner.size());
    tiles_.inner.push_back({along(start, 1, way), VertexKind::steiner});
    moves_.push_back({{a, b}, start, way, straight});
    freedom_.add_middle(a, b);
    facing_.push_back(facing);
    return node;
  }

  /// Cuts a tile at the middles of its edges, `split[i]` between its nodes i and i + 1.
  void cut(const Tile& tile, const std::array<std::uint32_t, 3>& split, std::vector<Tile>& tiles) {
    const auto count = 3 - std::ranges::count(split, none);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      tiles.push_back({{a, b, c}, tile.kind});
    };
    if (count == 0) {
      tiles.push_back(tile);
      return;
    }
    // Begin with a split edge; of two with the one that the other follows.
    std::size_t first = 0;
    while (split[first] == none || (count == 2 && split[(first + 1) % 3] == none)) ++first;
    const std::uint32_t a = tile.nodes[first];
    const std::uint32_t b = tile.nodes[(first + 1) % 3];
    const std::uint32_t c = tile.nodes[(first + 2) % 3];
    const std::uint32_t ab = split[first];
    const std::uint32_t bc = split[(first + 1) % 3];
    const std::uint32_t ca = split[(first + 2) % 3];
    if (count == 1) {
      add(a, ab, c);
      add(ab, b, c);
    } else if (count == 3) {
      add(a, ab, ca);
      add(ab, b, bc);
      add(ca, bc, c);
      add(ab, bc, ca);
    } else {
      add(ab, b, bc);
      if (length(minus(place(a), place(bc))) < length(minus(place(ab), place(c)))) {
        add(a, ab, bc);
        add(a, bc, c);
      } else {
        add(a, ab, c);
        add(ab, bc, c);
      }
    }
  }

  /// Takes moves back by half where tiles meet. Returns whether there were any.
  bool straighten() {
    find_meeting();
    if (std::ranges::find(is_met_, true) == is_met_.end()) return false;
    std::vector<std::uint32_t> front;
    for (std::uint32_t t = 0; t < is_met_.size(); ++t)
      if (is_met_[t])
        front.insert(front.end(), tiles_.tiles[t].nodes.begin(), tiles_.tiles[t].nodes.end());
    std::vector<bool> is_done(moves_.size());
    while (!front.empty()) {
      const std::uint32_t node = front.back();
      front.pop_back();
      if (node == none || node < contour_count_ || is_done[node - contour_count_]) continue;
      is_done[node - contour_count_] = true;
      Move& move = moves_[node - contour_count_];
      move.share = move.share > least_bend ? move.share / 2 : 0;
      front.insert(front.end(), move.edge.begin(), move.edge.end());
    }
    std::vector<bool> is_moved(moves_.size());
    for (std::uint32_t i = 0; i < moves_.size(); ++i) {
      const Vec3 before = tiles_.inner[i].place;
      Move& move = moves_[i];
      if (move.edge[0] != none)
        move.start = middle(this->place(move.edge[0]), this->place(move.edge[1]));
      Vec3& place = tiles_.inner[i].place;
      place = along(move.start, move.share, move.way);
      // Its edge has moved, too: not beyond a slice.
      const double least = least_share * height();
      place[2] = std::clamp(place[2], std::min(lower_.z + least, move.start[2]),
                            std::max(upper_.z - least, move.start[2]));
      is_moved[i] = place != before;
    }
    find_doubtful(is_moved);
    return true;
  }

  /// The tiles of which some may meet now: those that have changed, and those that met before.
  void find_doubtful(const std::vector<bool>& is_moved) {
    doubtful_.clear();
    for (std::uint32_t t = 0; t < is_met_.size(); ++t) {
      const auto& nodes = tiles_.tiles[t].nodes;
      const bool has_changed = std::ranges::any_of(nodes, [&](std::uint32_t node) {
        return node >= contour_count_ && is_moved[node - contour_count_];
      });
      if (has_changed || is_met_[t]) doubtful_.push_back(t);
    }
  }

  [[nodiscard]] Corners corners(std::uint32_t tile) const {
    const auto& [a, b, c] = tiles_.tiles[tile].nodes;
    return {place(a), place(b), place(c)};
  }

  /// The tiles that are degenerate or meet others elsewhere than in common corners and edges.
  void find_meeting() {
    if (!pairs_) {
      doubtful_.resize(tiles_.tiles.size());
      std::iota(doubtful_.begin(), doubtful_.end(), 0U);
      corners_.resize(tiles_.tiles.size());
      for (const Tile& tile : tiles_.tiles) nodes_.push_back(tile.nodes);
    }
    is_met_.assign(tiles_.tiles.size(), false);
    for (const std::uint32_t t : doubtful_) {
      const Corners& c = corners_[t] = corners(t);
      is_met_[t] = collinear(c[0], c[1], c[2]);
    }
    if (pairs_) {
      pairs_->update(doubtful_, corners_, nodes_);
    } else {
      pairs_.emplace(corners_, nodes_, contour_count_ + tiles_.inner.size());
    }
    pairs_->for_each_changed([&](std::uint32_t i, std::uint32_t j) {
      if ((is_met_[i] && is_met_[j]) || !triangles_meet(corners_[i], corners_[j])) return;
      is_met_[i] = is_met_[j] = true;
    });
  }

  const Region& lower_;
  const Region& upper_;
  TileSet plain_;
  TileSet tiles_;
  std::vector<std::uint32_t> piece_;  // of each tile
  std::vector<Shape> shapes_;         // of each piece
  Freedom freedom_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
  std::vector<Move> moves_;              // of each inner vertex
  std::vector<Point> facing_;            // of each node: outwards as contours do there, or 0
  std::vector<bool> is_met_;             // of each tile, when that was looked at last
  std::vector<std::uint32_t> doubtful_;  // the tiles of which that has to be found anew
  std::vector<Corners> corners_;         // of each tile, then
  std::vector<TrianglePairs::Vertices> nodes_;
  std::optional<TrianglePairs> pairs_;  // of those that may meet
  EdgeIndex middles_;                   // the node that each edge is split at; none if it stays
};

}  // namespace

TileSet smooth(const Region& lower, const Region& upper, const Surroundings& slices,
               const Pieces& pieces, TileSet tiles) {
  if (!tiles.is_linked || tiles.tiles.empty()) return tiles;
  const std::vector<OutlinePoint> outlines = outlines_of(lower, upper);
  return Smoothing({lower, upper, slices, pieces}, outlines, std::move(tiles)).run();
}

}  // namespace loft
