// SPDX-License-Identifier: MIT
#include "reconstruct/tile/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "cdt/effort.h"
#include "mesh/predicates.h"
#include "mesh/vec3.h"
#include "reconstruct/plane/tile_grid.h"

namespace loft {

namespace {

/// How far from a collapsed crossing the new tiles may be, in heights of the slab. Without a bound
/// a stack with many handles lost a quarter of its accuracy.
constexpr double most_drift = 0.3;

/// Bounds of the effort for one crossing: nodes around it, and targets tried.
constexpr std::size_t largest_link = 256;
constexpr std::size_t most_targets = 16;

/// And for all of them: pairs of triangles tested, for each crossing. Stacks of smooth shapes take
/// 30 to 50; where long thin triangles lie across thousands of others, what is left stays.
constexpr std::size_t most_tests = 500;
constexpr std::size_t least_tests = 100'000;

/// A collapse may make room for another: that often all are tried.
constexpr int most_passes = 4;

constexpr std::uint32_t none = Origin::none;

using Nodes = std::array<std::uint32_t, 3>;

double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = minus(b, a);
  const double length = dot(way, way);
  const double t = length > 0 ? std::clamp(dot(minus(p, a), way) / length, 0.0, 1.0) : 0.0;
  return squared_length(minus(p, along(a, t, way)));
}

/// From a point to a triangle: to its plane if the foot is inside, else to its nearest edge.
double squared_distance(const Vec3& p, const Corners& t) {
  const Vec3 u = minus(t[1], t[0]);
  const Vec3 v = minus(t[2], t[0]);
  const Vec3 w = minus(p, t[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double determinant = uu * vv - uv * uv;
  if (determinant > 0) {
    const double s = (wu * vv - wv * uv) / determinant;
    const double r = (wv * uu - wu * uv) / determinant;
    if (s >= 0 && r >= 0 && s + r <= 1) {
      const Vec3 off{w[0] - s * u[0] - r * v[0], w[1] - s * u[1] - r * v[1],
                     w[2] - s * u[2] - r * v[2]};
      return dot(off, off);
    }
  }
  return std::min({squared_distance(p, t[0], t[1]), squared_distance(p, t[1], t[2]),
                   squared_distance(p, t[2], t[0])});
}

/// Squared: area over the sum of the squared sides; largest for equal sides, 0 if degenerate.
double shape(const Corners& t) {
  const Vec3 u = minus(t[1], t[0]);
  const Vec3 v = minus(t[2], t[0]);
  const Vec3 w = minus(t[2], t[1]);
  const double sides = dot(u, u) + dot(v, v) + dot(w, w);
  return (dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v)) / (sides * sides);
}

class Collapse {
 public:
  Collapse(const Region& lower, const Region& upper, TileSet& tiles)
      : tiles_(tiles.tiles),
        inner_(tiles.inner),
        lower_(lower),
        upper_(upper),
        lower_count_(static_cast<std::uint32_t>(lower.points.size())),
        contour_count_(lower_count_ + static_cast<std::uint32_t>(upper.points.size())),
        most_squared_drift_(std::pow(most_drift * (upper.z - lower.z), 2)) {}

  void run() {
    find_crossings();
    if (crossings_.empty()) return;
    list_faces();
    std::erase_if(crossings_, [this](std::uint32_t p) { return slot_[p] == none; });
    grid_.emplace(tiles_.size(), [this](std::uint32_t f) { return footprint(tiles_[f].nodes); });
    tests_left_ = least_tests + most_tests * crossings_.size();
    bool is_changed = true;
    for (int pass = 0; is_changed && pass < most_passes; ++pass) {
      is_changed = false;
      for (std::uint32_t& p : crossings_) {
        if (p == none || tests_left_ == 0 || !collapse(p)) continue;
        p = none;
        is_changed = true;
      }
    }
    compact();
  }

 private:
  /// A contour vertex to pull a crossing into.
  struct Target {
    double shape;    // of the worst triangle that it makes
    std::size_t at;  // its place in the link
  };

  void find_crossings() {
    for (std::uint32_t i = 0; i < inner_.size(); ++i)
      if (inner_[i].kind == VertexKind::crossing) crossings_.push_back(contour_count_ + i);
    std::ranges::sort(crossings_, {}, [this](std::uint32_t node) { return place(node); });
  }

  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, inner_, node);
  }

  [[nodiscard]] Corners places(const Nodes& nodes) const {
    return {place(nodes[0]), place(nodes[1]), place(nodes[2])};
  }

  [[nodiscard]] cdt::Box footprint(const Nodes& nodes) const {
    return loft::footprint(places(nodes));
  }

  [[nodiscard]] bool is_contour(std::uint32_t node) const { return node < contour_count_; }
  [[nodiscard]] bool is_crossing(std::uint32_t node) const {
    return node >= contour_count_ && inner_[node - contour_count_].kind == VertexKind::crossing;
  }
  /// Whether both are contour vertices of the same slice.
  [[nodiscard]] bool in_one_slice(std::uint32_t a, std::uint32_t b) const {
    return is_contour(a) && is_contour(b) && (a < lower_count_) == (b < lower_count_);
  }

  /// The faces at every node next to a crossing: nothing else can change.
  void list_faces() {
    slot_.assign(contour_count_ + inner_.size(), none);
    for (const Tile& tile : tiles_) {
      if (std::ranges::none_of(tile.nodes, [this](auto node) { return is_crossing(node); }))
        continue;
      for (const std::uint32_t node : tile.nodes) {
        if (slot_[node] != none) continue;
        slot_[node] = static_cast<std::uint32_t>(faces_.size());
        faces_.emplace_back();
      }
    }
    for (std::uint32_t f = 0; f < tiles_.size(); ++f)
      for (const std::uint32_t node : tiles_[f].nodes)
        if (slot_[node] != none) faces_[slot_[node]].push_back(f);
  }

  [[nodiscard]] std::vector<std::uint32_t>& faces_at(std::uint32_t node) {
    return faces_[slot_[node]];
  }

  /// The nodes around p in order, if its faces make one closed fan.
  bool find_link(std::uint32_t p) {
    link_.clear();
    const auto& faces = faces_at(p);
    if (faces.size() > largest_link) return false;
    const auto ahead = [&](std::uint32_t face) {  // the edge opposite to p
      const Nodes& n = tiles_[face].nodes;
      const unsigned i = n[0] == p ? 0 : n[1] == p ? 1 : 2;
      return std::pair{n[(i + 1) % 3], n[(i + 2) % 3]};
    };
    const auto [first, second] = ahead(faces.front());
    link_ = {first, second};
    while (link_.back() != first) {
      const auto found = std::ranges::find_if(
          faces, [&](std::uint32_t face) { return ahead(face).first == link_.back(); });
      if (found == faces.end() || link_.size() > faces.size()) return false;
      link_.push_back(ahead(*found).second);
    }
    link_.pop_back();
    return link_.size() == faces.size() && link_.size() >= 3 && are_different(link_);
  }

  /// A node twice in the link: the edge to it has more than two faces.
  [[nodiscard]] static bool are_different(std::vector<std::uint32_t> nodes) {
    std::ranges::sort(nodes);
    return std::ranges::adjacent_find(nodes) == nodes.end();
  }

  bool collapse(std::uint32_t p) {
    cdt::spend();
    if (!find_link(p)) return false;
    cdt::spend(link_.size() * link_.size());  // a fan for each of its nodes
    std::vector<Target> targets;
    for (std::size_t i = 0; i < link_.size(); ++i) {
      if (!is_contour(link_[i]) || !keeps_topology(p, i)) continue;
      make_fan(i);
      if (squared_drift(p) <= most_squared_drift_) targets.push_back({worst_shape(), i});
    }
    std::ranges::sort(targets, [this](const Target& a, const Target& b) {
      if (a.shape != b.shape) return a.shape > b.shape;
      return place(link_[a.at]) < place(link_[b.at]);
    });
    if (targets.size() > most_targets) targets.resize(most_targets);
    for (const Target& target : targets) {
      make_fan(target.at);
      if (meets_nothing(p)) {
        replace(p, link_[target.at]);
        return true;
      }
    }
    return false;
  }

  /// The link condition (Dey, Edelsbrunner, Guha, Nekhayev, 1999), and no new edge within a slice
  /// plane: v has no common neighbour with p besides the two at the edge between them.
  [[nodiscard]] bool keeps_topology(std::uint32_t p, std::size_t at) {
    const std::size_t n = link_.size();
    const std::uint32_t v = link_[at];
    const std::uint32_t before = link_[(at + n - 1) % n];
    const std::uint32_t after = link_[(at + 1) % n];
    if (n == 3 && in_one_slice(v, before) && in_one_slice(v, after)) return false;
    const auto is_new = [&](std::uint32_t x) { return x != v && x != before && x != after; };
    for (const std::uint32_t x : link_)
      if (is_new(x) && in_one_slice(x, v)) return false;
    for (const std::uint32_t face : faces_at(v)) {
      const Nodes& nodes = tiles_[face].nodes;
      if (std::ranges::find(nodes, p) != nodes.end()) continue;
      for (const std::uint32_t x : nodes)
        if (is_new(x) && std::ranges::find(link_, x) != link_.end()) return false;
    }
    return true;
  }

  /// The triangles that the link makes with its node `at`.
  void make_fan(std::size_t at) {
    fan_.clear();
    const std::size_t n = link_.size();
    for (std::size_t i = 1; i + 1 < n; ++i)
      fan_.push_back({link_[at], link_[(at + i) % n], link_[(at + i + 1) % n]});
  }

  /// How far the fan is from the crossing's old place.
  [[nodiscard]] double squared_drift(std::uint32_t p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Nodes& nodes : fan_)
      least = std::min(least, squared_distance(place(p), places(nodes)));
    return least;
  }

  [[nodiscard]] double worst_shape() const {
    double worst = std::numeric_limits<double>::infinity();
    for (const Nodes& nodes : fan_) worst = std::min(worst, shape(places(nodes)));
    return worst;
  }

  /// Whether the fan has no degenerate triangle and touches itself and the tiles, those at p left
  /// out, in common corners and edges only.
  [[nodiscard]] bool meets_nothing(std::uint32_t p) {
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      const Corners corners = places(fan_[i]);
      if (collinear(corners[0], corners[1], corners[2])) return false;
      for (std::size_t j = 0; j < i; ++j)
        if (triangles_meet(corners, places(fan_[j]))) return false;
    }
    for (const Nodes& nodes : fan_) {
      const Corners corners = places(nodes);
      const bool is_free = grid_->all_of_near(footprint(nodes), [&](std::uint32_t face) {
        if (tests_left_ == 0) return false;
        --tests_left_;
        const Nodes& other = tiles_[face].nodes;
        return is_dead(face) || std::ranges::find(other, p) != other.end() ||
               !triangles_meet(corners, places(other));
      });
      if (!is_free) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_dead(std::uint32_t face) const { return tiles_[face].nodes[0] == none; }

  /// Puts the fan in the place of the faces at p: two of them go, the others get v instead of p.
  void replace(std::uint32_t p, std::uint32_t v) {
    for (const std::uint32_t face : faces_at(p)) {
      Nodes& nodes = tiles_[face].nodes;
      if (std::ranges::find(nodes, v) != nodes.end()) {
        for (const std::uint32_t x : nodes)
          if (x != p) std::erase(faces_at(x), face);
        nodes[0] = none;
      } else {
        std::ranges::replace(nodes, p, v);
        faces_at(v).push_back(face);
        grid_->add(face, footprint(nodes));
      }
    }
    faces_at(p).clear();
  }

  /// Drops dead tiles and the inner vertices that no tile uses.
  void compact() {
    std::erase_if(tiles_, [](const Tile& tile) { return tile.nodes[0] == none; });
    drop_unused_inner(tiles_, inner_, contour_count_);
  }

  std::vector<Tile>& tiles_;
  std::vector<InnerVertex>& inner_;
  const Region& lower_;
  const Region& upper_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
  double most_squared_drift_;
  std::vector<std::uint32_t> crossings_;
  std::vector<std::uint32_t> slot_;                // of each node in faces_, or none
  std::vector<std::vector<std::uint32_t>> faces_;  // at the nodes next to crossings
  std::optional<TileGrid> grid_;
  std::vector<std::uint32_t> link_;  // of the crossing at hand
  std::vector<Nodes> fan_;
  std::size_t tests_left_ = 0;
};

}  // namespace

void collapse_crossings(const Region& lower, const Region& upper, TileSet& tiles) {
  Collapse(lower, upper, tiles).run();
}

}  // namespace loft
