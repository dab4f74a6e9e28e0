// SPDX-License-Identifier: MIT
#include "reconstruct/link/links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/box_tree.h"
#include "reconstruct/link/extract.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/link/untangle.h"

namespace loft {

namespace {

using cdt::Point;

/// Pieces whose parts overlap at least that much stay as they are, and a slide must leave no more
/// of the difference than that. Found on 17 stacks cut from known shapes: with these, slides took
/// up to 8% off the mean distance to the shape on six and made none worse. With 0.7 for the former,
/// or 0.9 for the latter, some lost.
constexpr double enough_overlap = 0.6;
constexpr double most_left = 0.7;
/// Offsets below that share of a radius are not looked into.
constexpr double least_slide = 0.125;
/// Parts that were moved over each other must overlap that much.
constexpr double least_overlap = 0.4;

/// Slides that would take more tests of pairs of tiles than that are not made: a typical one takes
/// a few dozen for each point.
constexpr std::size_t most_pairs_of_point = 1000;
constexpr std::size_t least_pairs = 1'000'000;

/// In sums of two radii: the farthest shift with and without a prediction, and how far off a
/// prediction may be, besides its share of the shift.
constexpr double farthest_predicted = 4;
constexpr double farthest_near = 2;
/// Boxes for these are larger by that share of all that is in them: they must not miss a pair.
constexpr double rounding_of_reach = 0x1p-40;
constexpr double most_error = 0.5;
constexpr double most_error_of_shift = 0.25;
constexpr double least_likeness = 0.5;  // of areas

double length(Point p) { return std::hypot(p.x, p.y); }
Point difference(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }

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

std::optional<Moved> move(const Region& lower, const Region& upper, Piece piece,
                          std::size_t most_pairs = any_number) {
  const Extract below(lower, piece.lower.loops, piece.is_solid);
  const Extract above(upper, piece.upper.loops, piece.is_solid);
  auto made = tile_moved(below.region(), above.region(), piece.shift, most_pairs);
  if (!made) return std::nullopt;
  Moved moved;
  moved.tiles =
      embedded(std::move(*made), below, above, static_cast<std::uint32_t>(lower.points.size()),
               static_cast<std::uint32_t>(upper.points.size()), piece.is_solid);
  const Pieces alone{{piece}, std::vector<std::uint32_t>(moved.tiles.tiles.size(), 0)};
  moved.difference = differences(lower, upper, moved.tiles, alone)[0];
  moved.piece = std::move(piece);
  return moved;
}

/// A replacement of pieces by one.
Replacement replacement(Moved moved, std::vector<std::uint32_t> replaced) {
  const std::size_t count = moved.tiles.tiles.size();
  return {std::move(moved.tiles),
          {{std::move(moved.piece)}, std::vector<std::uint32_t>(count, 0)},
          std::move(replaced)};
}

}  // namespace

Point offset(const Piece& piece) {
  const Point way = difference(piece.lower.centroid, piece.upper.centroid);
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

std::optional<Moved> move_registered(const Region& lower, const Region& upper, const Piece& piece,
                                     const IsWanted& is_wanted) {
  const Extract below(lower, piece.lower.loops, piece.is_solid);
  const Extract above(upper, piece.upper.loops, piece.is_solid);
  const std::size_t most_pairs = least_pairs + most_pairs_of_point * (below.region().points.size() +
                                                                      above.region().points.size());
  const Point away = offset(piece);
  const std::array<Point, 2> starts{Point{}, Point{-away.x, -away.y}};
  auto made = tile_registered(below.region(), above.region(), starts, most_pairs, is_wanted);
  if (!made) return {};
  Moved moved{{}, piece, made->difference};
  moved.tiles = embedded(std::move(made->tiles), below, above,
                         static_cast<std::uint32_t>(lower.points.size()),
                         static_cast<std::uint32_t>(upper.points.size()), piece.is_solid);
  moved.piece.shift = {-made->motion.shift.x, -made->motion.shift.y};
  moved.piece.registered_difference = made->difference;
  return moved;
}

void slide(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
           std::optional<double> max_shift) {
  untangle(lower, upper, tiles, pieces, max_shift);
  std::vector<std::uint32_t> movable;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.lower.parts != 1 || piece.upper.parts != 1) continue;
    if (piece.reason != LinkReason::overlap) continue;
    const double way = length(offset(piece));
    const double size = std::min(piece.lower.radius, piece.upper.radius);
    if (way > least_slide * size && way <= max_shift.value_or(way)) movable.push_back(i);
  }
  if (movable.empty()) return;
  const std::vector<double> before = differences(lower, upper, tiles, pieces);
  const std::size_t most_pairs =
      least_pairs + most_pairs_of_point * (lower.points.size() + upper.points.size());
  std::vector<Replacement> replacements;
  for (const std::uint32_t i : movable) {
    Piece piece = pieces.pieces[i];
    piece.shift = offset(piece);
    piece.reason = LinkReason::slide;
    const double most = most_left * before[i];
    if (overlap(piece, before[i]) >= enough_overlap ||
        std::abs(piece.lower.area - piece.upper.area) > most ||
        swept(upper, piece.upper, piece.shift) < before[i] - most)
      continue;
    auto moved = move(lower, upper, std::move(piece), most_pairs);
    if (!moved || moved->difference > most) continue;
    replacements.push_back(replacement(std::move(*moved), {i}));
  }
  replace(lower, upper, tiles, pieces, replacements);
}

namespace {

/// How a part moves and grows towards a slab, as far as the slab beside it tells.
struct Trend {
  Point velocity;  // of the centroid, towards the slab at hand, by height
  double radius;   // in the slice before
  double gap;      // to that slice
};

/// A piece of one slice, about to be matched.
struct End {
  std::uint32_t piece;
  const Footprint* footprint;
  bool is_solid;
  double radius;
  std::optional<Trend> trend = {};
  bool is_speck = false;  // in the slab beside it ends, too
};

/// The matching of one slab's ends.
class Matching {
 public:
  Matching(const SlabPieces& slab, std::optional<double> max_shift,
           std::span<const EndLink> forbidden)
      : slab_(slab), max_shift_(max_shift), forbidden_(forbidden) {
    for (std::uint32_t i = 0; i < slab.pieces->pieces.size(); ++i) {
      const Piece& piece = slab.pieces->pieces[i];
      if (!piece.is_end()) continue;
      const bool is_lower = piece.upper.is_empty();
      const Footprint& footprint = is_lower ? piece.lower : piece.upper;
      if (footprint.parts != 1 || !(footprint.area > 0)) continue;
      (is_lower ? lower_ : upper_).push_back({i, &footprint, piece.is_solid, footprint.radius});
    }
  }

  [[nodiscard]] bool is_possible() const { return !lower_.empty() && !upper_.empty(); }

  /// Looks up how the ends move in the slabs on the other side of their slices.
  void look_around(const SlabPieces& below, const SlabPieces& above) {
    look(below, Level::upper, lower_);
    look(above, Level::lower, upper_);
  }

  std::vector<EndLink> run() {
    find_pairs();
    std::ranges::sort(pairs_, [this](const Pair& a, const Pair& b) {
      return a.cost != b.cost ? a.cost < b.cost : places(a) < places(b);
    });
    std::vector<bool> is_lower_taken(lower_.size());
    std::vector<bool> is_upper_taken(upper_.size());
    std::vector<EndLink> links;
    for (const Pair& pair : pairs_) {
      if (is_lower_taken[pair.lower] || is_upper_taken[pair.upper]) continue;
      is_lower_taken[pair.lower] = is_upper_taken[pair.upper] = true;
      links.push_back({lower_[pair.lower].piece, upper_[pair.upper].piece, pair.reason});
    }
    return links;
  }

 private:
  struct Pair {
    double cost;
    std::size_t lower;
    std::size_t upper;
    LinkReason reason;
  };

  [[nodiscard]] std::pair<Point, Point> places(const Pair& pair) const {
    return {lower_[pair.lower].footprint->centroid, upper_[pair.upper].footprint->centroid};
  }

  /// `level` is the slice that the slab beside has in common with this one.
  void look(const SlabPieces& beside, Level level, std::vector<End>& ends) const {
    if (beside.pieces == nullptr || ends.empty()) return;
    const auto& pieces = beside.pieces->pieces;
    const auto matches = match_ends({}, beside, {}, max_shift_, {});
    std::vector<const Piece*> of_loop;  // by the first loop of the common footprint
    for (const Piece& piece : pieces) {
      if (piece.footprint(level).is_empty()) continue;
      const std::uint32_t loop = piece.footprint(level).loops.front();
      if (of_loop.size() <= loop) of_loop.resize(loop + 1, nullptr);
      of_loop[loop] = &piece;
    }
    for (End& end : ends) {
      const std::uint32_t loop = end.footprint->loops.front();
      const Piece* piece = loop < of_loop.size() ? of_loop[loop] : nullptr;
      if (piece == nullptr || piece->footprint(level).parts != 1) continue;
      const Footprint* far = &piece->footprint(other(level));
      if (far->is_empty()) {
        const auto match = std::ranges::find_if(matches, [&](const EndLink& link) {
          return &pieces[level == Level::lower ? link.lower : link.upper] == piece;
        });
        end.is_speck = match == matches.end();
        if (end.is_speck) continue;
        far = &pieces[level == Level::lower ? match->upper : match->lower].footprint(other(level));
      }
      if (far->parts != 1) continue;
      const Point way = difference(piece->footprint(level).centroid, far->centroid);
      end.trend = {{way.x / beside.gap, way.y / beside.gap}, far->radius, beside.gap};
    }
  }

  /// Whether a part shrinks as fast as one that ends in this slab.
  [[nodiscard]] bool is_closing(const End& end) const {
    return end.trend && end.footprint->loops.size() == 1 &&
           end.radius * end.radius * (end.trend->gap + slab_.gap) <=
               end.trend->radius * end.trend->radius * slab_.gap;
  }

  void find_pairs() {
    std::erase_if(lower_, [this](const End& end) { return is_closing(end); });
    std::erase_if(upper_, [this](const End& end) { return is_closing(end); });
    std::ranges::sort(upper_, {}, [](const End& end) { return end.footprint->centroid.x; });
    std::vector<Box3> boxes;
    for (const End& end : upper_) boxes.push_back(reach(end));
    const BoxTree tree(boxes);
    for (std::size_t i = 0; i < lower_.size(); ++i)
      tree.for_each_meeting(reach(lower_[i]), [&](std::uint32_t j) { consider(i, j); });
  }

  /// Two ends that may be a pair meet in these.
  [[nodiscard]] Box3 reach(const End& end) const {
    const auto [x, y] = end.footprint->centroid;
    const double way = std::max(std::max(farthest_predicted, farthest_near) * end.radius,
                                max_shift_.value_or(0) / 2);
    const double more = way + rounding_of_reach * (way + std::abs(x) + std::abs(y));
    return {{x - more, y - more, 0}, {x + more, y + more, 0}};
  }

  void consider(std::size_t i, std::size_t j) {
    const End& a = lower_[i];
    const End& b = upper_[j];
    if (a.is_solid != b.is_solid || is_forbidden(a, b)) return;
    const double likeness = std::min(a.footprint->area, b.footprint->area) /
                            std::max(a.footprint->area, b.footprint->area);
    if (likeness < least_likeness) return;
    const double sizes = a.radius + b.radius;
    const Point way = difference(b.footprint->centroid, a.footprint->centroid);
    const double shift = length(way);
    if (max_shift_ && shift > *max_shift_) return;
    const double unlikeness = 1 - likeness;
    if (!a.trend && !b.trend) {
      if (!a.is_speck && !b.is_speck && shift <= max_shift_.value_or(farthest_near * sizes))
        pairs_.push_back({shift / sizes + unlikeness, i, j, LinkReason::nearest});
      return;
    }
    const double off = std::max(error(a, way), error(b, {-way.x, -way.y}));
    if (shift <= max_shift_.value_or(farthest_predicted * sizes) &&
        off <= most_error * sizes + most_error_of_shift * shift)
      pairs_.push_back({off / sizes + unlikeness, i, j, LinkReason::predicted});
  }

  /// How far from its way so far a part would go; 0 if that is not known.
  [[nodiscard]] double error(const End& end, Point way) const {
    if (!end.trend) return 0;
    const Point expected{end.trend->velocity.x * slab_.gap, end.trend->velocity.y * slab_.gap};
    return length(difference(way, expected));
  }

  [[nodiscard]] bool is_forbidden(const End& a, const End& b) const {
    return std::ranges::any_of(forbidden_, [&](const EndLink& link) {
      return link.lower == a.piece && link.upper == b.piece;
    });
  }

  const SlabPieces& slab_;
  std::optional<double> max_shift_;
  std::span<const EndLink> forbidden_;
  std::vector<End> lower_;
  std::vector<End> upper_;
  std::vector<Pair> pairs_;
};

}  // namespace

std::vector<EndLink> match_ends(const SlabPieces& below, const SlabPieces& slab,
                                const SlabPieces& above, std::optional<double> max_shift,
                                std::span<const EndLink> forbidden) {
  if (slab.pieces->pieces.size() < 2) return {};
  Matching matching(slab, max_shift, forbidden);
  if (!matching.is_possible()) return {};
  matching.look_around(below, above);
  return matching.run();
}

namespace {

/// The outer loops of a footprint, or the holes in it.
Footprint loops(const Region& region, const Footprint& whole, bool is_solid, bool is_outer) {
  Footprint chosen;
  for (const std::uint32_t loop : whole.loops) {
    Footprint one;
    one.loops = {loop};
    if ((measure(region, one) == is_solid) == is_outer) chosen.loops.push_back(loop);
  }
  if (!chosen.is_empty()) measure(region, chosen);
  return chosen;
}

/// A hollow part beside a solid or a narrower one, as where a shell closes: its outlines are joined
/// and its holes by themselves, or they end. None if these tiles meet.
std::optional<Replacement> move_shell(const Region& lower, const Region& upper,
                                      const Piece& whole) {
  Piece outside = whole;
  outside.lower = loops(lower, whole.lower, whole.is_solid, true);
  outside.upper = loops(upper, whole.upper, whole.is_solid, true);
  Piece inside = whole;
  inside.is_solid = !whole.is_solid;
  inside.lower = loops(lower, whole.lower, whole.is_solid, false);
  inside.upper = loops(upper, whole.upper, whole.is_solid, false);
  if (inside.lower.is_empty() && inside.upper.is_empty()) return std::nullopt;
  outside.shift = inside.shift = offset(outside);
  auto outer = move(lower, upper, std::move(outside));
  auto inner = move(lower, upper, std::move(inside));
  if (!outer || !inner || overlap(outer->piece, outer->difference) < least_overlap)
    return std::nullopt;
  // As if the outer ones were there before: one more test of the same kind.
  Replacement shell = replacement(std::move(*outer), {});
  std::vector<Replacement> more;
  more.push_back(replacement(std::move(*inner), {}));
  if (!replace(lower, upper, shell.tiles, shell.pieces, more)) return std::nullopt;
  return shell;
}

}  // namespace

void link_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLink> links) {
  std::vector<Replacement> replacements;
  for (const EndLink& link : links) {
    Piece piece;
    piece.is_solid = pieces.pieces[link.lower].is_solid;
    piece.lower = pieces.pieces[link.lower].lower;
    piece.upper = pieces.pieces[link.upper].upper;
    piece.reason = link.reason;
    piece.shift = offset(piece);
    auto moved = move(lower, upper, piece);
    const std::vector<std::uint32_t> both{link.lower, link.upper};
    const auto is_wanted = [&](const Registered& made) {
      return overlap(piece, made.difference) >= least_overlap;
    };
    if (moved && overlap(piece, moved->difference) >= least_overlap) {
      replacements.push_back(replacement(std::move(*moved), both));
    } else if (auto shell = move_shell(lower, upper, piece)) {
      shell->replaced = both;
      replacements.push_back(std::move(*shell));
    } else if (auto fitted = move_registered(lower, upper, piece, is_wanted)) {
      replacements.push_back(replacement(std::move(*fitted), both));
    } else if (moved && link.reason == LinkReason::order) {
      replacements.push_back(replacement(std::move(*moved), both));
    }
  }
  replace(lower, upper, tiles, pieces, replacements);
}

}  // namespace loft
