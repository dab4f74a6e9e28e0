// SPDX-License-Identifier: MIT
#include "reconstruct/link/pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/box_tree.h"
#include "mesh/predicates.h"

namespace loft {

namespace {

using cdt::Point;

constexpr std::uint32_t none = Origin::none;

/// Area and first moments of what a loop encloses, signed, about an origin.
struct Moments {
  double area = 0;
  Point first;

  void operator+=(const Moments& other) {
    area += other.area;
    first = {first.x + other.first.x, first.y + other.first.y};
  }
};

/// Where the loop's smallest point is: sums begin there, so that they do not depend on where the
/// input's contour does.
std::size_t start(const Region& region, std::span<const std::uint32_t> loop) {
  const auto least =
      std::ranges::min_element(loop, {}, [&](std::uint32_t v) { return region.points[v]; });
  return static_cast<std::size_t>(least - loop.begin());
}

Moments moments(const Region& region, std::span<const std::uint32_t> loop, std::size_t start,
                Point origin) {
  const auto at = [&](std::size_t i) {
    const Point p = region.points[loop[i < loop.size() ? i : i - loop.size()]];
    return Point{p.x - origin.x, p.y - origin.y};
  };
  Moments sum;
  Point p = at(start);
  for (std::size_t i = start + 1; i <= start + loop.size(); ++i) {
    const Point q = at(i);
    const double area = (p.x * q.y - p.y * q.x) / 2;
    sum += {area, {area * (p.x + q.x) / 3, area * (p.y + q.y) / 3}};
    p = q;
  }
  return sum;
}

/// Whether two slices of one loop each are linked for sure: only ends and forks have Steiner
/// vertices.
bool is_single(const Region& lower, const Region& upper, const TileSet& tiles) {
  return lower.loop_count() == 1 && upper.loop_count() == 1 && tiles.is_linked &&
         std::ranges::find(tiles.inner, VertexKind::steiner, &InnerVertex::kind) ==
             tiles.inner.end();
}

Point smallest_point(const Region& lower, const Region& upper, const Piece& piece) {
  const Region& region = piece.lower.is_empty() ? upper : lower;
  const auto loop =
      region.loop(piece.lower.is_empty() ? piece.upper.loops[0] : piece.lower.loops[0]);
  return region.points[loop[start(region, loop)]];
}

/// Numbers pieces by their smallest points; those of the lower slice first.
void sort(const Region& lower, const Region& upper, Pieces& pieces) {
  struct Key {
    bool is_upper;
    Point point;
    std::uint32_t piece;
  };
  std::vector<Key> keys;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    keys.push_back({piece.lower.is_empty(), smallest_point(lower, upper, piece), i});
  }
  std::ranges::sort(keys, [](const Key& a, const Key& b) {
    if (a.is_upper != b.is_upper) return b.is_upper;
    return a.point != b.point ? a.point < b.point : a.piece < b.piece;
  });
  std::vector<Piece> sorted;
  std::vector<std::uint32_t> place(keys.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    sorted.push_back(std::move(pieces.pieces[keys[i].piece]));
    place[keys[i].piece] = i;
  }
  pieces.pieces = std::move(sorted);
  for (std::uint32_t& piece : pieces.of_tile) piece = place[piece];
}

Corners corners(const Region& lower, const Region& upper, const TileSet& tiles, const Tile& tile) {
  const auto place = [&](std::uint32_t node) { return place_of(lower, upper, tiles.inner, node); };
  return {place(tile.nodes[0]), place(tile.nodes[1]), place(tile.nodes[2])};
}

Box3 box(const Corners& corners) { return box_around(corners[0], corners[1], corners[2]); }

}  // namespace

bool measure(const Region& region, Footprint& footprint) {
  struct Start {
    Point point;
    std::size_t at;
    std::uint32_t loop;
  };
  std::vector<Start> starts;
  for (const std::uint32_t i : footprint.loops) {
    const std::size_t at = start(region, region.loop(i));
    starts.push_back({region.points[region.loop(i)[at]], at, i});
  }
  std::ranges::sort(starts, [](const Start& a, const Start& b) {
    return a.point != b.point ? a.point < b.point : a.loop < b.loop;
  });
  const Point origin = starts.front().point;
  Moments sum;
  std::vector<double> areas;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    footprint.loops[i] = starts[i].loop;
    const Moments loop = moments(region, region.loop(starts[i].loop), starts[i].at, origin);
    areas.push_back(loop.area);
    sum += loop;
  }
  const bool is_solid = sum.area > 0;
  footprint.area = std::abs(sum.area);
  footprint.parts = 0;
  double outer = 0;
  for (const double area : areas) {
    if ((area > 0) != is_solid) continue;
    ++footprint.parts;
    outer += std::abs(area);
  }
  footprint.radius = std::sqrt(outer / std::numbers::pi);
  footprint.centroid = origin;
  if (sum.area != 0)
    footprint.centroid = {origin.x + sum.first.x / sum.area, origin.y + sum.first.y / sum.area};
  return is_solid;
}

Pieces find_pieces(const Region& lower, const Region& upper, const TileSet& tiles) {
  Pieces found;
  if (is_single(lower, upper, tiles)) {
    Piece& piece = found.pieces.emplace_back();
    piece.lower.loops = piece.upper.loops = {0};
    measure(lower, piece.lower);
    measure(upper, piece.upper);
    found.of_tile.assign(tiles.tiles.size(), 0);
    return found;
  }
  const auto lower_count = static_cast<std::uint32_t>(lower.points.size());
  DisjointSets sets(lower_count + upper.points.size() + tiles.inner.size());
  for (const auto& [region, first] : {std::pair(&lower, 0U), std::pair(&upper, lower_count)})
    for (std::size_t i = 0; i < region->loop_count(); ++i)
      for (const std::uint32_t v : region->loop(i))
        sets.unite(first + region->loop(i)[0], first + v);
  for (const Tile& tile : tiles.tiles) {
    sets.unite(tile.nodes[0], tile.nodes[1]);
    sets.unite(tile.nodes[0], tile.nodes[2]);
  }
  std::vector<std::uint32_t> piece_of(lower_count + upper.points.size() + tiles.inner.size(), none);
  const auto piece = [&](std::uint32_t node) -> std::uint32_t {
    std::uint32_t& index = piece_of[sets.find(node)];
    if (index == none) {
      index = static_cast<std::uint32_t>(found.pieces.size());
      found.pieces.emplace_back();
    }
    return index;
  };
  for (std::uint32_t i = 0; i < lower.loop_count(); ++i)
    found.pieces[piece(lower.loop(i)[0])].lower.loops.push_back(i);
  for (std::uint32_t i = 0; i < upper.loop_count(); ++i)
    found.pieces[piece(lower_count + upper.loop(i)[0])].upper.loops.push_back(i);
  for (Piece& p : found.pieces) {
    if (!p.lower.is_empty()) p.is_solid = measure(lower, p.lower);
    if (!p.upper.is_empty()) p.is_solid = measure(upper, p.upper);
  }
  found.of_tile.reserve(tiles.tiles.size());
  for (const Tile& tile : tiles.tiles) found.of_tile.push_back(piece(tile.nodes[0]));
  sort(lower, upper, found);
  return found;
}

std::vector<double> differences(const Region& lower, const Region& upper, const TileSet& tiles,
                                const Pieces& pieces) {
  std::vector<double> sums(pieces.pieces.size());
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    const std::uint32_t piece = pieces.of_tile[t];
    const Point shift = pieces.pieces[piece].shift;
    std::array<Point, 3> flat;
    for (unsigned i = 0; i < 3; ++i) {
      const Vec3 p = place_of(lower, upper, tiles.inner, tiles.tiles[t].nodes[i]);
      const double share = (p[2] - lower.z) / (upper.z - lower.z);
      flat[i] = {p[0] + share * shift.x, p[1] + share * shift.y};
    }
    const auto& [a, b, c] = flat;
    sums[piece] += std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  return sums;
}

Extract::Extract(const Region& region, std::span<const std::uint32_t> loops, bool is_solid) {
  extract_.z = region.z;
  extract_.slice = region.slice;
  extract_.loop_starts.push_back(0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;  // of the region, and their order
  for (const std::uint32_t i : loops) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t v = is_solid ? loop[k] : loop[loop.size() - 1 - k];
      vertices.emplace_back(v, static_cast<std::uint32_t>(vertices.size()));
    }
    extract_.loop_starts.push_back(static_cast<std::uint32_t>(vertices.size()));
  }
  extract_.loop_vertices.resize(vertices.size());
  std::ranges::sort(vertices);
  for (const auto& [v, place] : vertices) {
    if (original_.empty() || original_.back() != v) {
      original_.push_back(v);
      extract_.points.push_back(region.points[v]);
      extract_.origins.push_back(region.origins[v]);
    }
    extract_.loop_vertices[place] = static_cast<std::uint32_t>(original_.size() - 1);
  }
}

TileSet embedded(TileSet tiles, const Extract& lower, const Extract& upper,
                 std::uint32_t lower_count, std::uint32_t upper_count, bool is_solid) {
  const auto part_lower = static_cast<std::uint32_t>(lower.region().points.size());
  const auto part_upper = static_cast<std::uint32_t>(upper.region().points.size());
  for (Tile& tile : tiles.tiles) {
    for (std::uint32_t& node : tile.nodes) {
      if (node < part_lower) {
        node = lower.original(node);
      } else if (node < part_lower + part_upper) {
        node = lower_count + upper.original(node - part_lower);
      } else {
        node = node - part_lower - part_upper + lower_count + upper_count;
      }
    }
    if (!is_solid) std::swap(tile.nodes[0], tile.nodes[1]);
  }
  return tiles;
}

void append(TileSet& tiles, const TileSet& more, std::uint32_t contour_count) {
  const auto inner_count = static_cast<std::uint32_t>(tiles.inner.size());
  tiles.inner.insert(tiles.inner.end(), more.inner.begin(), more.inner.end());
  for (Tile tile : more.tiles) {
    for (std::uint32_t& node : tile.nodes)
      if (node >= contour_count) node += inner_count;
    tiles.tiles.push_back(tile);
  }
}

namespace {

/// Decides which replacements hold, and puts them in.
class Replacing {
 public:
  Replacing(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
            std::span<Replacement> replacements)
      : lower_(lower),
        upper_(upper),
        tiles_(tiles),
        pieces_(pieces),
        replacements_(replacements),
        contour_count_(static_cast<std::uint32_t>(lower.points.size() + upper.points.size())),
        is_kept_(replacements.size(), true),
        by_(pieces.pieces.size(), none) {}

  bool run() {
    find_meetings();
    while (drop_one_that_meets()) {
    }
    if (std::ranges::find(is_kept_, true) == is_kept_.end()) return false;
    put_in();
    return true;
  }

 private:
  /// A replacement meets a piece, or another replacement behind it.
  struct Meeting {
    std::uint32_t replacement;
    std::uint32_t other;
    bool is_piece;

    friend auto operator<=>(const Meeting&, const Meeting&) = default;
  };

  [[nodiscard]] bool is_replaced(std::uint32_t replacement, std::uint32_t piece) const {
    const auto& replaced = replacements_[replacement].replaced;
    return std::ranges::find(replaced, piece) != replaced.end();
  }

  /// The tiles of a replacement, to be found by their places.
  struct Placed {
    std::vector<Corners> corners;
    Box3 box;
    BoxTree tree;

    [[nodiscard]] bool meets(const Corners& tile) const {
      bool is_found = false;
      tree.for_each_meeting(loft::box(tile), [&](std::uint32_t i) {
        is_found = is_found || triangles_meet(tile, corners[i]);
      });
      return is_found;
    }
  };

  [[nodiscard]] Placed placed(const TileSet& tiles) const {
    std::vector<Corners> places;
    std::vector<Box3> boxes;
    for (const Tile& tile : tiles.tiles) {
      places.push_back(corners(lower_, upper_, tiles, tile));
      boxes.push_back(box(places.back()));
    }
    const Box3 whole = std::accumulate(boxes.begin(), boxes.end(), boxes.front(), joined);
    return {std::move(places), whole, BoxTree(boxes)};
  }

  /// Tiles of one replacement, and those that it replaces, may be many and near each other: boxes
  /// around whole replacements keep them from being compared.
  void find_meetings() {
    std::vector<Placed> placed;
    std::vector<Box3> boxes;
    for (const Replacement& replacement : replacements_) {
      placed.push_back(this->placed(replacement.tiles));
      boxes.push_back(placed.back().box);
    }
    const BoxTree tree(boxes);
    tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) {
      const auto meets = [&](const Corners& tile) { return placed[i].meets(tile); };
      if (std::ranges::any_of(placed[j].corners, meets))
        meetings_.push_back({std::min(i, j), std::max(i, j), false});
    });
    for (std::size_t t = 0; t < tiles_.tiles.size(); ++t) {
      const Corners here = corners(lower_, upper_, tiles_, tiles_.tiles[t]);
      const std::uint32_t piece = pieces_.of_tile[t];
      tree.for_each_meeting(box(here), [&](std::uint32_t r) {
        if (!is_replaced(r, piece) && placed[r].meets(here)) meetings_.push_back({r, piece, true});
      });
    }
    std::ranges::sort(meetings_);
    meetings_.erase(std::unique(meetings_.begin(), meetings_.end()), meetings_.end());
  }

  /// Of two that want the same piece, and of two that meet, the second goes; of one that meets a
  /// piece that stays, that one. Pieces of those dropped stay, after all.
  bool drop_one_that_meets() {
    std::ranges::fill(by_, none);
    for (std::uint32_t r = 0; r < replacements_.size(); ++r) {
      if (!is_kept_[r]) continue;
      for (const std::uint32_t piece : replacements_[r].replaced) {
        if (by_[piece] != none) {
          is_kept_[r] = false;
          return true;
        }
        by_[piece] = r;
      }
    }
    for (const Meeting& meeting : meetings_) {
      if (!is_kept_[meeting.replacement]) continue;
      if (meeting.is_piece ? by_[meeting.other] != none : !is_kept_[meeting.other]) continue;
      is_kept_[meeting.is_piece ? meeting.replacement : meeting.other] = false;
      return true;
    }
    return false;
  }

  void put_in() {
    std::vector<Tile> kept;
    std::vector<std::uint32_t> of_kept;
    for (std::size_t t = 0; t < tiles_.tiles.size(); ++t) {
      if (by_[pieces_.of_tile[t]] != none) continue;
      kept.push_back(tiles_.tiles[t]);
      of_kept.push_back(pieces_.of_tile[t]);
    }
    tiles_.tiles = std::move(kept);
    pieces_.of_tile = std::move(of_kept);
    drop_unused_inner();
    for (std::uint32_t r = 0; r < replacements_.size(); ++r) {
      if (!is_kept_[r]) continue;
      const Replacement& replacement = replacements_[r];
      append(tiles_, replacement.tiles, contour_count_);
      const auto count = static_cast<std::uint32_t>(pieces_.pieces.size());
      for (const std::uint32_t piece : replacement.pieces.of_tile)
        pieces_.of_tile.push_back(count + piece);
      for (const Piece& piece : replacement.pieces.pieces) pieces_.pieces.push_back(piece);
    }
    drop_replaced_pieces();
  }

  void drop_unused_inner() {
    std::vector<std::uint32_t> number(tiles_.inner.size(), none);
    for (const Tile& tile : tiles_.tiles)
      for (const std::uint32_t node : tile.nodes)
        if (node >= contour_count_) number[node - contour_count_] = 0;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (number[i] == none) continue;
      tiles_.inner[count] = tiles_.inner[i];
      number[i] = count++;
    }
    tiles_.inner.resize(count);
    for (Tile& tile : tiles_.tiles)
      for (std::uint32_t& node : tile.nodes)
        if (node >= contour_count_) node = contour_count_ + number[node - contour_count_];
  }

  void drop_replaced_pieces() {
    by_.resize(pieces_.pieces.size(), none);
    std::vector<Piece> left;
    std::vector<std::uint32_t> place(by_.size(), none);
    for (std::uint32_t i = 0; i < by_.size(); ++i) {
      if (by_[i] != none) continue;
      place[i] = static_cast<std::uint32_t>(left.size());
      left.push_back(std::move(pieces_.pieces[i]));
    }
    pieces_.pieces = std::move(left);
    for (std::uint32_t& piece : pieces_.of_tile) piece = place[piece];
    sort(lower_, upper_, pieces_);
  }

  const Region& lower_;
  const Region& upper_;
  TileSet& tiles_;
  Pieces& pieces_;
  std::span<Replacement> replacements_;
  std::uint32_t contour_count_;
  std::vector<Meeting> meetings_;
  std::vector<bool> is_kept_;
  std::vector<std::uint32_t> by_;  // the replacement that each piece gives way to, or none
};

}  // namespace

bool replace(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
             std::span<Replacement> replacements) {
  if (replacements.empty()) return false;
  return Replacing(lower, upper, tiles, pieces, replacements).run();
}

}  // namespace loft
