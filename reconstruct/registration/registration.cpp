// SPDX-License-Identifier: MIT
#include "reconstruct/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "reconstruct/registration/affine.h"
#include "reconstruct/registration/displacement.h"
#include "reconstruct/registration/frame.h"
#include "reconstruct/registration/loop_pairs.h"
#include "reconstruct/registration/matching.h"
#include "reconstruct/tile/crossings.h"

namespace loft {

namespace {

using cdt::Point;

/// Lengths in units of the regions' thickness: what happens over less is smoothed, and how far a
/// crossing may go aside when it is taken out. With half and twice the former the tiles of folded
/// walls were the same but for a hundredth of the volume.
constexpr double softness = 0.5;
constexpr double most_drift = 0.25;

/// In squares of the distance between the loops: what it costs to change the direction, and to
/// stand still on one loop. With a quarter of the former walls are matched with the wrong side of
/// others.
constexpr double direction_weight = 4;
constexpr double pace_weight = 0.5;

/// Places of a loop, one for each thickness of its length, and stretches between two of them.
constexpr double fewest_places = 32;
constexpr double most_places = 128;
constexpr std::size_t stretches_of_place = 4;

/// Matched that often, each time with the affine part of what was found before taken out.
constexpr int rounds = 3;

/// The mean thickness: of a long wall what it is, of a disc its radius.
double thickness_of(const Region& region) { return 2 * area(region) / perimeter(region); }

/// The mean square of the way to the nearest stretch of another loop.
double mean_square_distance(std::span<const Stretch> from, std::span<const Stretch> to) {
  double sum = 0;
  for (const Stretch& a : from) {
    double least = std::numeric_limits<double>::infinity();
    for (const Stretch& b : to) {
      const double x = b.middle.x - a.middle.x;
      const double y = b.middle.y - a.middle.y;
      least = std::min(least, x * x + y * y);
    }
    sum += least;
  }
  return sum / static_cast<double>(from.size());
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
    const auto& [centre, shift, along_x, along_y] = back_;
    return {{-shift.x, -shift.y}, -std::atan2(along_x.y - along_y.x, 2 + along_x.x + along_y.y)};
  }

  /// False if their loops do not belong together.
  bool match(Point offset) {
    if (!(thickness_ > 0)) return false;
    const auto pairs = pair_loops(lower_, upper_, offset);
    if (!pairs) return false;
    sample(*pairs);
    back_ = {{}, {-offset.x, -offset.y}, {}, {}};
    for (int round = 0; round < rounds; ++round) {
      for (Outlines& outlines : outlines_) match(outlines);
      pull();
    }
    return true;
  }

 private:
  void sample(std::span<const LoopPair> pairs) {
    const double length = std::max(perimeter(lower_), perimeter(upper_));
    const auto places = static_cast<std::size_t>(
        std::clamp(length / thickness_ + 1e-6, fewest_places, most_places));
    for (const LoopPair& pair : pairs)
      outlines_.push_back({stretches(lower_, pair.lower, stretches_of_place * places),
                           stretches(upper_, pair.upper, stretches_of_place * places)});
  }

  void match(Outlines& outlines) const {
    auto& [lower, upper, matches] = outlines;
    std::vector<Stretch> moved = upper;
    for (Stretch& stretch : moved) stretch = back_.moved(stretch);
    const double distance = std::max({thickness_ * thickness_, mean_square_distance(lower, moved),
                                      mean_square_distance(moved, lower)});
    matches = match_outlines(lower, moved, direction_weight * distance, pace_weight * distance,
                             lower.size() / stretches_of_place);
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
    std::vector<Pull> back = upper_pulls_;
    for (Pull& pull : back) pull.way = {2 * pull.way.x, 2 * pull.way.y};
    back_ = fit_affine(back);
  }

  const Region& lower_;
  const Region& upper_;
  double thickness_;
  std::vector<Outlines> outlines_;
  std::vector<Pull> lower_pulls_;
  std::vector<Pull> upper_pulls_;
  Affine back_;
};

}  // namespace

std::optional<Registered> tile_registered(const Region& lower, const Region& upper, Point offset,
                                          std::size_t most_pairs) {
  Registration registration(lower, upper);
  if (!registration.match(offset)) return {};
  const double thickness = registration.thickness();
  const auto below = Displacement::fit(lower, registration.lower_pulls(), softness * thickness);
  const auto above = Displacement::fit(upper, registration.upper_pulls(), softness * thickness);
  if (!below || !above) return {};
  const Frame frame(lower, upper, below->ways(), above->ways());
  auto tiles = tile_with_crossings(frame.lower(), frame.upper(), most_pairs);
  if (!tiles) return {};
  const double difference = frame.covered(*tiles);
  frame.put_back(*tiles);
  collapse_crossings(lower, upper, *tiles, true, most_drift * thickness);
  std::size_t pairs_left = most_pairs;
  if (tiles_meet(lower, upper, *tiles, pairs_left)) return {};
  return Registered{std::move(*tiles), difference, registration.motion()};
}

}  // namespace loft
