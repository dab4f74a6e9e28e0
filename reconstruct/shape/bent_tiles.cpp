// SPDX-License-Identifier: MIT
#include "reconstruct/shape/bent_tiles.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "cdt/effort.h"
#include "mesh/vec3.h"
#include "reconstruct/shape/edge_index.h"
#include "reconstruct/shape/half_edges.h"
#include "reconstruct/shape/smooth_target.h"
#include "reconstruct/shape/ways.h"

namespace loft {

namespace {

using cdt::Point;

/// If nothing else is asked for, an edge is split where its middle is further from the smooth
/// surface than that share of the slab's height, at most twice over. On 26 stacks finer tiles were
/// no nearer to the shapes that were cut.
constexpr double usual_share = 0.014;
constexpr int usual_levels = 2;
constexpr double usual_nearness = 0.003;

/// The same where a distance is asked for; slices do not tell more, and noise of rounding would be
/// split without end.
constexpr double finest_share = 5e-4;
constexpr int most_levels = 5;
constexpr double finest_nearness = 1e-4;

/// The same for tiles that are straight but at their forks. Half as coarse there are three times as
/// many new vertices, and places are found with more steps, for no less distance.
constexpr double fork_share = 4 * usual_share;
constexpr double fork_nearness = 6 * usual_nearness;

/// How far a vertex may go: new ones as a share of their edge, those of forks and ends as a share
/// of the slab's height.
constexpr double most_of_edge = 0.35;
constexpr double most_of_fork = 0.5;
constexpr double most_of_end = 1;

/// Edges that are nearer than that share of the slab's height are not flipped.
constexpr double least_off = 0.003;

/// What is as good but for rounding, as a share of the slab's height.
constexpr double equal_share = 1e-6;

/// By what share of the slab's height a diagonal may be further off, if the thinner one of its
/// triangles is better by 1.
constexpr double worth_of_form = 0.028;

/// The longest diagonal, as a multiple of the one that it replaces. With 1 flips help half as much;
/// with more they help little more.
constexpr double most_of_diagonal = 1.2;

/// Two triangles are flipped that turn by less, and not to ones that turn by more: 60 degrees.
constexpr double least_cosine_of_turn = 0.5;

/// Edges that are looked at after a split. On 26 stacks it is seldom more than 60; around a vertex
/// with thousands of edges flips would go on through all of them.
constexpr std::size_t most_looks = 128;

/// Around a node with more tiles nothing is flipped: each split would flip most of the fan, and
/// what comes of it meets itself. Of 26 stacks none has such a node where it bends.
constexpr std::uint32_t widest_fan = 64;

/// Vertices go beyond the surface by so much of what their edges stay short of it in the mean. For
/// a round strip whose rows are halved once 2 would make the volume right; edges along a strip stay
/// short by nothing.
constexpr double overshoot = 1.5;

/// The same, by no more than that share of the tolerance, and of the height of the flattest tile at
/// it: thin tiles side by side would meet.
constexpr double most_of_tolerance = 0.75;
constexpr double most_of_tile = 0.25;

/// 0 where directions are against each other by more than 120 degrees.
Point unit(Point sum) {
  const double length = std::hypot(sum.x, sum.y);
  return length < 0.999 ? Point{} : Point{sum.x / length, sum.y / length};
}

double cosine(const Vec3& a, const Vec3& b) {
  return dot(a, b) / std::sqrt(squared_length(a) * squared_length(b));
}

/// Whether two triangles, and what a flip makes of them, are turned alike; by their normals.
bool are_turned_alike(const std::array<Vec3, 2>& before, const std::array<Vec3, 2>& after) {
  const auto alike = [](const Vec3& a, const Vec3& b) {
    return cosine(a, b) > least_cosine_of_turn;  // false where one is degenerate
  };
  return alike(after[0], after[1]) && alike(after[0], before[0]) && alike(after[0], before[1]) &&
         alike(after[1], before[0]) && alike(after[1], before[1]);
}

double squared_longest(const Corners& corners) {
  const auto& [a, b, c] = corners;
  return std::max(
      {squared_length(minus(b, a)), squared_length(minus(c, b)), squared_length(minus(a, c))});
}

/// Upon the longest edge.
double least_height(const Corners& corners) {
  const auto& [a, b, c] = corners;
  return length(cross(minus(b, a), minus(c, a))) / std::sqrt(squared_longest(corners));
}

/// An edge of the tiles, or one that was or may be.
struct BentEdge {
  Vec3 start{};  // its middle
  Vec3 way{};    // from there to the smooth surface
  Vec3 straight{};
  double off = -1;      // how long the way is; negative: not looked at yet
  double loose = 1;     // see Freedom
  int level = 0;        // of splits that led to it
  bool was_in = false;  // the tiles; such an edge does not come back, so that flips end
};

class Bending {
 public:
  Bending(const BentSlab& slab, std::span<const OutlinePoint> outlines, const TileSet& plain,
          const Fineness& fineness, std::vector<bool> firm)
      : lower_(slab.lower),
        upper_(slab.upper),
        bent_{plain, {}},
        piece_(slab.pieces.of_tile),
        target_(slab, plain, fineness.nearness),
        freedom_(slab, outlines, plain),
        half_edges_(bent_.tiles.tiles),
        firm_(std::move(firm)),
        fineness_(fineness),
        height_(slab.upper.z - slab.lower.z),
        lower_count_(static_cast<std::uint32_t>(lower_.points.size())),
        contour_count_(lower_count_ + static_cast<std::uint32_t>(upper_.points.size())),
        plain_bound_(contour_count_ + static_cast<std::uint32_t>(plain.inner.size())),
        queue_(Nearer{this}) {
    for (const OutlinePoint& point : outlines) facing_.push_back(unit(point.facing));
    facing_.resize(contour_count_ + plain.inner.size());
    hold_wide_fans();
  }

  BentTiles run() {
    move_inner();
    note_edges();
    flip_all();
    while (!queue_.empty()) {
      std::size_t count = 0;
      for (const Candidate& next : take_best(queue_, &Candidate::off)) {
        if (half_edges_.from(next.half) != next.from || half_edges_.to(next.half) != next.to)
          continue;
        split(next.half);
        ++count;
      }
      flip_doubtful(count * most_looks);
    }
    go_beyond();
    return std::move(bent_);
  }

 private:
  /// An edge that is off, as it was when that was found out.
  struct Candidate {
    double off;
    std::uint32_t half;
    std::uint32_t from;
    std::uint32_t to;
  };
  /// By how far they are off, those that are as far by place: numbers have no part in it.
  struct Nearer {
    const Bending* bending;
    bool operator()(const Candidate& a, const Candidate& b) const {
      if (a.off != b.off) return a.off < b.off;
      return bending->ends(b) < bending->ends(a);
    }
  };

  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, bent_.tiles.inner, node);
  }

  [[nodiscard]] Vec3 straight_place(std::uint32_t node) const {
    return node < contour_count_ ? place(node) : bent_.moves[node - contour_count_].straight;
  }

  [[nodiscard]] std::pair<Vec3, Vec3> ends(const Candidate& edge) const {
    return std::minmax(place(edge.from), place(edge.to));
  }
  [[nodiscard]] std::pair<Vec3, Vec3> ends(const HalfEdges::Diamond& diamond) const {
    return std::minmax(place(diamond.a), place(diamond.b));
  }

  /// A contour edge; or one that rounding has left in the slice plane.
  [[nodiscard]] bool in_one_slice(std::uint32_t a, std::uint32_t b) const {
    return std::max(a, b) < contour_count_ && (a < lower_count_) == (b < lower_count_);
  }

  /// Takes the first of a queue, and all that are as good but for rounding: at forks it must not
  /// decide which of them is first.
  template <class Queue, class Value>
  [[nodiscard]] std::vector<typename Queue::value_type> take_best(Queue& queue, Value value) const {
    std::vector<typename Queue::value_type> best;
    const double least =
        std::invoke(value, queue.top()) - (is_at_forks() ? equal_share * height_ : 0);
    do {
      best.push_back(queue.top());
      queue.pop();
    } while (is_at_forks() && !queue.empty() && std::invoke(value, queue.top()) >= least);
    return best;
  }

  [[nodiscard]] bool is_at_forks() const { return fineness_.bends == Bends::at_forks; }

  [[nodiscard]] bool is_plain_inner(std::uint32_t node) const {
    return node >= contour_count_ && node < plain_bound_;
  }

  [[nodiscard]] Point facing(std::uint32_t a, std::uint32_t b) const {
    return unit({facing_[a].x + facing_[b].x, facing_[a].y + facing_[b].y});
  }

  /// Holds until the next call.
  [[nodiscard]] BentEdge& edge(std::uint32_t a, std::uint32_t b) {
    const auto [number, is_known] = index_.at(a, b);
    if (!is_known) {
      number = static_cast<std::uint32_t>(edges_.size());
      edges_.emplace_back();
    }
    return edges_[number];
  }

  void hold_wide_fans() {
    std::vector<std::uint32_t> tiles_at(facing_.size());
    for (const Tile& tile : bent_.tiles.tiles)
      for (const std::uint32_t node : tile.nodes) ++tiles_at[node];
    firm_.resize(tiles_at.size());
    for (std::uint32_t node = 0; node < tiles_at.size(); ++node)
      if (tiles_at[node] > widest_fan) firm_[node] = true;
  }

  /// The vertices that forks, ends and crossings have already.
  void move_inner() {
    std::vector<InnerVertex>& inner = bent_.tiles.inner;
    std::vector<std::uint32_t> piece(inner.size(), Origin::none);
    for (std::uint32_t t = 0; t < bent_.tiles.tiles.size(); ++t)
      for (const std::uint32_t node : bent_.tiles.tiles[t].nodes)
        if (node >= contour_count_) piece[node - contour_count_] = piece_[t];
    for (std::uint32_t i = 0; i < inner.size(); ++i) {
      const Vec3 start = inner[i].place;
      const double most = (target_.is_end(piece[i]) ? most_of_end : most_of_fork) * height_;
      const double freedom = freedom_.of_node(contour_count_ + i, piece[i]);
      const Vec3 way = along({}, freedom, target_.way_from(start, piece[i], most, {}));
      bent_.moves.push_back({{Origin::none, Origin::none}, start, way, start});
      inner[i].place = along(start, 1, way);
    }
  }

  void note_edges() {
    for (const Tile& tile : bent_.tiles.tiles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = tile.nodes[i];
        const std::uint32_t b = tile.nodes[(i + 1) % 3];
        BentEdge& known = edge(a, b);
        if (!known.was_in) known.loose = freedom_.looseness(a, b);
        known.was_in = true;
      }
    }
  }

  /// How far the middle of an edge, or of one that may be, is off.
  double off(std::uint32_t a, std::uint32_t b, std::uint32_t piece) {
    BentEdge& bent = edge(a, b);
    if (bent.off < 0) look(bent, a, b, piece);
    return bent.off;
  }

  void look(BentEdge& bent, std::uint32_t a, std::uint32_t b, std::uint32_t piece) const {
    bent.start = edge_middle(place(a), place(b));
    bent.straight = edge_middle(straight_place(a), straight_place(b));
    const double freedom = freedom_.of_edge(a, b, piece, bent.loose);
    const double most = most_of_edge * length(minus(place(a), place(b)));
    Vec3 way = minus(bent.straight, bent.start);
    if (freedom > 0) {
      // Its ends were given way by as much: the smooth surface is further from it than from them.
      const double given = (1 - freedom) / freedom * length(way);
      const Vec3 free = free_way(bent.start, a, b, piece, most + given);
      way = along(free, 1 - freedom, minus(way, free));
    }
    bent.way = cut_off(way, most);
    bent.off = length(bent.way);
  }

  /// From the middle of an edge, if nothing speaks for it to be straight. At corners of outlines
  /// the way that leads there though distances change evenly is left out: faces are flat there.
  [[nodiscard]] Vec3 free_way(const Vec3& start, std::uint32_t a, std::uint32_t b,
                              std::uint32_t piece, double most) const {
    const Vec3 way = target_.way_from(start, piece, most, facing(a, b));
    const double corner = 1 - freedom_.roundness(a, b);
    if (corner == 0) return way;
    return along(way, -corner, target_.even_way_from(start, piece, most, facing(a, b)));
  }

  /// Notes an edge if it is to be split.
  void enqueue(std::uint32_t half) {
    if (half_edges_.twin(half) == Origin::none) return;
    const std::uint32_t a = half_edges_.from(half);
    const std::uint32_t b = half_edges_.to(half);
    if (in_one_slice(a, b) || edge(a, b).level >= fineness_.levels) return;
    if (is_at_forks() && !is_plain_inner(a) && !is_plain_inner(b)) return;
    const double distance = off(a, b, piece_[half / 3]);
    if (distance > fineness_.tolerance) queue_.push({distance, half, a, b});
  }

  void split(std::uint32_t half) {
    cdt::spend();
    const auto [a, b, left, right] = half_edges_.diamond(half);
    piece_.resize(piece_.size() + 2, piece_[half / 3]);
    const BentEdge bent = edge(a, b);
    const std::uint32_t node = add_middle(a, b, bent);
    for (const std::uint32_t end : {a, b, left, right}) {
      const bool is_half = end == a || end == b;
      BentEdge& added = edge(node, end);
      added.was_in = true;
      added.level = bent.level + 1;
      added.loose = is_half ? bent.loose : freedom_.looseness(node, end);
    }
    const auto around = half_edges_.split(half, node);
    doubtful_.insert(doubtful_.end(), around.begin(), around.end());
  }

  std::uint32_t add_middle(std::uint32_t a, std::uint32_t b, const BentEdge& bent) {
    bent_.tiles.inner.push_back({along(bent.start, 1, bent.way), VertexKind::steiner});
    bent_.moves.push_back({{a, b}, bent.start, bent.way, bent.straight});
    freedom_.add_middle(a, b, bent.loose);
    facing_.push_back(facing(a, b));
    firm_.push_back(firm_[a] || firm_[b]);
    return contour_count_ + static_cast<std::uint32_t>(bent_.moves.size()) - 1;
  }

  // --- Flips ---

  /// Flips what there is to flip before any split; notes what is to be split.
  void flip_all() {
    const std::uint32_t count = half_edges_.count();
    for (std::uint32_t half = count; half-- > 0;) doubtful_.push_back(half);
    if (is_at_forks()) flip_best_first(any_number);
    while (!doubtful_.empty()) flip_next();
    for (std::uint32_t half = 0; half < count; ++half) {
      const std::uint32_t twin = half_edges_.twin(half);
      if (twin != Origin::none && half < twin) enqueue(half);
    }
  }

  /// Flips edges as long as that helps and does not take more than `most` looks; notes those of
  /// them that are to be split.
  void flip_doubtful(std::size_t most) {
    std::vector<std::uint32_t> seen;
    if (is_at_forks()) seen = flip_best_first(most);
    while (!doubtful_.empty() && seen.size() < most) {
      seen.push_back(doubtful_.back());
      flip_next();
    }
    seen.insert(seen.end(), doubtful_.begin(), doubtful_.end());
    doubtful_.clear();
    for (const std::uint32_t half : seen) enqueue(half);
  }

  /// An edge that would better be the other diagonal, as it was when that was found out.
  struct Flip {
    double gain;
    std::uint32_t half;
    HalfEdges::Diamond diamond;
  };
  struct LessGain {
    const Bending* bending;
    bool operator()(const Flip& a, const Flip& b) const {
      if (a.gain != b.gain) return a.gain < b.gain;
      return bending->ends(b.diamond) < bending->ends(a.diamond);
    }
  };

  [[nodiscard]] bool is_there(const Flip& flip) const {
    return half_edges_.twin(flip.half) != Origin::none &&
           half_edges_.diamond(flip.half) == flip.diamond;
  }

  /// Whether to flip another edge of the two tiles is as good, but for rounding.
  [[nodiscard]] bool has_equal_rival(const Flip& flip) {
    const auto is_rival = [&](std::uint32_t half) {
      const double equal = equal_share * height_;
      return may_flip(half) && std::abs(gain_of_flip(half, flip.gain - equal) - flip.gain) <= equal;
    };
    const std::uint32_t twin = half_edges_.twin(flip.half);
    const auto [first, second] = half_edges_.others(flip.half);
    const auto [third, fourth] = half_edges_.others(twin);
    return is_rival(first) || is_rival(second) || is_rival(third) || is_rival(fourth);
  }

  /// Flips the doubtful edges, and those that flips make doubtful, after no more than `most` looks.
  /// Returns all that were looked at.
  std::vector<std::uint32_t> flip_best_first(std::size_t most) {
    std::vector<std::uint32_t> seen;
    std::priority_queue<Flip, std::vector<Flip>, LessGain> flips(LessGain{this});
    const auto look_at = [&](std::uint32_t half) {
      cdt::spend();
      seen.push_back(half);
      if (!may_flip(half)) return;
      const double least = equal_share * height_;
      const double gain = gain_of_flip(half, least);
      if (gain > least) flips.push({gain, half, half_edges_.diamond(half)});
    };
    std::ranges::for_each(doubtful_, look_at);
    doubtful_.clear();
    while (!flips.empty() && seen.size() < most) {
      std::vector<Flip> best = take_best(flips, &Flip::gain);
      std::erase_if(best, [&](const Flip& flip) {
        return !is_there(flip) || !may_flip(flip.half) || has_equal_rival(flip);
      });
      for (const Flip& next : best)
        if (is_there(next)) std::ranges::for_each(flip(next.half), look_at);
    }
    return seen;
  }

  void flip_next() {
    cdt::spend();
    const std::uint32_t half = doubtful_.back();
    doubtful_.pop_back();
    if (!may_flip(half) || !(gain_of_flip(half, 0) > 0)) return;
    const auto around = flip(half);
    doubtful_.insert(doubtful_.end(), around.begin(), around.end());
  }

  std::array<std::uint32_t, 5> flip(std::uint32_t half) {
    const auto [a, b, left, right] = half_edges_.diamond(half);
    const int level = edge(a, b).level;
    BentEdge& made = edge(left, right);
    made.was_in = true;
    made.level = level;
    return half_edges_.flip(half);
  }

  /// Whether an edge is off, nothing holds it, and the other diagonal would be a proper one. Where
  /// the smooth surface is comes last: that takes longest.
  [[nodiscard]] bool may_flip(std::uint32_t half) {
    const std::uint32_t twin = half_edges_.twin(half);
    if (twin == Origin::none) return false;
    const auto [a, b, left, right] = half_edges_.diamond(half);
    const auto& tiles = bent_.tiles.tiles;
    if (in_one_slice(a, b) || in_one_slice(left, right) || left == right ||
        tiles[half / 3].kind != tiles[twin / 3].kind || is_firm(a, b) || is_firm(left, right))
      return false;
    const double longest = most_of_diagonal * length(minus(place(b), place(a)));
    if (length(minus(place(right), place(left))) > longest || edge(a, b).loose < 1 ||
        edge(left, right).was_in)
      return false;
    return are_turned_alike({normal(a, b, left, false), normal(b, a, right, false)},
                            {normal(right, left, a, false), normal(left, right, b, false)}) &&
           are_turned_alike({normal(a, b, left, true), normal(b, a, right, true)},
                            {normal(right, left, a, true), normal(left, right, b, true)}) &&
           off(a, b, piece_[half / 3]) > least_off * height_;
  }

  [[nodiscard]] bool is_firm(std::uint32_t a, std::uint32_t b) const {
    return firm_[a] || firm_[b];
  }

  [[nodiscard]] Vec3 normal(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                            bool is_straight) const {
    const auto at = [&](std::uint32_t node) {
      return is_straight ? straight_place(node) : place(node);
    };
    return cross(minus(at(b), at(a)), minus(at(c), at(a)));
  }

  /// By how much nearer the other diagonal is, and better formed: by twice the area of the thinner
  /// triangle, over the square of its longest edge. Not looked into where it is `least` at most.
  [[nodiscard]] double gain_of_flip(std::uint32_t half, double least) {
    const auto [a, b, left, right] = half_edges_.diamond(half);
    const std::uint32_t piece = piece_[half / 3];
    const double form_before = worse_form({a, b, left}, {b, a, right});
    const double form_after = worse_form({right, left, a}, {left, right, b});
    const double most = off(a, b, piece) + worth_of_form * height_ * (form_after - form_before);
    return most > least ? most - off(left, right, piece) : most;
  }

  [[nodiscard]] double worse_form(const std::array<std::uint32_t, 3>& first,
                                  const std::array<std::uint32_t, 3>& second) const {
    const auto form_of = [&](const std::array<std::uint32_t, 3>& nodes) {
      const auto& [a, b, c] = nodes;
      return length(normal(a, b, c, false)) / squared_longest({place(a), place(b), place(c)});
    };
    return std::min(form_of(first), form_of(second));
  }

  // --- The places of vertices ---

  /// What is at an inner vertex.
  struct Around {
    Vec3 ways{};  // from the middles of edges to the smooth surface, added up
    double count = 0;
    double flattest = std::numeric_limits<double>::infinity();  // height of a tile
  };

  /// Moves each inner vertex by what the edges at it stay short.
  void go_beyond() {
    const std::vector<Around> around = look_around();
    for (std::uint32_t i = 0; i < around.size(); ++i) {
      VertexMove& move = bent_.moves[i];
      Vec3& there = bent_.tiles.inner[i].place;
      const auto& [ways, count, flattest] = around[i];
      const double most =
          std::min(most_of_tolerance * fineness_.tolerance, most_of_tile * flattest);
      const Vec3 beyond =
          count > 0 ? along(there, 1, cut_off(along({}, overshoot / count, ways), most)) : there;
      if (move.edge[0] != Origin::none)
        move.start = edge_middle(place(move.edge[0]), place(move.edge[1]));
      move.way = minus(between_slices(lower_.z, upper_.z, beyond, move.start[2]), move.start);
      there = along(move.start, 1, move.way);
    }
  }

  [[nodiscard]] std::vector<Around> look_around() {
    std::vector<Around> found(bent_.moves.size());
    for (std::uint32_t half = 0; half < half_edges_.count(); ++half) {
      const std::uint32_t a = half_edges_.from(half);
      const std::uint32_t b = half_edges_.to(half);
      const std::uint32_t c = half_edges_.apex(half);
      if (c >= contour_count_) {
        double& flattest = found[c - contour_count_].flattest;
        flattest = std::min(flattest, least_height({place(a), place(b), place(c)}));
      }
      const std::uint32_t twin = half_edges_.twin(half);
      if (twin == Origin::none || half > twin || std::max(a, b) < contour_count_) continue;
      off(a, b, piece_[half / 3]);
      const BentEdge& bent = edge(a, b);
      for (const std::uint32_t end : {a, b})
        if (end >= contour_count_) add(found[end - contour_count_], bent);
    }
    return found;
  }

  static void add(Around& around, const BentEdge& bent) {
    if (bent.off > 0) around.ways = along(around.ways, 1, bent.way);
    ++around.count;
  }

  const Region& lower_;
  const Region& upper_;
  BentTiles bent_;
  std::vector<std::uint32_t> piece_;  // of each tile
  SmoothTarget target_;
  Freedom freedom_;
  HalfEdges half_edges_;
  std::vector<bool> firm_;
  Fineness fineness_;
  double height_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
  std::uint32_t plain_bound_;  // of the nodes that the plain tiles have
  std::vector<Point> facing_;  // of each node: outwards as contours do there, or 0
  EdgeIndex index_;            // of edges: places in the next one
  std::vector<BentEdge> edges_;
  std::priority_queue<Candidate, std::vector<Candidate>, Nearer> queue_;
  std::vector<std::uint32_t> doubtful_;  // half-edges that may have to be flipped
};

}  // namespace

Fineness fineness(double height, std::optional<double> tolerance) {
  if (tolerance && *tolerance > 0)
    return {std::max(*tolerance, finest_share * height), most_levels, finest_nearness};
  return {usual_share * height, usual_levels, usual_nearness};
}

Fineness fork_fineness(double height) {
  return {fork_share * height, 1, fork_nearness, Bends::at_forks};
}

BentTiles bend(const BentSlab& slab, std::span<const OutlinePoint> outlines, const TileSet& plain,
               const Fineness& fineness, std::vector<bool> firm) {
  return Bending(slab, outlines, plain, fineness, std::move(firm)).run();
}

}  // namespace loft
