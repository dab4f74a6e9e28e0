// SPDX-License-Identifier: MIT
#include "reconstruct/link/slide.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "mesh/vec3.h"
#include "reconstruct/link/bounds.h"
#include "reconstruct/link/moves.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/link/separate.h"

namespace loft {

namespace {

using cdt::Point;

/// Pieces whose parts overlap at least that much stay as they are, and a slide must leave no more
/// of the difference than that. Found on 17 stacks cut from known shapes: with these, slides took
/// up to 8% off the mean distance to the shape on six and made none worse. With 0.7 for the former,
/// or 0.9 for the latter, some lost.
constexpr double enough_overlap = 0.6;
constexpr double most_left = 0.7;
/// Torn pieces that overlap less than that are moved as their outlines match. Where they overlap
/// more, a window is likely to be there. Of 349 phantoms whose shift is at most 1.5 thicknesses,
/// with 0.15 one in three of the membranes and one in four of the nested walls stayed torn, with
/// this one and none; with more the same. No stack cut from a known shape changed.
constexpr double torn_overlap = 0.4;
/// Offsets below that share of a radius are not looked into.
constexpr double least_slide = 0.125;
/// Pieces are drawn together if that leaves no more of their difference than that less their
/// overlap: where much overlaps already, more has to speak for it. On 26 stacks cut from known
/// shapes, with this, and whatever the weights of the matching, the volume was nearer on all that
/// changed, the mean distance to the shape on all but three, on which it grew by at most 3%.
constexpr double most_left_and_overlap = 0.8;
/// They are where the volume is off that of a frustum by such a share, and if this becomes less by
/// that share.
constexpr double least_error = 0.05;
constexpr double most_error_left = 0.7;
/// Whatever the volume, they are drawn together if no more than that is left, where they overlap by
/// less than torn_overlap, and do not grow: as a blade that turns.
constexpr double most_unexplained = 0.1;

/// The area that a footprint's outline sweeps when it is moved: the most by which that can change
/// the area it has in common with another one, twice.
double swept(const Region& region, const Footprint& footprint, Point way) {
  double sum = 0;
  for (const std::uint32_t i : footprint.loops) {
    const auto loop = region.loop(i);
    Point p = region.points[loop.back()];
    for (const std::uint32_t v : loop) {
      const Point q = region.points[v];
      sum += std::abs((q.x - p.x) * way.y - (q.y - p.y) * way.x);
      p = q;
    }
  }
  return sum;
}

/// Whether a piece has one outline in both slices, and as many holes.
bool is_alike(const Piece& piece) {
  return piece.lower.parts == 1 && piece.upper.parts == 1 &&
         piece.lower.loops.size() == piece.upper.loops.size();
}

std::vector<std::uint32_t> all_of(const TileSet& tiles) {
  std::vector<std::uint32_t> all(tiles.tiles.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

/// The Euler characteristic of a piece, twice, by its tiles. A band from a loop to a loop has 0;
/// one with a window in it, or with a handle, has less.
long twice_euler(const Region& lower, const Region& upper, const Piece& piece, const TileSet& tiles,
                 std::span<const std::uint32_t> of_piece) {
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t t : of_piece)
    nodes.insert(nodes.end(), tiles.tiles[t].nodes.begin(), tiles.tiles[t].nodes.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::size_t rims = 0;
  for (const std::uint32_t loop : piece.lower.loops) rims += lower.loop(loop).size();
  for (const std::uint32_t loop : piece.upper.loops) rims += upper.loop(loop).size();
  return 2 * static_cast<long>(nodes.size()) - static_cast<long>(of_piece.size() + rims);
}

/// The tiles of each of some pieces, and of no others.
std::vector<std::vector<std::uint32_t>> tiles_of(std::span<const std::uint32_t> some,
                                                 const Pieces& pieces) {
  std::vector<bool> is_one(pieces.pieces.size());
  for (const std::uint32_t i : some) is_one[i] = true;
  std::vector<std::vector<std::uint32_t>> found(pieces.pieces.size());
  for (std::uint32_t t = 0; t < pieces.of_tile.size(); ++t)
    if (is_one[pieces.of_tile[t]]) found[pieces.of_tile[t]].push_back(t);
  return found;
}

/// Whether no edge of a piece has more than two tiles: it does where the slices touch, and seems to
/// have handles there until it is taken apart.
bool is_plain_surface(const TileSet& tiles, std::span<const std::uint32_t> of_piece) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const std::uint32_t t : of_piece) {
    const auto& nodes = tiles.tiles[t].nodes;
    for (unsigned i = 0; i < 3; ++i) edges.emplace_back(nodes[i], nodes[(i + 1) % 3]);
  }
  std::ranges::sort(edges);
  return std::ranges::adjacent_find(edges) == edges.end();
}

/// Whether a registration leaves no more than that of a difference, without going too far for it.
bool brings_together(const Registered& made, double most_difference,
                     std::optional<double> max_shift) {
  const double way = std::hypot(made.motion.shift.x, made.motion.shift.y);
  return is_within(made.difference, most_difference) && is_within(way, max_shift.value_or(way));
}

/// Moves pieces as their outlines match, where overlay alone has torn them: each outline goes on as
/// one, but the tiles have windows or handles, and the slices overlap little. Knows the differences
/// of all pieces, and says whether it has moved any; so do the moves after it.
bool untangle(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
              std::span<const double> before, std::optional<double> max_shift) {
  const auto is_steiner = [](const InnerVertex& v) { return v.kind == VertexKind::steiner; };
  if (std::ranges::none_of(tiles.inner, is_steiner)) return false;
  std::vector<std::uint32_t> apart;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.reason == LinkReason::overlap && is_alike(piece) &&
        !is_within(torn_overlap, overlap(piece, before[i])))
      apart.push_back(i);
  }
  if (apart.empty()) return false;
  const auto tiles_of_apart = tiles_of(apart, pieces);
  std::vector<Replacement> replacements;
  for (const std::uint32_t i : apart) {
    const Piece& piece = pieces.pieces[i];
    if (twice_euler(lower, upper, piece, tiles, tiles_of_apart[i]) >= 0 ||
        !is_plain_surface(tiles, tiles_of_apart[i]))
      continue;
    if (is_within(torn_overlap, overlap(piece, overlay_difference(lower, upper, piece)))) continue;
    const auto is_wanted = [&](const Registered& made) {
      return brings_together(made, most_left * before[i], max_shift) &&
             twice_euler(lower, upper, piece, made.tiles, all_of(made.tiles)) == 0;
    };
    auto moved = move_by_loops(lower, upper, piece, is_wanted);
    if (!moved) continue;
    moved->piece.reason = LinkReason::registered;
    replacements.push_back(replacement(std::move(*moved), {i}));
  }
  return replace(lower, upper, tiles, pieces, replacements);
}

/// Moves parts as a whole, where that alone brings them over each other.
bool slide_over(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
                std::span<const double> before, std::optional<double> max_shift) {
  std::vector<std::uint32_t> movable;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.lower.parts != 1 || piece.upper.parts != 1) continue;
    if (piece.reason != LinkReason::overlap) continue;
    const Point way_of_piece = offset(piece);
    const double way = std::hypot(way_of_piece.x, way_of_piece.y);
    const double size = std::min(piece.lower.radius, piece.upper.radius);
    if (!is_within(way, least_slide * size) && is_within(way, max_shift.value_or(way)))
      movable.push_back(i);
  }
  const std::size_t most_pairs = most_pairs_of(lower.points.size() + upper.points.size());
  std::vector<Replacement> replacements;
  for (const std::uint32_t i : movable) {
    Piece piece = pieces.pieces[i];
    piece.shift = offset(piece);
    piece.reason = LinkReason::slide;
    const double most = most_left * before[i];
    if (is_within(enough_overlap, overlap(piece, before[i])) ||
        !is_within(std::abs(piece.lower.area - piece.upper.area), most) ||
        !is_within(before[i] - most, swept(upper, piece.upper, piece.shift)))
      continue;
    auto moved = move_by_shift(lower, upper, std::move(piece), most_pairs);
    if (!moved || !is_within(moved->difference, most)) continue;
    replacements.push_back(replacement(std::move(*moved), {i}));
  }
  return replace(lower, upper, tiles, pieces, replacements);
}

/// The volume between a piece's contours that these tiles of it enclose.
double volume(const Region& lower, const Region& upper, const Piece& piece, const TileSet& tiles,
              std::span<const std::uint32_t> of_piece) {
  double below = 0;  // the tiles, as what looks up or down at a height above the lower slice
  for (const std::uint32_t t : of_piece) {
    const auto place = [&](unsigned i) {
      return place_of(lower, upper, tiles.inner, tiles.tiles[t].nodes[i]);
    };
    const Vec3 a = place(0);
    const Vec3 b = place(1);
    const Vec3 c = place(2);
    below += cross(minus(b, a), minus(c, a))[2] / 2 * ((a[2] + b[2] + c[2]) / 3 - lower.z);
  }
  return (upper.z - lower.z) * piece.upper.area + (piece.is_solid ? below : -below);
}

/// The volume of a frustum with a piece's ends.
double frustum(const Region& lower, const Region& upper, const Piece& piece) {
  const double a = piece.lower.area;
  const double b = piece.upper.area;
  return (upper.z - lower.z) * (a + b + std::sqrt(a * b)) / 3;
}

/// Pieces that overlap little, and have been moved by nothing else.
std::vector<std::uint32_t> loose_pieces(const Pieces& pieces, std::span<const double> before) {
  std::vector<std::uint32_t> loose;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.is_end() || piece.is_tip() || piece.reason != LinkReason::overlap) continue;
    if (!is_within(most_left_and_overlap, overlap(piece, before[i]))) loose.push_back(i);
  }
  return loose;
}

/// Whether a piece has windows or handles: more than its outlines and holes, joined by one surface,
/// account for.
bool is_torn(const Piece& piece, long twice_euler) {
  const std::size_t loops = piece.lower.loops.size() + piece.upper.loops.size();
  return twice_euler < 4 - 2 * static_cast<long>(loops);
}

/// Moves each outline of a piece its own way over the others, as at forks.
bool draw_together(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
                   std::span<const double> before, std::optional<double> max_shift) {
  const std::vector<std::uint32_t> loose = loose_pieces(pieces, before);
  if (loose.empty()) return false;
  const auto tiles_of_loose = tiles_of(loose, pieces);
  std::vector<Replacement> replacements;
  for (const std::uint32_t i : loose) {
    const Piece& piece = pieces.pieces[i];
    const long euler = twice_euler(lower, upper, piece, tiles, tiles_of_loose[i]);
    const double whole = frustum(lower, upper, piece);
    const double error = std::abs(volume(lower, upper, piece, tiles, tiles_of_loose[i]) - whole);
    const bool is_far =
        !is_within(torn_overlap, overlap(piece, before[i])) &&
        is_within(std::abs(piece.lower.area - piece.upper.area), most_unexplained * before[i]);
    const bool is_off = is_within(least_error * whole, error);
    if (!(is_off || is_far) || is_torn(piece, euler) || !is_plain_surface(tiles, tiles_of_loose[i]))
      continue;
    const double left = std::min(most_left, most_left_and_overlap - overlap(piece, before[i]));
    const auto is_wanted = [&](const Registered& made) {
      return brings_together(made, left * before[i], max_shift) &&
             twice_euler(lower, upper, piece, made.tiles, all_of(made.tiles)) >= euler;
    };
    auto moved = move_by_places(lower, upper, piece, is_wanted);
    if (!moved) continue;
    const double now = volume(lower, upper, piece, moved->tiles, all_of(moved->tiles));
    const bool is_explained = is_far && is_within(moved->difference, most_unexplained * before[i]);
    const bool is_nearer = is_off && is_within(std::abs(now - whole), most_error_left * error);
    if (!is_explained && !is_nearer) continue;
    moved->piece.reason = LinkReason::registered;
    moved->piece.bends = !is_explained;
    replacements.push_back(replacement(std::move(*moved), {i}));
  }
  return replace(lower, upper, tiles, pieces, replacements);
}

}  // namespace

void slide(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
           std::optional<double> max_shift) {
  std::vector<double> before = differences(lower, upper, tiles, pieces);
  for (const auto move : {separate, untangle, slide_over, draw_together})
    if (move(lower, upper, tiles, pieces, before, max_shift))
      before = differences(lower, upper, tiles, pieces);
}

}  // namespace loft
