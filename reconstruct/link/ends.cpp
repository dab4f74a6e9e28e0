// SPDX-License-Identifier: MIT
#include "reconstruct/link/ends.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/box_tree.h"
#include "reconstruct/link/bounds.h"
#include "reconstruct/link/moves.h"
#include "reconstruct/link/replace.h"

namespace loft {

namespace {

using cdt::Point;

/// Parts that were moved over each other must overlap that much.
constexpr double least_overlap = 0.4;

/// In sums of two radii: the farthest shift with and without a prediction, and how far off a
/// prediction may be, besides its share of the shift.
constexpr double farthest_predicted = 4;
constexpr double farthest_near = 2;
constexpr double most_error = 0.5;
constexpr double most_error_of_shift = 0.25;
constexpr double least_likeness = 0.5;  // of areas
/// Boxes for these are larger by that share of all that is in them: they must not miss a pair.
constexpr double rounding_of_reach = 0x1p-28;

double length(Point p) { return std::hypot(p.x, p.y); }
Point difference(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }

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

  /// A little larger, by rounding.
  [[nodiscard]] static Box3 box_around(Point p, double radius) {
    const double more = radius + rounding_of_reach * (radius + std::abs(p.x) + std::abs(p.y));
    return {{p.x - more, p.y - more, 0}, {p.x + more, p.y + more, 0}};
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
           is_within(end.radius * end.radius * (end.trend->gap + slab_.gap),
                     end.trend->radius * end.trend->radius * slab_.gap);
  }

  void find_pairs() {
    std::erase_if(lower_, [this](const End& end) { return is_closing(end); });
    std::erase_if(upper_, [this](const End& end) { return is_closing(end); });
    std::vector<Box3> boxes;
    for (const End& end : upper_) boxes.push_back(reach(end));
    const BoxTree tree(boxes);
    for (std::size_t i = 0; i < lower_.size(); ++i)
      tree.for_each_meeting(reach(lower_[i]), [&](std::uint32_t j) { consider(i, j); });
  }

  /// Two ends that may be a pair meet in these.
  [[nodiscard]] Box3 reach(const End& end) const {
    return box_around(end.footprint->centroid,
                      std::max(std::max(farthest_predicted, farthest_near) * end.radius,
                               max_shift_.value_or(0) / 2));
  }

  void consider(std::size_t i, std::size_t j) {
    const End& a = lower_[i];
    const End& b = upper_[j];
    if (a.is_solid != b.is_solid || is_forbidden(a.piece, b.piece)) return;
    const double likeness = std::min(a.footprint->area, b.footprint->area) /
                            std::max(a.footprint->area, b.footprint->area);
    if (!is_within(least_likeness, likeness)) return;
    const double sizes = a.radius + b.radius;
    const Point way = difference(b.footprint->centroid, a.footprint->centroid);
    const double shift = length(way);
    if (max_shift_ && !is_within(shift, *max_shift_)) return;
    const double unlikeness = 1 - likeness;
    if (!a.trend && !b.trend) {
      if (!a.is_speck && !b.is_speck &&
          is_within(shift, max_shift_.value_or(farthest_near * sizes)))
        pairs_.push_back({shift / sizes + unlikeness, i, j, LinkReason::nearest});
      return;
    }
    const double off = std::max(error(a, way), error(b, {-way.x, -way.y}));
    if (is_within(shift, max_shift_.value_or(farthest_predicted * sizes)) &&
        is_within(off, most_error * sizes + most_error_of_shift * shift))
      pairs_.push_back({off / sizes + unlikeness, i, j, LinkReason::predicted});
  }

  /// How far from its way so far a part would go; 0 if that is not known.
  [[nodiscard]] double error(const End& end, Point way) const {
    if (!end.trend) return 0;
    const Point expected{end.trend->velocity.x * slab_.gap, end.trend->velocity.y * slab_.gap};
    return length(difference(way, expected));
  }

  [[nodiscard]] bool is_forbidden(std::uint32_t lower, std::uint32_t upper) const {
    return std::ranges::any_of(forbidden_, [&](const EndLink& link) {
      return link.lower == lower && link.upper == upper;
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
  auto outer = move_by_shift(lower, upper, std::move(outside));
  auto inner = move_by_shift(lower, upper, std::move(inside));
  if (!outer || !inner || overlap(outer->piece, outer->difference) < least_overlap)
    return std::nullopt;
  // As if the outer ones were there before: one more test of the same kind.
  Replacement shell = replacement(std::move(*outer), {});
  std::vector<Replacement> more;
  more.push_back(replacement(std::move(*inner), {}));
  if (!replace(lower, upper, shell.tiles, shell.pieces, more)) return std::nullopt;
  return shell;
}

/// Two ends as one piece.
std::optional<Replacement> link_two(const Region& lower, const Region& upper, const Pieces& pieces,
                                    const EndLink& link) {
  Piece piece;
  piece.is_solid = pieces.pieces[link.lower].is_solid;
  piece.lower = pieces.pieces[link.lower].lower;
  piece.upper = pieces.pieces[link.upper].upper;
  piece.reason = link.reason;
  piece.shift = offset(piece);
  auto moved = move_by_shift(lower, upper, piece);
  const std::vector<std::uint32_t> both{link.lower, link.upper};
  const auto is_wanted = [&](const Registered& made) {
    return overlap(piece, made.difference) >= least_overlap;
  };
  if (moved && overlap(piece, moved->difference) >= least_overlap)
    return replacement(std::move(*moved), both);
  if (auto shell = move_shell(lower, upper, piece)) {
    shell->replaced = both;
    return shell;
  }
  if (auto fitted = move_by_loops(lower, upper, piece, is_wanted))
    return replacement(std::move(*fitted), both);
  if (moved && link.reason == LinkReason::order) return replacement(std::move(*moved), both);
  return {};
}

}  // namespace

void link_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLink> links) {
  std::vector<Replacement> replacements;
  for (const EndLink& link : links)
    if (auto linked = link_two(lower, upper, pieces, link))
      replacements.push_back(std::move(*linked));
  replace(lower, upper, tiles, pieces, replacements);
}

}  // namespace loft
