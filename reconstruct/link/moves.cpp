// SPDX-License-Identifier: MIT
#include "reconstruct/link/moves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "reconstruct/link/extract.h"

namespace loft {

namespace {

using cdt::Point;

/// The parts of a piece, and its tiles where these come from.
class Alone {
 public:
  Alone(const Region& lower, const Region& upper, const Piece& piece)
      : lower_(lower),
        upper_(upper),
        piece_(piece),
        below_(lower, piece.lower.loops, piece.is_solid),
        above_(upper, piece.upper.loops, piece.is_solid) {}

  [[nodiscard]] const Region& lower() const { return below_.region(); }
  [[nodiscard]] const Region& upper() const { return above_.region(); }
  [[nodiscard]] std::size_t most_pairs() const {
    return most_pairs_of(lower().points.size() + upper().points.size());
  }

  [[nodiscard]] TileSet embedded(TileSet tiles) const {
    return loft::embedded(std::move(tiles), below_, above_,
                          static_cast<std::uint32_t>(lower_.points.size()),
                          static_cast<std::uint32_t>(upper_.points.size()), piece_.is_solid);
  }

  [[nodiscard]] std::optional<Moved> moved(std::optional<Registered> made) const {
    if (!made) return {};
    Moved moved{embedded(std::move(made->tiles)), piece_, made->difference};
    moved.piece.shift = {-made->motion.shift.x, -made->motion.shift.y};
    moved.piece.turn = made->motion.turn;
    moved.piece.registered_difference = made->difference;
    moved.piece.bends = false;
    return moved;
  }

 private:
  const Region& lower_;
  const Region& upper_;
  const Piece& piece_;
  Extract below_;
  Extract above_;
};

}  // namespace

Point offset(const Piece& piece) {
  const Point way{piece.lower.centroid.x - piece.upper.centroid.x,
                  piece.lower.centroid.y - piece.upper.centroid.y};
  const double longest = std::max(
      {std::abs(way.x), std::abs(way.y), std::min(piece.lower.radius, piece.upper.radius)});
  if (!(longest > 0)) return {};
  const double unit = std::ldexp(1.0, std::ilogb(longest) - 40);
  return {std::round(way.x / unit) * unit, std::round(way.y / unit) * unit};
}

/// With areas A and B: both cover (A + B - difference) / 2, together (A + B + difference) / 2.
double overlap(const Piece& piece, double difference) {
  const double sum = piece.lower.area + piece.upper.area;
  return sum > 0 ? std::max(0.0, (sum - difference) / (sum + difference)) : 0;
}

double overlay_difference(const Region& lower, const Region& upper, const Piece& piece) {
  const Extract below(lower, piece.lower.loops, piece.is_solid);
  const Extract above(upper, piece.upper.loops, piece.is_solid);
  const auto tiles = tile_with_crossings(below.region(), above.region(), any_number);
  if (!tiles) return std::numeric_limits<double>::infinity();
  const Pieces alone{{Piece{}}, std::vector<std::uint32_t>(tiles->tiles.size(), 0)};
  return differences(below.region(), above.region(), *tiles, alone)[0];
}

std::optional<Moved> move_by_shift(const Region& lower, const Region& upper, Piece piece,
                                   std::size_t most_pairs) {
  const Alone alone(lower, upper, piece);
  auto made = tile_moved(alone.lower(), alone.upper(), piece.shift, most_pairs);
  if (!made) return std::nullopt;
  Moved moved;
  moved.tiles = alone.embedded(std::move(*made));
  const Pieces one{{piece}, std::vector<std::uint32_t>(moved.tiles.tiles.size(), 0)};
  moved.difference = differences(lower, upper, moved.tiles, one)[0];
  moved.piece = std::move(piece);
  return moved;
}

std::optional<Moved> move_by_loops(const Region& lower, const Region& upper, const Piece& piece,
                                   const IsWanted& is_wanted) {
  const Alone alone(lower, upper, piece);
  const Point away = offset(piece);
  const std::array<Point, 2> starts{Point{}, Point{-away.x, -away.y}};
  return alone.moved(
      tile_registered(alone.lower(), alone.upper(), starts, alone.most_pairs(), is_wanted));
}

std::optional<Moved> move_by_places(const Region& lower, const Region& upper, const Piece& piece,
                                    const IsWanted& is_wanted, const LoopWays& ways) {
  const Alone alone(lower, upper, piece);
  return alone.moved(
      tile_registered_by_places(alone.lower(), alone.upper(), alone.most_pairs(), is_wanted, ways));
}

std::optional<Moved> move_by_ways(const Region& lower, const Region& upper, const Piece& piece,
                                  const IsWanted& is_wanted, const LoopWays& ways) {
  const Alone alone(lower, upper, piece);
  return alone.moved(
      tile_registered_by_ways(alone.lower(), alone.upper(), alone.most_pairs(), is_wanted, ways));
}

Replacement replacement(Moved moved, std::vector<std::uint32_t> replaced) {
  const std::size_t count = moved.tiles.tiles.size();
  return {std::move(moved.tiles),
          {{std::move(moved.piece)}, std::vector<std::uint32_t>(count, 0)},
          std::move(replaced)};
}

}  // namespace loft
