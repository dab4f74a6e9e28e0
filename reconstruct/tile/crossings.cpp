// SPDX-License-Identifier: MIT
#include "reconstruct/tile/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "cdt/effort.h"
#include "mesh/predicates.h"
#include "mesh/vec3.h"
#include "reconstruct/plane/tile_grid.h"
#include "reconstruct/tile/fan_change.h"
#include "reconstruct/tile/touching.h"

namespace loft {

namespace {

/// What a collapse may change, in units of what the slices change around the crossing: volume, by
/// the sheets' area times the slab's height, and the crossing's way aside, by the sheets' width.
/// Bars that turn would take up to 2.6 of the former, and become four times as large. Where sheets
/// are slivers, much narrower than the tiles are wide, little changes anyway: there unlike circles
/// take up to 0.7, to have no vertices but their own. No halves and wholes: many are just there.
constexpr double most_gain = 0.51;
constexpr double most_gain_of_slivers = 0.76;
constexpr double sliver = 1.0 / 32;
constexpr double most_drift = 0.9;

/// Of possible collapses the one with the best shapes is taken, but for the volume it should gain:
/// with a sixth of the sheets' area, which the tiles leave out before, the slab's volume is the
/// mean of its slices. Shapes are looked at as if the slab were half as high as the crossing's
/// tiles are wide. Found on those stacks: no weight, or three times that height, cost some 10%.
constexpr double fair_gain = 1.0 / 6;
constexpr double weight_of_gain = 0.5;
constexpr double looked_at_height = 0.5;

/// Below that a triangle is degenerate but for rounding.
constexpr double least_shape = 1e-20;

/// Bounds of the effort for one crossing: nodes around it, and targets tried.
constexpr std::size_t largest_link = 256;
constexpr std::size_t most_targets = 16;

/// And for all of them: pairs of triangles tested, for each crossing. Stacks of smooth shapes take
/// 30 to 50; where long thin triangles lie across thousands of others, what is left stays.
constexpr std::size_t most_tests = 500;
constexpr std::size_t least_tests = 100'000;

/// And triangles looked at for what they would change. Smooth shapes take some 100 a crossing;
/// beyond that, crossings are not looked at anew where those beside them went.
constexpr std::size_t most_looks = 2000;
constexpr std::size_t least_looks = 1'000'000;

/// A collapse may make room for another: that often all are tried.
constexpr int most_passes = 4;

using Nodes = std::array<std::uint32_t, 3>;

class Collapse {
 public:
  Collapse(const Region& lower, const Region& upper, TileSet& tiles, bool is_solid,
           std::optional<double> drift)
      : drift_(drift),
        tiles_(tiles.tiles),
        inner_(tiles.inner),
        reaches_(tiles.reaches),
        sign_(is_solid ? 1 : -1),
        lower_(lower),
        upper_(upper),
        lower_count_(static_cast<std::uint32_t>(lower.points.size())),
        contour_count_(lower_count_ + static_cast<std::uint32_t>(upper.points.size())),
        height_(upper.z - lower.z),
        contact_(contact(lower, upper)) {}

  /// False if the bounds of effort have decided something.
  bool run() {
    find_crossings();
    if (crossings_.empty()) return true;
    list_faces();
    std::erase_if(crossings_, [this](std::uint32_t p) { return slot_[p] == Origin::none; });
    measure_crossings();
    grid_.emplace(tiles_.size(), [this](std::uint32_t f) { return footprint(tiles_[f].nodes); });
    tests_left_ = least_tests + most_tests * crossings_.size();
    looks_left_ = least_looks + most_looks * crossings_.size();
    bool is_changed = true;
    for (int pass = 0; is_changed && pass < most_passes; ++pass) is_changed = collapse_all();
    compact();
    return tests_left_ > 0 && looks_left_ > 0;
  }

 private:
  /// A contour vertex to pull a crossing into.
  struct Target {
    double merit;
    std::size_t at;  // its place in the link
  };

  /// A crossing before its tiles are changed.
  struct Crossing {
    SheetsAround sheets;
    double most_gain = 0;
    double stretch = 1;     // of heights, to look at shapes
    std::size_t reach = 0;  // its place in reaches_
  };

  /// A crossing that can be collapsed, as far as its own tiles tell. The widest sheets come first:
  /// there is the most to gain, and the least to choose from once others are gone. Widths that
  /// differ by rounding are one; then the best goes first. So the order depends on places only
  /// where all else is the same, and turning a stack changes nothing.
  struct Waiting {
    float width;
    float merit;
    Vec3 place;
    std::uint32_t node;

    bool operator<(const Waiting& other) const {
      return std::tie(other.width, other.merit, place, node) <
             std::tie(width, merit, other.place, other.node);
    }
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
    slot_.assign(contour_count_ + inner_.size(), Origin::none);
    for (const Tile& tile : tiles_) {
      if (std::ranges::none_of(tile.nodes, [this](auto node) { return is_crossing(node); }))
        continue;
      for (const std::uint32_t node : tile.nodes) {
        if (slot_[node] != Origin::none) continue;
        slot_[node] = static_cast<std::uint32_t>(faces_.size());
        faces_.emplace_back();
      }
    }
    for (std::uint32_t f = 0; f < tiles_.size(); ++f)
      for (const std::uint32_t node : tiles_[f].nodes)
        if (slot_[node] != Origin::none) faces_[slot_[node]].push_back(f);
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

  /// Fans around p lie within the box of its link.
  void note_reach(std::uint32_t p) {
    Reach& reach = reaches_[measured(p).reach];
    for (const std::uint32_t node : link_) {
      const Vec3 place = this->place(node);
      reach.box.add({place[0], place[1]});
    }
  }

  /// A node twice in the link: the edge to it has more than two faces.
  [[nodiscard]] static bool are_different(std::vector<std::uint32_t> nodes) {
    std::ranges::sort(nodes);
    return std::ranges::adjacent_find(nodes) == nodes.end();
  }

  void measure_crossings() {
    measured_.resize(inner_.size());
    for (const std::uint32_t p : crossings_) {
      std::vector<Corners> around;
      for (const std::uint32_t face : faces_at(p)) around.push_back(places(tiles_[face].nodes));
      const SheetsAround sheets = sheets_around(p);
      const double wide = reach(place(p), around);
      const double share = sheets.width < sliver * wide ? most_gain_of_slivers : most_gain;
      measured(p) = {sheets, share * sheets.area, looked_at_height * wide / height_,
                     reaches_.size()};
      reaches_.push_back({{}, contour_vertex(p)});
    }
  }

  /// One of the contour vertices of the tiles around p.
  [[nodiscard]] std::uint32_t contour_vertex(std::uint32_t p) {
    std::uint32_t least = Origin::none;
    for (const std::uint32_t face : faces_at(p))
      for (const std::uint32_t node : tiles_[face].nodes) least = std::min(least, node);
    return least;
  }

  /// Sums are rounded in one order, whatever numbers the tiles have.
  [[nodiscard]] SheetsAround sheets_around(std::uint32_t p) {
    corners_.clear();
    for (const std::uint32_t face : faces_at(p)) {
      if (!drift_ && tiles_[face].kind != FaceKind::sheet) continue;
      std::ranges::sort(corners_.emplace_back(places(tiles_[face].nodes)));
    }
    std::ranges::sort(corners_);
    SheetsAround sheets;
    for (const Corners& sheet : corners_) sheets.add(sheet);
    return sheets;
  }

  [[nodiscard]] Crossing& measured(std::uint32_t p) { return measured_[p - contour_count_]; }

  /// Collapses what can be, each crossing with the tiles that those before it have left.
  bool collapse_all() {
    waiting_.assign(inner_.size(), std::nullopt);
    for (const std::uint32_t p : crossings_)
      if (slot_[p] != Origin::none) wait(p);
    bool is_changed = false;
    while (!queue_.empty() && tests_left_ > 0) {
      const std::uint32_t p = queue_.begin()->node;
      queue_.erase(queue_.begin());
      waiting_[p - contour_count_].reset();
      if (!collapse(p)) continue;
      is_changed = true;
      slot_[p] = Origin::none;
      const std::vector<std::uint32_t> around = link_;
      for (const std::uint32_t node : around)
        if (is_crossing(node) && looks_left_ > 0) wait(node);
    }
    queue_.clear();
    return is_changed;
  }

  /// Puts a crossing into the queue, or where it belongs now.
  void wait(std::uint32_t p) {
    auto& waiting = waiting_[p - contour_count_];
    if (waiting) queue_.erase(*waiting);
    waiting.reset();
    const std::vector<Target> targets = find_targets(p);
    if (targets.empty()) return;
    const auto width = static_cast<float>(measured(p).sheets.width);
    waiting = {width, static_cast<float>(targets.front().merit), place(p), p};
    queue_.insert(*waiting);
  }

  bool collapse(std::uint32_t p) {
    cdt::spend();
    for (const Target& target : find_targets(p)) {
      make_fan(target.at);
      if (meets_nothing(p)) {
        replace(p, link_[target.at]);
        return true;
      }
    }
    return false;
  }

  /// Among four nodes those that face each other make the same triangles; what kind these keep, and
  /// with it how wide sheets seem to be, must not depend on how the stack is turned.
  [[nodiscard]] std::tuple<float, bool, float, Vec3> rank(std::uint32_t p,
                                                          const Target& target) const {
    const std::uint32_t node = link_[target.at];
    const Vec3 way = minus(place(node), place(p));
    return {-static_cast<float>(target.merit), node >= lower_count_,
            static_cast<float>(std::hypot(way[0], way[1])), place(node)};
  }

  /// The contour vertices around p that it may be pulled into, best first, as far as the tiles at p
  /// tell.
  std::vector<Target> find_targets(std::uint32_t p) {
    std::vector<Target> targets;
    if (!find_link(p)) return targets;
    note_reach(p);
    cdt::spend(link_.size() * link_.size());  // a fan for each of its nodes
    for (std::size_t i = 0; i < link_.size(); ++i) {
      if (!is_contour(link_[i])) continue;
      looks_left_ -= std::min(looks_left_, faces_at(link_[i]).size());
      if (!keeps_topology(p, i)) continue;
      make_fan(i);
      looks_left_ -= std::min(looks_left_, fan_.size());
      if (const auto merit = this->merit(p)) targets.push_back({*merit, i});
    }
    std::ranges::sort(targets, {}, [&](const Target& target) { return rank(p, target); });
    if (targets.size() > most_targets) targets.resize(most_targets);
    return targets;
  }

  /// Of the fan in the place of the tiles at p; none if that would change too much.
  std::optional<double> merit(std::uint32_t p) {
    corners_.clear();
    for (const Nodes& nodes : fan_) corners_.push_back(places(nodes));
    const auto& [sheets, most, stretch, reach] = measured(p);
    const double gain = sign_ * gained_area(place(p), corners_, height_);
    if (!(std::abs(gain) <= most)) return std::nullopt;
    if (sideways_drift(place(p), corners_) > drift_.value_or(most_drift * sheets.width))
      return std::nullopt;
    const double shape = worst_shape(corners_, stretch);
    if (!(shape > least_shape)) return std::nullopt;
    const double off =
        sheets.area > 0 ? std::abs(gain / sheets.area - (drift_ ? 0 : fair_gain)) : 0;
    return shape * std::exp(-weight_of_gain * off);
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

  /// Whether the fan has no degenerate triangle and touches itself and the tiles, those at p left
  /// out, in common corners and edges only: exactly, and within rounding, so that it does not
  /// depend on how the stack is turned.
  [[nodiscard]] bool meets_nothing(std::uint32_t p) {
    for (std::size_t i = 0; i < fan_.size(); ++i) {
      const Corners corners = places(fan_[i]);
      if (collinear(corners[0], corners[1], corners[2])) return false;
      for (std::size_t j = 0; j < i; ++j)
        if (meet(p, corners, places(fan_[j]))) return false;
    }
    for (const Nodes& nodes : fan_) {
      const Corners corners = places(nodes);
      cdt::Box box = footprint(nodes);
      box = {{box.low.x - contact_, box.low.y - contact_},
             {box.high.x + contact_, box.high.y + contact_}};
      const bool is_free = grid_->all_of_near(box, [&](std::uint32_t face) {
        cdt::spend();
        if (tests_left_ == 0) return false;
        --tests_left_;
        const Nodes& other = tiles_[face].nodes;
        return is_dead(face) || std::ranges::find(other, p) != other.end() ||
               !meet(p, corners, places(other));
      });
      if (!is_free) return false;
    }
    return true;
  }

  [[nodiscard]] bool meet(std::uint32_t p, const Corners& a, const Corners& b) {
    return triangles_meet(a, b) || triangles_touch(stretched(p, a), stretched(p, b), contact_);
  }

  /// With heights as if the slab were about half as high as the tiles at p were wide.
  [[nodiscard]] Corners stretched(std::uint32_t p, Corners corners) {
    for (Vec3& place : corners) place[2] = (place[2] - lower_.z) * measured(p).stretch;
    return corners;
  }

  [[nodiscard]] bool is_dead(std::uint32_t face) const {
    return tiles_[face].nodes[0] == Origin::none;
  }

  /// Puts the fan in the place of the faces at p: two of them go, the others get v instead of p.
  void replace(std::uint32_t p, std::uint32_t v) {
    for (const std::uint32_t face : faces_at(p)) {
      Nodes& nodes = tiles_[face].nodes;
      if (std::ranges::find(nodes, v) != nodes.end()) {
        for (const std::uint32_t x : nodes)
          if (x != p) std::erase(faces_at(x), face);
        nodes[0] = Origin::none;
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
    std::erase_if(tiles_, [](const Tile& tile) { return tile.nodes[0] == Origin::none; });
    drop_unused_inner(tiles_, inner_, contour_count_);
  }

  std::optional<double> drift_;
  std::vector<Tile>& tiles_;
  std::vector<InnerVertex>& inner_;
  std::vector<Reach>& reaches_;
  double sign_;  // of volumes
  const Region& lower_;
  const Region& upper_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
  double height_;
  double contact_;  // what is nearer may meet by rounding
  std::vector<std::uint32_t> crossings_;
  std::vector<std::uint32_t> slot_;                // of each node in faces_, or none
  std::vector<std::vector<std::uint32_t>> faces_;  // at the nodes next to crossings
  std::optional<TileGrid> grid_;
  std::vector<std::uint32_t> link_;  // of the crossing at hand
  std::vector<Nodes> fan_;
  std::vector<Corners> corners_;                 // of the fan
  std::vector<Crossing> measured_;               // by inner vertex
  std::vector<std::optional<Waiting>> waiting_;  // by inner vertex
  std::set<Waiting> queue_;
  std::size_t tests_left_ = 0;
  std::size_t looks_left_ = 0;
};

}  // namespace

bool collapse_crossings(const Region& lower, const Region& upper, TileSet& tiles, bool is_solid,
                        std::optional<double> drift) {
  return Collapse(lower, upper, tiles, is_solid, drift).run();
}

}  // namespace loft
