// SPDX-License-Identifier: MIT
#include "reconstruct/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
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

double env(const char* name, double otherwise) {
  const char* v = std::getenv(name);
  return v ? std::atof(v) : otherwise;
}
#define REASON(...) do { if (getenv("REGDBG")) fprintf(stderr, __VA_ARGS__); } while (0)

/// Lengths in units of the regions' thickness.
const double softness = env("SOFT", 0.5);
const double near = env("NEAR", 0.02);
const double most_askew = env("SKEW", 0.1);
const double most_drift = env("DRIFT", 0.25);

/// In squares of the distance between the loops: what a change of direction costs, and to stand
/// still on one loop.
const double direction_weight = env("DIRECTION", 4);
const double pace_weight = env("PACE", 0.5);

/// Places of a loop, that many for each thickness of its length.
constexpr double fewest_places = 48;
const double most_places = env("COARSE", 128);
constexpr std::size_t stretches_of_place = 4;

/// Matched that often, each time with the affine part of what was found before taken out.
const int rounds = static_cast<int>(env("ROUNDS", 3));
const int splits = static_cast<int>(env("SPLITS", 2));

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

/// What pulls the stretches of one loop towards their partners, by a share of the way. Where many
/// have one partner in common, as what is in one slice only, they are not sure of it.
void add_pulls(std::span<const Stretch> own, std::span<const Stretch> other,
               std::span<const Partner> partners, double share, std::vector<Pull>& pulls) {
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
    pulls.push_back({own[i], {share * way.x, share * way.y}, own[i].length * sureness});
  }
}

/// Finds how two regions lie over each other.
class Registration {
 public:
  Registration(const Region& lower, const Region& upper)
      : lower_(lower), upper_(upper), thickness_(std::min(thickness_of(lower), thickness_of(upper))) {}

  [[nodiscard]] double thickness() const { return thickness_; }
  [[nodiscard]] std::span<const Pull> lower_pulls() const { return lower_pulls_; }
  [[nodiscard]] std::span<const Pull> upper_pulls() const { return upper_pulls_; }
  /// From the upper region back to the lower one.
  [[nodiscard]] const Affine& back() const { return back_; }

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
    const auto places =
        static_cast<std::size_t>(std::clamp(length / thickness_, fewest_places, most_places));
    for (const LoopPair& pair : pairs)
      outlines_.push_back({stretches(lower_, pair.lower, stretches_of_place * places),
                           stretches(upper_, pair.upper, stretches_of_place * places)});
  }

  void match(Outlines& outlines) const {
    auto& [lower, upper, matches] = outlines;
    std::vector<Stretch> moved = upper;
    for (Stretch& stretch : moved) stretch = back_.moved(stretch);
    const double distance =
        std::max({thickness_ * thickness_, mean_square_distance(lower, moved),
                  mean_square_distance(moved, lower)});
    matches = match_outlines(lower, moved, direction_weight * distance, pace_weight * distance,
                             lower.size() / stretches_of_place);
  }

  void pull() {
    lower_pulls_.clear();
    upper_pulls_.clear();
    std::vector<Pull> back;
    for (const auto& [lower, upper, matches] : outlines_) {
      std::vector<Partner> from_lower;
      std::vector<Partner> from_upper;
      for (const Match& match : matches) {
        from_lower.push_back({match.lower, match.upper});
        from_upper.push_back({match.upper, match.lower});
      }
      add_pulls(lower, upper, from_lower, 0.5, lower_pulls_);
      add_pulls(upper, lower, from_upper, 0.5, upper_pulls_);
      add_pulls(upper, lower, from_upper, 1, back);
    }
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

/// Takes the crossings out of tiles that were put back, and follows the way back more closely.
/// False if they meet.
bool finish(const Region& lower, const Region& upper, double thickness, std::size_t most_pairs,
            Frame& frame, TileSet& tiles) {
  for (int i = 0; i < splits; ++i) frame.split_askew(tiles, most_askew * thickness);
  collapse_crossings(lower, upper, tiles, true, most_drift * thickness);
  for (int i = 0; i < splits; ++i) frame.split_askew(tiles, most_askew * thickness);
  std::size_t pairs_left = most_pairs;
  if (tiles_meet(lower, upper, tiles, pairs_left)) { REASON("skew meet\n"); return false; }
  return true;
}

}  // namespace

std::optional<Registered> tile_registered(const Region& lower, const Region& upper, Point offset,
                                          std::size_t most_pairs) {
  Registration registration(lower, upper);
  if (!registration.match(offset)) { REASON("no match\n"); return {}; }
  const double thickness = registration.thickness();
  const auto below = Displacement::fit(lower, registration.lower_pulls(), softness * thickness);
  const auto above = Displacement::fit(upper, registration.upper_pulls(), softness * thickness);
  if (!below || !above) { REASON("no embedding\n"); return {}; }
  Frame frame(lower, upper, below->ways(), above->ways());
  auto tiles = tile_with_crossings(frame.lower(), frame.upper(), near * thickness, most_pairs);
  if (!tiles) { REASON("no tiles\n"); return {}; }
  Registered made;
  made.difference = frame.covered(*tiles);
  frame.put_back(*tiles);
  if (!finish(lower, upper, thickness, most_pairs, frame, *tiles)) return {};
  made.tiles = std::move(*tiles);
  made.tiles.is_plain = false;
  const Point away = registration.back().shift;
  const Affine& back = registration.back();
  made.motion = {{-away.x, -away.y},
                 -std::atan2(back.along_x.y - back.along_y.x, 2 + back.along_x.x + back.along_y.y)};
  return made;
}

}  // namespace loft
