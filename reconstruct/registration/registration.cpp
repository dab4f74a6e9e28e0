// SPDX-License-Identifier: MIT
#include "reconstruct/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <utility>
#include <vector>

#include "reconstruct/registration/affine.h"
#include "reconstruct/registration/displacement.h"
#include "reconstruct/registration/frame.h"
#include "reconstruct/registration/loop_pairs.h"
#include "reconstruct/registration/matching.h"
#include "reconstruct/registration/nearest.h"
#include "reconstruct/registration/twist.h"
#include "reconstruct/tile/crossings.h"

namespace loft {

namespace {

using cdt::Point;

/// Lengths in units of the regions' thickness: what happens over less is smoothed, and how far a
/// crossing may go aside when it is taken out. With half and twice the former the tiles of folded
/// walls were the same but for a hundredth of the volume.
constexpr double softness = 0.5;
constexpr double most_drift = 0.25;
constexpr double most_twist = 0.1;

/// In squares of the distance between the loops: what it costs to change the direction, and to
/// stand still on one loop. With a quarter of the former walls are matched with the wrong side of
/// others.
constexpr double direction_weight = 4;
constexpr double pace_weight = 0.5;

/// Stretches of a loop: some for each thickness of its length, and its edges.
constexpr double fewest_places = 32;
constexpr double most_places = 128;
constexpr double stretches_of_place = 4;

/// Matched that often, each time with the affine part of what was found before taken out.
constexpr int rounds = 3;

/// The mean thickness: of a long wall what it is, of a disc its radius.
double thickness_of(const Region& region) {
  const double length = perimeter(region);
  return length > 0 ? 2 * area(region) / length : 0;
}

/// The stretches of a pair of loops.
struct Outlines {
  std::vector<Stretch> lower;
  std::vector<Stretch> upper;
  std::vector<Match> matches = {};
};

/// Some pairs, seen from one side.
struct Partner {
  std::uint32_t own;
  std::uint32_t other;
};

/// What pulls the stretches of one loop half way towards their partners. Where many
/// have one partner in common, as what is in one slice only, they are not sure of it.
void add_pulls(std::span<const Stretch> own, std::span<const Stretch> other,
               std::span<const Partner> partners, std::vector<Pull>& pulls) {
  std::vector<double> crowd(other.size());
  for (const Partner& pair : partners) ++crowd[pair.other];
  struct Sum {
    Point place;
    double count = 0;
    double sureness = 0;
  };
  std::vector<Sum> sums(own.size());
  for (const auto& [i, j] : partners) {
    const Point p = other[j].middle;
    Sum& sum = sums[i];
    sum.place = {sum.place.x + p.x, sum.place.y + p.y};
    ++sum.count;
    sum.sureness = std::max(sum.sureness, std::min(1.0, 2 / crowd[j]));
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    const auto& [place, count, sureness] = sums[i];
    const Point way{place.x / count - own[i].middle.x, place.y / count - own[i].middle.y};
    pulls.push_back({own[i], {0.5 * way.x, 0.5 * way.y}, own[i].length * sureness});
  }
}

/// All stretches of a region, and the loop of each.
struct AllStretches {
  std::vector<Stretch> stretches;
  std::vector<std::uint32_t> loops;
};

AllStretches all_stretches(const Region& region, double length) {
  AllStretches all;
  for (std::uint32_t i = 0; i < region.loop_count(); ++i) {
    const std::vector<Stretch> more = stretches_by_edges(region, i, length);
    all.stretches.insert(all.stretches.end(), more.begin(), more.end());
    all.loops.resize(all.stretches.size(), i);
  }
  return all;
}

/// Stretches where the ways of their loops take them, if there are any.
std::vector<Stretch> moved(const AllStretches& all, std::span<const Point> ways) {
  std::vector<Stretch> moved = all.stretches;
  if (ways.empty()) return moved;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Point way = ways[all.loops[i]];
    Point& p = moved[i].middle;
    p = {p.x + way.x, p.y + way.y};
  }
  return moved;
}

/// The mean way of each loop. `pulls` are those of all stretches.
std::vector<Point> ways_of_loops(const AllStretches& all, std::span<const Pull> pulls) {
  struct Sum {
    Point way;
    double weight = 0;
  };
  std::vector<Sum> sums(all.loops.empty() ? 0 : all.loops.back() + 1);
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    auto& [way, weight] = sums[all.loops[i]];
    const double more = pulls[i].weight;
    way = {way.x + more * pulls[i].way.x, way.y + more * pulls[i].way.y};
    weight += more;
  }
  std::vector<Point> ways;
  for (const auto& [way, weight] : sums) ways.push_back({way.x / weight, way.y / weight});
  return ways;
}

/// Finds how two regions lie over each other.
class Registration {
 public:
  Registration(const Region& lower, const Region& upper)
      : lower_(lower),
        upper_(upper),
        thickness_(std::min(thickness_of(lower), thickness_of(upper))) {}

  [[nodiscard]] double thickness() const { return thickness_; }
  [[nodiscard]] std::span<const Pull> lower_pulls() const { return lower_pulls_; }
  [[nodiscard]] std::span<const Pull> upper_pulls() const { return upper_pulls_; }
  [[nodiscard]] Motion motion() const {
    return {{lower_half_.shift.x - upper_half_.shift.x, lower_half_.shift.y - upper_half_.shift.y},
            (turn(lower_pulls_, 2) - turn(upper_pulls_, 2)) / 2};
  }

  /// Whatever loops they have: each stretch with the nearest one, as iterated closest points do
  /// (Besl and McKay, 1992), where each loop has gone its way since the round before.
  bool match_places(const LoopWays& ways) {
    if (!(thickness_ > 0)) return false;
    match_places(stretches_of(lower_), stretches_of(upper_), ways);
    return true;
  }

  void match_places(const AllStretches& below, const AllStretches& above, const LoopWays& ways) {
    outlines_.assign(1, {below.stretches, above.stretches});
    std::vector<Stretch> lower = moved(below, ways.lower);
    std::vector<Stretch> upper = moved(above, ways.upper);
    for (int round = 0; round < rounds; ++round) {
      const double distance = std::max(thickness_ * thickness_, mean_square_distance(lower, upper));
      outlines_[0].matches = match_nearest(lower, upper, direction_weight * distance);
      pull();
      lower = moved(below, ways_of_loops(below, lower_pulls_));
      upper = moved(above, ways_of_loops(above, upper_pulls_));
    }
  }

  /// Some loops by their ways over what the others match with; these as if they were not there.
  bool follow(const LoopWays& ways) {
    if (!(thickness_ > 0)) return false;
    const AllStretches below = stretches_of(lower_);
    const AllStretches above = stretches_of(upper_);
    const AllStretches lower = staying(below, ways.lower);
    const AllStretches upper = staying(above, ways.upper);
    if (lower.stretches.empty() || upper.stretches.empty()) {
      lower_pulls_ = without_way(lower);
      upper_pulls_ = without_way(upper);
    } else {
      match_places(lower, upper, {});
    }
    const Affine lower_half = lower_pulls_.empty() ? Affine{} : fit_affine(lower_pulls_);
    const Affine upper_half = upper_pulls_.empty() ? Affine{} : fit_affine(upper_pulls_);
    add_followers(below, ways.lower, upper_half, lower_pulls_);
    add_followers(above, ways.upper, lower_half, upper_pulls_);
    lower_half_ = fit_affine(lower_pulls_);
    upper_half_ = fit_affine(upper_pulls_);
    return true;
  }

  /// Loop with loop. False if their loops do not belong together.
  bool match_loops(Point offset) {
    if (!(thickness_ > 0)) return false;
    const auto pairs = pair_loops(lower_, upper_, offset);
    if (!pairs) return false;
    sample(*pairs);
    lower_half_ = {{}, {offset.x / 2, offset.y / 2}, {}, {}};
    upper_half_ = {{}, {-offset.x / 2, -offset.y / 2}, {}, {}};
    for (int round = 0; round < rounds; ++round) {
      bool is_changed = false;
      for (Outlines& outlines : outlines_) is_changed |= match(outlines);
      if (!is_changed) break;  // nor would another round change anything
      pull();
    }
    return true;
  }

  /// Whether another one has found the same.
  [[nodiscard]] bool is_as(const Registration& other) const {
    return pairs_ == other.pairs_ && std::ranges::equal(outlines_, other.outlines_, {},
                                                        &Outlines::matches, &Outlines::matches);
  }

 private:
  [[nodiscard]] double stretch_count() const {
    const double length = std::max(perimeter(lower_), perimeter(upper_));
    return stretches_of_place * std::clamp(length / thickness_, fewest_places, most_places);
  }

  [[nodiscard]] AllStretches stretches_of(const Region& region) const {
    return all_stretches(region, perimeter(region) / stretch_count());
  }

  /// The stretches of loops that have no way of their own.
  [[nodiscard]] static AllStretches staying(const AllStretches& all, std::span<const Point> ways) {
    AllStretches staying;
    for (std::size_t i = 0; i < all.stretches.size(); ++i) {
      if (ways[all.loops[i]] != Point{}) continue;
      staying.stretches.push_back(all.stretches[i]);
      staying.loops.push_back(all.loops[i]);
    }
    return staying;
  }

  [[nodiscard]] static std::vector<Pull> without_way(const AllStretches& all) {
    std::vector<Pull> pulls;
    for (const Stretch& stretch : all.stretches) pulls.push_back({stretch, {}, stretch.length});
    return pulls;
  }

  /// Pulls of loops that go to where something else is, which goes its own way.
  static void add_followers(const AllStretches& all, std::span<const Point> ways,
                            const Affine& other, std::vector<Pull>& pulls) {
    for (std::size_t i = 0; i < all.stretches.size(); ++i) {
      const Point way = ways[all.loops[i]];
      if (way == Point{}) continue;
      const Stretch& stretch = all.stretches[i];
      const Point further = other.way({stretch.middle.x + way.x, stretch.middle.y + way.y});
      pulls.push_back({stretch, {way.x + further.x, way.y + further.y}, stretch.length});
    }
  }

  void sample(const std::vector<LoopPair>& pairs) {
    pairs_ = pairs;
    const double count = stretch_count();
    for (const auto& [below, above] : pairs)
      outlines_.push_back({stretches_by_edges(lower_, below, length(lower_, below) / count),
                           stretches_by_edges(upper_, above, length(upper_, above) / count)});
  }

  /// Whether that is not what it was before.
  bool match(Outlines& outlines) const {
    auto& [lower, upper, matches] = outlines;
    std::vector<Stretch> below = lower;
    std::vector<Stretch> above = upper;
    for (Stretch& stretch : below) stretch = lower_half_.moved(stretch);
    for (Stretch& stretch : above) stretch = upper_half_.moved(stretch);
    const double distance = std::max(thickness_ * thickness_, mean_square_distance(below, above));
    const std::vector<Match> before = std::exchange(
        matches, match_outlines(below, above, direction_weight * distance, pace_weight * distance));
    return matches != before;
  }

  void pull() {
    lower_pulls_.clear();
    upper_pulls_.clear();
    for (const auto& [lower, upper, matches] : outlines_) {
      std::vector<Partner> from_lower;
      std::vector<Partner> from_upper;
      for (const Match& match : matches) {
        from_lower.push_back({match.lower, match.upper});
        from_upper.push_back({match.upper, match.lower});
      }
      add_pulls(lower, upper, from_lower, lower_pulls_);
      add_pulls(upper, lower, from_upper, upper_pulls_);
    }
    lower_half_ = fit_affine(lower_pulls_);
    upper_half_ = fit_affine(upper_pulls_);
  }

  const Region& lower_;
  const Region& upper_;
  double thickness_;
  std::vector<LoopPair> pairs_;
  std::vector<Outlines> outlines_;
  std::vector<Pull> lower_pulls_;
  std::vector<Pull> upper_pulls_;
  Affine lower_half_;  // half way to the other region
  Affine upper_half_;
};

/// What is left of two draughts' differences may differ by that share by rounding.
constexpr double rounding_of_difference = 0x1p-40;

/// Tiles that are chosen, but not put back and tested.
struct Draught {
  Frame frame;
  Registered registered;
};

std::optional<Draught> draw(const Region& lower, const Region& upper,
                            const Registration& registration, std::size_t most_pairs) {
  const double least = softness * registration.thickness();
  const auto below = Displacement::fit(lower, registration.lower_pulls(), least);
  const auto above = Displacement::fit(upper, registration.upper_pulls(), least);
  if (!below || !above) return {};
  Frame frame(lower, upper, below->ways(), above->ways());
  auto tiles = tile_with_crossings(frame.lower(), frame.upper(), most_pairs);
  if (!tiles) return {};
  const double difference = frame.covered(*tiles);
  return Draught{std::move(frame), {std::move(*tiles), difference, registration.motion()}};
}

std::list<Draught> draw_all(const Region& lower, const Region& upper,
                            std::span<const Point> offsets, std::size_t most_pairs) {
  std::list<Draught> draughts;
  std::vector<Registration> before;
  for (const Point offset : offsets) {
    Registration registration(lower, upper);
    if (!registration.match_loops(offset)) continue;
    const auto is_same = [&](const Registration& other) { return registration.is_as(other); };
    if (std::ranges::any_of(before, is_same)) continue;
    if (auto draught = draw(lower, upper, registration, most_pairs))
      draughts.push_back(std::move(*draught));
    before.push_back(std::move(registration));
  }
  return draughts;
}

/// The one that leaves least of a difference, the first of those that are the same but for
/// rounding.
std::list<Draught>::iterator best(std::list<Draught>& draughts) {
  auto best = draughts.begin();
  for (auto it = draughts.begin(); it != draughts.end(); ++it)
    if (it->registered.difference < (1 - rounding_of_difference) * best->registered.difference)
      best = it;
  return best;
}

/// False if the tiles meet.
bool put_back(const Region& lower, const Region& upper, double thickness, Draught& draught,
              std::size_t most_pairs) {
  TileSet& tiles = draught.registered.tiles;
  draught.frame.put_back(tiles);
  collapse_crossings(lower, upper, tiles, true, most_drift * thickness);
  ease_twists(lower, upper, tiles, most_twist * thickness);
  return !tiles_meet(lower, upper, tiles, most_pairs);
}

/// The one way there is; none if it is not wanted, or its tiles meet.
std::optional<Registered> tile_as_matched(const Region& lower, const Region& upper,
                                          const Registration& registration, std::size_t most_pairs,
                                          const IsWanted& is_wanted) {
  auto draught = draw(lower, upper, registration, most_pairs);
  if (!draught || !is_wanted(draught->registered)) return {};
  if (!put_back(lower, upper, registration.thickness(), *draught, most_pairs)) return {};
  return std::move(draught->registered);
}

}  // namespace

std::optional<Registered> tile_registered(const Region& lower, const Region& upper,
                                          std::span<const Point> offsets, std::size_t most_pairs,
                                          const IsWanted& is_wanted) {
  const double thickness = std::min(thickness_of(lower), thickness_of(upper));
  std::list<Draught> draughts = draw_all(lower, upper, offsets, most_pairs);
  const auto is_hopeful = [&](const Draught& draught) { return is_wanted(draught.registered); };
  while (std::ranges::any_of(draughts, is_hopeful)) {
    const auto chosen = best(draughts);
    const bool is_chosen_wanted = is_hopeful(*chosen);
    if (put_back(lower, upper, thickness, *chosen, most_pairs)) {
      if (!is_chosen_wanted) return {};
      return std::move(chosen->registered);
    }
    draughts.erase(chosen);
  }
  return {};
}

std::optional<Registered> tile_registered_by_places(const Region& lower, const Region& upper,
                                                    std::size_t most_pairs,
                                                    const IsWanted& is_wanted,
                                                    const LoopWays& ways) {
  Registration registration(lower, upper);
  if (!registration.match_places(ways)) return {};
  return tile_as_matched(lower, upper, registration, most_pairs, is_wanted);
}

std::optional<Registered> tile_registered_by_ways(const Region& lower, const Region& upper,
                                                  std::size_t most_pairs, const IsWanted& is_wanted,
                                                  const LoopWays& ways) {
  Registration registration(lower, upper);
  if (!registration.follow(ways)) return {};
  return tile_as_matched(lower, upper, registration, most_pairs, is_wanted);
}

}  // namespace loft
