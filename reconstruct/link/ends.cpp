// SPDX-License-Identifier: MIT
#include "reconstruct/link/ends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mesh/box_tree.h"
#include "reconstruct/link/beside.h"
#include "reconstruct/link/bounds.h"

namespace loft {

namespace {

using cdt::Point;

/// In sums of two radii: the farthest shift with and without a prediction, and how far off a
/// prediction may be, besides its share of the shift.
constexpr double farthest_predicted = 4;
constexpr double farthest_near = 2;
constexpr double most_error = 0.5;
constexpr double most_error_of_shift = 0.25;
constexpr double least_likeness = 0.5;  // of areas

/// In radii of an end: how far beside what it is joined to, taken as a circle, its way may lead.
constexpr double most_beside = 0.25;
constexpr double least_of_joined = 0.5;  // of the end's area, that of what it is joined to
/// Boxes for these are larger by that share of all that is in them: they must not miss a pair.
constexpr double rounding_of_reach = 0x1p-28;

/// Tips that would go sideways by less than that, in radii of their ends, stay: that is the noise
/// of contours.
constexpr double least_lean = 0.05;

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
  bool is_speck = false;                       // in the slab beside it ends, too
  std::span<const std::uint32_t> joined = {};  // loops of its slice that it is one with there
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

  [[nodiscard]] bool is_possible() const { return !lower_.empty() || !upper_.empty(); }

  /// Looks up how the ends move in the slabs on the other side of their slices.
  void look_around(const SlabPieces& below, const SlabPieces& above) {
    has_neighbour_ = below.pieces != nullptr || above.pieces != nullptr;
    look(below, Level::upper, lower_);
    look(above, Level::lower, upper_);
  }

  EndPlan run() {
    const auto leans = find_leans();  // of those that close, too
    EndPlan plan{find_links(), {}};
    std::vector<bool> is_taken = are_linked(plan.links);
    join(lower_, is_taken, Level::lower, plan.links);
    join(upper_, is_taken, Level::upper, plan.links);
    if (has_neighbour_) {
      const auto beside = find_beside(are_linked(plan.links));
      plan.links.insert(plan.links.end(), beside.begin(), beside.end());
    }
    is_taken = are_linked(plan.links);
    for (const auto& [piece, lean] : leans)
      if (!is_taken[piece]) plan.leans.push_back(lean);
    return plan;
  }

  /// Of ends with ends.
  std::vector<EndLink> find_links() {
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
  /// Which of the pieces links name.
  [[nodiscard]] std::vector<bool> are_linked(std::span<const EndLink> links) const {
    std::vector<bool> is_linked(slab_.pieces->pieces.size());
    for (const EndLink& link : links) is_linked[link.lower] = is_linked[link.upper] = true;
    return is_linked;
  }

  /// Of all ends, with their pieces.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, EndLean>> find_leans() const {
    std::vector<std::pair<std::uint32_t, EndLean>> leans;
    for (const Level level : {Level::lower, Level::upper})
      for (const End& end : level == Level::lower ? lower_ : upper_)
        if (const auto velocity = this->lean(end))
          leans.emplace_back(end.piece, EndLean{level, end.footprint->loops.front(), *velocity});
    return leans;
  }

  /// The velocity of an end's axis, as far as there is evidence of one.
  [[nodiscard]] std::optional<Point> lean(const End& end) const {
    if (!end.trend) return {};
    const double speed = length(end.trend->velocity);
    const double way = speed * end.trend->gap;
    const double moved = way - std::abs(end.radius - end.trend->radius);
    const double height = std::min(end.radius, slab_.gap);
    const double seen = std::max(end.trend->gap, height);
    if (is_within(moved * height, least_lean * end.radius * seen)) return {};
    const double share = moved / (speed * seen);
    return Point{share * end.trend->velocity.x, share * end.trend->velocity.y};
  }

  struct Pair {
    double cost;
    std::size_t lower;
    std::size_t upper;
    LinkReason reason;
  };

  /// The parts of one slice that ends of the other may be joined to.
  struct Targets {
    std::vector<std::uint32_t> pieces;
    BoxTree boxes;
  };

  [[nodiscard]] Targets targets(Level level) const {
    std::vector<bool> goes_on(slab_.pieces->pieces.size());  // of ends; find_pairs() dropped others
    for (const End& end : lower_) goes_on[end.piece] = true;
    for (const End& end : upper_) goes_on[end.piece] = true;
    std::vector<std::uint32_t> found;
    std::vector<Box3> boxes;
    for (std::uint32_t i = 0; i < slab_.pieces->pieces.size(); ++i) {
      const Piece& piece = slab_.pieces->pieces[i];
      const Footprint& part = piece.footprint(level);
      if (part.parts != 1 || piece.is_tip() || (piece.is_end() && !goes_on[i])) continue;
      found.push_back(i);
      boxes.push_back(box_around(part.centroid, part.radius));
    }
    return {std::move(found), BoxTree(boxes)};
  }

  /// Joins ends of one slice that go on in the slab beside, each to the part of the other slice
  /// that its way leads into, as at a fork: whatever else is linked with that.
  void join(std::span<const End> ends, const std::vector<bool>& is_taken, Level level,
            std::vector<EndLink>& links) const {
    std::optional<Targets> targets;
    for (const End& end : ends) {
      if (is_taken[end.piece] || !end.trend || is_named_in_forbidden(end.piece)) continue;
      if (!targets) targets = this->targets(other(level));
      if (const auto link = join(end, level, *targets)) links.push_back(*link);
    }
  }

  /// Joins ends to what they lie beside.
  [[nodiscard]] std::vector<EndLink> find_beside(const std::vector<bool>& is_taken) const {
    std::optional<BesideFinder> finder;
    std::vector<EndLink> links;
    for (const Level level : {Level::lower, Level::upper}) {
      for (const End& end : level == Level::lower ? lower_ : upper_) {
        if (is_taken[end.piece] || is_named_in_forbidden(end.piece)) continue;
        if (!finder) finder.emplace(*slab_.lower, *slab_.upper, *slab_.pieces);
        LooseEnd loose{end.piece, level, end.joined, {}};
        if (end.trend) loose.expected = expected(end);
        if (const auto found = finder->find(loose)) add(loose, *found, links);
      }
    }
    return links;
  }

  /// Of two ends that lie beside each other each goes half of its way.
  void add(const LooseEnd& end, const Trunk& found, std::vector<EndLink>& links) const {
    if (max_shift_ && !is_within(length(found.way), *max_shift_)) return;
    const bool is_lower = end.level == Level::lower;
    EndLink link{is_lower ? end.piece : found.piece, is_lower ? found.piece : end.piece};
    if (is_forbidden(link.lower, link.upper)) return;
    const auto half = [](Point way) { return Point{way.x / 2, way.y / 2}; };
    const auto same = std::ranges::find_if(links, [&](const EndLink& other) {
      return other.lower == link.lower && other.upper == link.upper;
    });
    if (same != links.end()) {
      same->lower_way = half(*same->lower_way);
      same->upper_way = half(found.way);
      return;
    }
    (is_lower ? link.lower_way : link.upper_way) = found.way;
    links.push_back(link);
  }

  [[nodiscard]] std::optional<EndLink> join(const End& end, Level level,
                                            const Targets& targets) const {
    constexpr double rounding = 1e-9;
    double least = std::numeric_limits<double>::infinity();
    std::optional<EndLink> best;
    bool is_tie = false;
    targets.boxes.for_each_meeting(reach_of_join(end), [&](std::uint32_t target) {
      const std::uint32_t i = targets.pieces[target];
      const Piece& piece = slab_.pieces->pieces[i];
      const EndLink link = level == Level::lower ? EndLink{end.piece, i, LinkReason::predicted}
                                                 : EndLink{i, end.piece, LinkReason::predicted};
      if (piece.is_solid != end.is_solid || is_forbidden(link.lower, link.upper)) return;
      const double off = off_outline(end, piece.footprint(other(level)));
      const double nearly = rounding * end.radius;
      if (off < least - nearly)
        is_tie = false;
      else if (off <= least + nearly && best)
        is_tie = true;
      if (!(off < least)) return;
      least = off;
      best = link;
    });
    if (is_tie) return {};  // rounding would decide
    return best;
  }

  /// How far the way of an end leads beside another part, as a circle; negative if into it,
  /// infinite if that is too far.
  [[nodiscard]] double off_outline(const End& end, const Footprint& far) const {
    const Point way = difference(far.centroid, end.footprint->centroid);
    const double shift = length(way);
    const double off = error(end, way);
    const bool is_possible = is_within(shift, max_shift_.value_or(shift)) &&
                             is_within(off, far.radius + most_beside * end.radius) &&
                             is_within(least_of_joined * end.footprint->area, far.area);
    return is_possible ? off - far.radius : std::numeric_limits<double>::infinity();
  }

  /// Meets all targets that are not too far.
  [[nodiscard]] Box3 reach_of_join(const End& end) const {
    const auto [x, y] = end.footprint->centroid;
    const Point way = expected(end);
    return box_around({x + way.x, y + way.y}, most_beside * end.radius);
  }

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
    const auto matches = Matching(beside, max_shift_, {}).find_links();
    std::vector<const Piece*> of_loop;  // by the loops of the common footprint
    for (const Piece& piece : pieces) {
      for (const std::uint32_t loop : piece.footprint(level).loops) {
        if (of_loop.size() <= loop) of_loop.resize(loop + 1, nullptr);
        of_loop[loop] = &piece;
      }
    }
    for (End& end : ends) {
      const std::uint32_t loop = end.footprint->loops.front();
      const Piece* piece = loop < of_loop.size() ? of_loop[loop] : nullptr;
      if (piece == nullptr) continue;
      end.joined = piece->footprint(level).loops;
      if (piece->footprint(level).parts != 1 || piece->footprint(level).loops.front() != loop)
        continue;
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
    return length(difference(way, expected(end)));
  }

  /// The way of a part with a trend, if it goes on as it was.
  [[nodiscard]] Point expected(const End& end) const {
    return {end.trend->velocity.x * slab_.gap, end.trend->velocity.y * slab_.gap};
  }

  /// An order keeps it from something: it might be joined to that by way of a third part.
  [[nodiscard]] bool is_named_in_forbidden(std::uint32_t piece) const {
    return std::ranges::any_of(forbidden_, [&](const EndLink& link) {
      return link.lower == piece || link.upper == piece;
    });
  }

  [[nodiscard]] bool is_forbidden(std::uint32_t lower, std::uint32_t upper) const {
    return std::ranges::any_of(forbidden_, [&](const EndLink& link) {
      return link.lower == lower && link.upper == upper;
    });
  }

  const SlabPieces& slab_;
  std::optional<double> max_shift_;
  std::span<const EndLink> forbidden_;
  bool has_neighbour_ = false;  // a slab below or above
  std::vector<End> lower_;
  std::vector<End> upper_;
  std::vector<Pair> pairs_;
};

}  // namespace

EndPlan match_ends(const SlabPieces& below, const SlabPieces& slab, const SlabPieces& above,
                   std::optional<double> max_shift, std::span<const EndLink> forbidden) {
  Matching matching(slab, max_shift, forbidden);
  if (!matching.is_possible()) return {};
  matching.look_around(below, above);
  return matching.run();
}

}  // namespace loft
