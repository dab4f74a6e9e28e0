// SPDX-License-Identifier: MIT
#include "reconstruct/shape/forks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/vec3.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/shape/bent_tiles.h"
#include "reconstruct/shape/freedom.h"
#include "reconstruct/shape/half_edges.h"
#include "reconstruct/shape/outlines.h"
#include "reconstruct/shape/straighten.h"

namespace loft {

namespace {

/// How far around vertices between the slices edges may be flipped. With more rings tiles come
/// nearer by little, for more time; with one or two the sparse vessel tree loses volume.
constexpr int rings = 4;

bool goes_through(const Piece& piece) { return !piece.is_end() && !piece.is_tip() && piece.bends; }

/// The tiles at forks or the others, with the inner vertices that they have.
TileSet tiles_of(const Region& lower, const Region& upper, const TileSet& tiles,
                 const std::vector<bool>& at_forks, bool are_at_forks) {
  TileSet some;
  some.inner = tiles.inner;
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t)
    if (at_forks[t] == are_at_forks) some.tiles.push_back(tiles.tiles[t]);
  drop_unused_inner(some.tiles, some.inner, contour_count(lower, upper));
  return some;
}

/// The tiles that fork, in an order that their places alone decide.
class OrderedForks {
 public:
  OrderedForks(const Region& lower, const Region& upper, const TileSet& tiles)
      : lower_(lower), upper_(upper), tiles_(tiles) {}

  /// `of_tile`: the piece of each tile; brought into the same order.
  [[nodiscard]] TileSet ordered(std::vector<std::uint32_t>& of_tile) {
    for (std::uint32_t t = 0; t < of_tile.size(); ++t) sorted_.push_back(sortable(t, of_tile[t]));
    std::ranges::sort(sorted_, {}, &Sortable::places);
    TileSet made;
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
      made.tiles.push_back(sorted_[i].tile);
      of_tile[i] = sorted_[i].piece;
    }
    number_inner(made);
    return made;
  }

 private:
  struct Sortable {
    std::array<Vec3, 3> places;
    Tile tile;
    std::uint32_t piece;
  };

  /// The corner with the smallest coordinates first. None is upright (see Uprights): what was a
  /// wall between contours that were moved over each other is as good as a sheet.
  [[nodiscard]] Sortable sortable(std::uint32_t t, std::uint32_t piece) const {
    Sortable made{{}, {tiles_.tiles[t].nodes, FaceKind::sheet}, piece};
    const auto place = [&](std::uint32_t node) {
      return place_of(lower_, upper_, tiles_.inner, node);
    };
    auto& nodes = made.tile.nodes;
    std::rotate(nodes.begin(), std::ranges::min_element(nodes, {}, place), nodes.end());
    std::ranges::transform(nodes, made.places.begin(), place);
    return made;
  }

  /// As tiles have them first.
  void number_inner(TileSet& made) const {
    const std::uint32_t first = contour_count(lower_, upper_);
    std::vector<std::uint32_t> numbers(tiles_.inner.size(), Origin::none);
    for (Tile& tile : made.tiles) {
      for (std::uint32_t& node : tile.nodes) {
        if (node < first) continue;
        std::uint32_t& number = numbers[node - first];
        if (number == Origin::none) {
          number = first + static_cast<std::uint32_t>(made.inner.size());
          made.inner.push_back(tiles_.inner[node - first]);
        }
        node = number;
      }
    }
  }

  const Region& lower_;
  const Region& upper_;
  const TileSet& tiles_;
  std::vector<Sortable> sorted_;
};

/// Those that have some of the tiles alone, numbered anew.
Pieces only(const Pieces& pieces, const std::vector<bool>& tiles) {
  Pieces some;
  std::vector<std::uint32_t> numbers(pieces.pieces.size(), Origin::none);
  for (std::size_t t = 0; t < tiles.size(); ++t)
    if (tiles[t]) numbers[pieces.of_tile[t]] = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == Origin::none) continue;
    numbers[i] = static_cast<std::uint32_t>(some.pieces.size());
    some.pieces.push_back(pieces.pieces[i]);
  }
  for (std::size_t t = 0; t < tiles.size(); ++t)
    if (tiles[t]) some.of_tile.push_back(numbers[pieces.of_tile[t]]);
  return some;
}

/// Whether a tile has an edge that is upright but for rounding: contours of both slices meet there.
class Uprights {
 public:
  Uprights(const Region& lower, const Region& upper)
      : lower_(lower),
        upper_(upper),
        lower_count_(static_cast<std::uint32_t>(lower.points.size())),
        first_inner_(contour_count(lower, upper)),
        contact_(contact(lower, upper)) {}

  [[nodiscard]] bool has_any(const Tile& tile) const {
    const auto& [a, b, c] = tile.nodes;
    return is_upright(a, b) || is_upright(b, c) || is_upright(c, a);
  }

 private:
  [[nodiscard]] bool is_upright(std::uint32_t a, std::uint32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    if (low >= lower_count_ || high < lower_count_ || high >= first_inner_) return false;
    const cdt::Point p = lower_.points[low];
    const cdt::Point q = upper_.points[high - lower_count_];
    return std::hypot(q.x - p.x, q.y - p.y) <= contact_;
  }

  const Region& lower_;
  const Region& upper_;
  std::uint32_t lower_count_;
  std::uint32_t first_inner_;
  double contact_;
};

/// Of those of the tiles that are asked for: which lie in a plane with one beside them, but for
/// rounding, so that the diagonal of the two could as well be the other one.
std::vector<bool> find_ties(const Region& lower, const Region& upper, const TileSet& tiles,
                            const std::vector<bool>& asked) {
  std::vector<Tile> some;
  std::vector<std::size_t> numbers;
  for (std::size_t t = 0; t < asked.size(); ++t) {
    if (!asked[t]) continue;
    some.push_back(tiles.tiles[t]);
    numbers.push_back(t);
  }
  const double least = contact(lower, upper);
  const HalfEdges half_edges(some);
  std::vector<bool> ties(asked.size());
  for (std::uint32_t half = 0; half < half_edges.count(); ++half) {
    const std::uint32_t twin = half_edges.twin(half);
    if (twin == Origin::none || half > twin) continue;
    const auto [a, b, left, right] = half_edges.diamond(half);
    const auto from_a = [&, start = place_of(lower, upper, tiles.inner, a)](std::uint32_t node) {
      return minus(place_of(lower, upper, tiles.inner, node), start);
    };
    const Vec3 normal = cross(from_a(b), from_a(left));
    if (std::abs(dot(normal, from_a(right))) <= least * length(normal))
      ties[numbers[half / 3]] = ties[numbers[twin / 3]] = true;
  }
  return ties;
}

bool is_steiner(const InnerVertex& vertex) { return vertex.kind == VertexKind::steiner; }

/// The pieces that go from slice to slice, have Steiner vertices, and contours that do not meet.
std::vector<bool> find_forks(const Region& lower, const Region& upper, const Pieces& pieces,
                             const TileSet& tiles) {
  const std::uint32_t first_inner = contour_count(lower, upper);
  const Uprights uprights(lower, upper);
  std::vector<bool> forks(pieces.pieces.size());
  std::vector<bool> meets(pieces.pieces.size());
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    const std::uint32_t piece = pieces.of_tile[t];
    const bool has_any = std::ranges::any_of(tiles.tiles[t].nodes, [&](std::uint32_t node) {
      return node >= first_inner && is_steiner(tiles.inner[node - first_inner]);
    });
    if (has_any && goes_through(pieces.pieces[piece])) forks[piece] = true;
    if (uprights.has_any(tiles.tiles[t])) meets[piece] = true;
  }
  for (std::size_t i = 0; i < forks.size(); ++i) forks[i] = forks[i] && !meets[i];
  return forks;
}

/// Tiles of some pieces, as many rings of them around their inner vertices, without those that are
/// left out.
class AroundInner {
 public:
  AroundInner(std::uint32_t first_inner, const Pieces& pieces, const TileSet& tiles,
              const std::vector<bool>& some)
      : first_inner_(first_inner), pieces_(pieces), tiles_(tiles), some_(some) {}

  [[nodiscard]] std::vector<bool> tiles(int most_rings, const std::vector<bool>& left_out) const {
    std::vector<bool> near(first_inner_ + tiles_.inner.size());  // nodes
    std::fill(near.begin() + first_inner_, near.end(), true);
    std::vector<bool> found(tiles_.tiles.size());
    for (int ring = 0; ring < most_rings; ++ring) {
      std::vector<bool> next = near;
      for (std::size_t t = 0; t < found.size(); ++t) {
        if (!some_[pieces_.of_tile[t]] || left_out[t]) continue;
        const auto& nodes = tiles_.tiles[t].nodes;
        if (std::ranges::none_of(nodes, [&](std::uint32_t node) { return near[node]; })) continue;
        found[t] = true;
        for (const std::uint32_t node : nodes) next[node] = true;
      }
      near = std::move(next);
    }
    return found;
  }

 private:
  std::uint32_t first_inner_;
  const Pieces& pieces_;
  const TileSet& tiles_;
  const std::vector<bool>& some_;
};

}  // namespace

std::vector<bool> tiles_at_forks(const Region& lower, const Region& upper, const Pieces& pieces,
                                 const TileSet& tiles) {
  if (!tiles.is_linked || std::ranges::none_of(tiles.inner, is_steiner)) return {};
  std::vector<bool> forks = find_forks(lower, upper, pieces, tiles);
  const std::uint32_t first_inner = contour_count(lower, upper);
  const AroundInner around(first_inner, pieces, tiles, forks);
  std::vector<bool> ties(tiles.tiles.size());
  ties = find_ties(lower, upper, tiles, around.tiles(rings + 1, ties));
  for (std::size_t t = 0; t < ties.size(); ++t) {
    const auto is_inner = [&](std::uint32_t node) { return node >= first_inner; };
    if (ties[t] && std::ranges::any_of(tiles.tiles[t].nodes, is_inner))
      forks[pieces.of_tile[t]] = false;
  }
  std::vector<bool> found = around.tiles(rings, ties);
  if (std::ranges::find(found, true) == found.end()) return {};
  return found;
}

TileSet bend_forks(const Region& lower, const Region& upper, const Surroundings& slices,
                   const Pieces& pieces, const TileSet& tiles, const std::vector<bool>& at_forks) {
  Pieces own = only(pieces, at_forks);
  const TileSet some = tiles_of(lower, upper, tiles, at_forks, true);
  const TileSet plain = OrderedForks(lower, upper, some).ordered(own.of_tile);
  TileSet made = tiles_of(lower, upper, tiles, at_forks, false);
  const auto bent = bend_apart({lower, upper, slices, own}, outline_points(lower, upper), plain,
                               fork_fineness(upper.z - lower.z), made);
  append(made, bent ? *bent : plain, contour_count(lower, upper));
  made.reaches = tiles.reaches;
  made.is_plain = tiles.is_plain;
  made.is_linked = tiles.is_linked;
  return made;
}

}  // namespace loft
