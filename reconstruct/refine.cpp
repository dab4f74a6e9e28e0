// SPDX-License-Identifier: MIT
#include "reconstruct/refine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <queue>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cdt/expansion.h"
#include "reconstruct/defect.h"
#include "reconstruct/predicates.h"
#include "reconstruct/tile_grid.h"
#include "reconstruct/triangle_shape.h"
#include "reconstruct/vec3.h"

namespace loft {

namespace {

/// Edges longer than that, in target lengths, are split, shorter ones collapsed: what comes of it is
/// then nearer to the target (Botsch and Kobbelt, 2004).
constexpr double most_of_target = 4.0 / 3;
constexpr double least_of_target = 4.0 / 5;

/// Cosine of the most that the normals of changed triangles may differ: 10 degrees. With 15 the
/// surface moved by twice as much, for angles that were hardly better; with 5 they were worse.
constexpr double least_cosine = 0.985;

/// A collapse may leave no worse angle than it finds, or than this sine: 20 degrees.
constexpr double good_sine = 0.34;

/// Each step makes room for others: that often all are tried. After five rounds little changes.
constexpr int most_rounds = 5;

constexpr std::uint32_t none = Origin::none;

/// More vertices in one slab are taken for a mistake.
constexpr double most_vertices = 0x1p28;

using Nodes = std::array<std::uint32_t, 3>;

/// The faces of a slab, to be split and flipped.
class Refinement {
 public:
  Refinement(const Region& lower, const Region& upper, TileSet& tiles)
      : tiles_(tiles.tiles),
        inner_(tiles.inner),
        lower_(lower),
        upper_(upper),
        lower_count_(static_cast<std::uint32_t>(lower.points.size())),
        contour_count_(lower_count_ + static_cast<std::uint32_t>(upper.points.size())),
        first_added_(contour_count_ + static_cast<std::uint32_t>(inner_.size())) {
    index_faces();
  }

  /// Splits edges longer than `most`, as far as they are the longest of their faces. Whether any.
  bool split_longer_than(double most) {
    check_size(most);
    squared_most_ = most * most;
    for (const Edge& edge : all_edges()) enqueue(edge.from, edge.to);
    bool is_changed = false;
    while (!long_edges_.empty()) {
      const Edge edge = long_edges_.top();
      long_edges_.pop();
      find_sides(edge.from, edge.to);
      is_changed = (is_longest(edge) && split(edge)) || is_changed;
    }
    return is_changed;
  }

  /// Flips inner edges for better angles, none into an edge longer than `most`. Whether any.
  bool flip(double most) {
    squared_most_ = most * most;
    std::vector<Edge> edges = all_edges();
    std::ranges::sort(edges, [this](const Edge& a, const Edge& b) { return is_longer(a, b); });
    doubtful_.assign(edges.rbegin(), edges.rend());
    bool is_changed = false;
    while (!doubtful_.empty()) {
      const Edge edge = doubtful_.back();
      doubtful_.pop_back();
      find_sides(edge.from, edge.to);
      is_changed = flip(edge) || is_changed;
    }
    return is_changed;
  }

  /// Collapses edges shorter than `least` into one end where the other is an added vertex, as long
  /// as no edge gets longer than `most`. Whether any.
  bool collapse(double least, double most) {
    squared_most_ = most * most;
    std::vector<Edge> edges = all_edges();
    std::erase_if(edges, [=](const Edge& e) { return e.squared_length >= least * least; });
    std::ranges::sort(edges, [this](const Edge& a, const Edge& b) { return is_longer(b, a); });
    bool is_changed = false;
    for (const Edge& e : edges)
      if (collapse(e.from, e.to) || collapse(e.to, e.from)) is_changed = true;
    if (is_changed) compact();
    return is_changed;
  }

  /// Moves each added vertex to the middle of its neighbours, along the surface, where that makes
  /// the smallest angle at it larger and no edge longer than `most`.
  void relax(double most) {
    squared_most_ = most * most;
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t node = first_added_; node < faces_.size(); ++node) nodes.push_back(node);
    std::ranges::sort(nodes, {}, [this](std::uint32_t node) { return place(node); });
    for (const std::uint32_t node : nodes) relax_node(node);
  }

  /// All four; whether anything has changed.
  bool even_out(double target, double angle) { least_cosine_=std::cos(angle);
    const double most = most_of_target * target;
    const bool is_split = split_longer_than(most);
    const bool is_collapsed = collapse(least_of_target * target, most);
    const bool is_flipped = flip(most);
    relax(most);
    return is_split || is_collapsed || is_flipped;
  }

  double longest_edge() const { double r = 0; for (const Edge& e : all_edges()) r = std::max(r, std::sqrt(e.squared_length)); return r; }

 private:
  /// An inner edge, from the end of the smaller place.
  struct Edge {
    double squared_length;
    std::uint32_t from;
    std::uint32_t to;
  };
  /// A face at an edge, and its corner across from it.
  struct EdgeFace {
    std::uint32_t face;
    std::uint32_t apex;
  };
  struct Shorter {
    const Refinement* refinement;
    bool operator()(const Edge& a, const Edge& b) const { return refinement->is_longer(b, a); }
  };

  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, inner_, node);
  }
  [[nodiscard]] Corners places(const Nodes& nodes) const {
    return {place(nodes[0]), place(nodes[1]), place(nodes[2])};
  }
  [[nodiscard]] static cdt::Box footprint(const Corners& corners) {
    cdt::Box box;
    for (const Vec3& p : corners) box.add({p[0], p[1]});
    return box;
  }

  /// Contour edges, which neighbouring slabs share, are those between nodes of one slice; where
  /// rounding has left another edge in a slice plane, it stays as well.
  [[nodiscard]] bool in_one_slice(std::uint32_t a, std::uint32_t b) const {
    return a < contour_count_ && b < contour_count_ && (a < lower_count_) == (b < lower_count_);
  }

  [[nodiscard]] Edge edge(std::uint32_t a, std::uint32_t b) const {
    if (place(b) < place(a)) std::swap(a, b);
    return {squared_length(minus(place(b), place(a))), a, b};
  }

  /// By length, those of the same length by place: a total order that numbers have no part in.
  [[nodiscard]] bool is_longer(const Edge& a, const Edge& b) const {
    if (a.squared_length != b.squared_length) return a.squared_length > b.squared_length;
    if (a.from != b.from) return place(a.from) < place(b.from);
    return place(a.to) < place(b.to);
  }

  /// The inner edges, each once.
  [[nodiscard]] std::vector<Edge> all_edges() const {
    std::vector<Edge> edges;
    std::vector<std::uint32_t> ends;
    for (std::uint32_t node = 0; node < faces_.size(); ++node) {
      ends.clear();
      for (const std::uint32_t face : faces_[node])
        for (const std::uint32_t end : tiles_[face].nodes)
          if (end > node && !in_one_slice(node, end)) ends.push_back(end);
      std::ranges::sort(ends);
      ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
      for (const std::uint32_t end : ends) edges.push_back(edge(node, end));
    }
    return edges;
  }

  /// Finds the faces at an edge.
  void find_sides(std::uint32_t a, std::uint32_t b) {
    sides_.clear();
    if (faces_[b].size() < faces_[a].size()) std::swap(a, b);
    for (const std::uint32_t face : faces_[a]) {
      const Nodes& nodes = tiles_[face].nodes;
      if (std::ranges::find(nodes, b) == nodes.end()) continue;
      const auto apex = std::ranges::find_if(nodes, [=](auto n) { return n != a && n != b; });
      sides_.push_back({face, *apex});
    }
  }

  void index_faces() {
    faces_.assign(contour_count_ + inner_.size(), {});
    for (std::uint32_t f = 0; f < tiles_.size(); ++f)
      for (const std::uint32_t node : tiles_[f].nodes) faces_[node].push_back(f);
    build_grid();
  }

  /// The grid's cells fit the faces of the time when it was made.
  void build_grid() {
    grid_.emplace(tiles_.size(),
                  [this](std::uint32_t f) { return footprint(places(tiles_[f].nodes)); });
    built_for_ = tiles_.size();
  }

  [[nodiscard]] bool is_side(std::uint32_t face) const {
    return std::ranges::any_of(sides_, [=](const EdgeFace& side) { return side.face == face; });
  }

  /// Whether triangles to come in the place of the faces in sides_ have an area, and touch each
  /// other and all other faces in common corners and edges only (exact).
  [[nodiscard]] bool meet_nothing(const std::vector<Nodes>& triangles) {
    corners_.clear();
    for (const Nodes& nodes : triangles) {
      const Corners corners = places(nodes);
      if (collinear(corners[0], corners[1], corners[2])) return false;
      for (const Corners& other : corners_)
        if (triangles_meet(corners, other)) return false;
      corners_.push_back(corners);
    }
    return std::ranges::all_of(corners_, [this](const Corners& corners) {
      return grid_->all_of_near(footprint(corners), [&](std::uint32_t face) {
        return is_dead(face) || is_side(face) || !triangles_meet(corners, places(tiles_[face].nodes));
      });
    });
  }

  [[nodiscard]] bool is_dead(std::uint32_t face) const { return tiles_[face].nodes[0] == none; }

  void replace_face(std::uint32_t face, const Nodes& nodes) {
    for (const std::uint32_t node : tiles_[face].nodes) std::erase(faces_[node], face);
    tiles_[face].nodes = nodes;
    for (const std::uint32_t node : nodes) faces_[node].push_back(face);
  }

  // --- Splits ---

  /// Each vertex takes about half the squared length of the longest edge.
public:  void check_size(double most) const {
    double area = 0;
    for (const Tile& tile : tiles_) {
      const auto [a, b, c] = places(tile.nodes);
      area += std::sqrt(squared_length(cross(minus(b, a), minus(c, a)))) / 2;
    }
    if (area / (most * most) > most_vertices)
      throw InputError("edges that short would make more than " +
                       std::to_string(static_cast<long long>(most_vertices)) +
                       " triangles in one slab; choose a larger length");
  }

  void enqueue(std::uint32_t a, std::uint32_t b) {
    const Edge e = edge(a, b);
    if (e.squared_length > squared_most_) long_edges_.push(e);
  }

  /// Whether no face in sides_ has a longer edge. A longer one comes first, so it is one that stays.
  [[nodiscard]] bool is_longest(const Edge& e) const {
    return !sides_.empty() && std::ranges::all_of(sides_, [&](const EdgeFace& side) {
      return is_longer(e, edge(e.from, side.apex)) && is_longer(e, edge(side.apex, e.to));
    });
  }

  /// Puts a vertex in the middle of an edge with the faces in sides_, and an edge from it to the
  /// apex of each.
  bool split(const Edge& e) {
    const Vec3 p = place(e.from);
    const Vec3 q = place(e.to);
    const Vec3 middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
    if (!is_between(middle, p, q)) return false;
    const auto node = static_cast<std::uint32_t>(faces_.size());
    inner_.push_back({middle, VertexKind::steiner});
    faces_.emplace_back();
    new_faces_.clear();
    for (const EdgeFace& side : sides_) {
      for (const std::uint32_t end : {e.from, e.to}) {
        Nodes nodes = tiles_[side.face].nodes;
        std::ranges::replace(nodes, end, node);
        new_faces_.push_back(nodes);
      }
    }
    if (!is_exact(middle, p, q) && !meet_nothing(new_faces_)) {
      inner_.pop_back();
      faces_.pop_back();
      return false;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const auto added = static_cast<std::uint32_t>(tiles_.size());
      tiles_.push_back({new_faces_[2 * i + 1], tiles_[sides_[i].face].kind});
      for (const std::uint32_t corner : tiles_[added].nodes) faces_[corner].push_back(added);
      replace_face(sides_[i].face, new_faces_[2 * i]);
      grid_->add(added, footprint(places(tiles_[added].nodes)));
    }
    enqueue(e.from, node);
    enqueue(node, e.to);
    for (const EdgeFace& side : sides_) enqueue(node, side.apex);
    if (tiles_.size() > 4 * built_for_) build_grid();
    return true;
  }

  /// Whether rounding has left a middle its own place, off the slice planes.
  [[nodiscard]] bool is_between(const Vec3& middle, const Vec3& p, const Vec3& q) const {
    return middle != p && middle != q && middle[2] > lower_.z && middle[2] < upper_.z;
  }

  /// Whether a middle is not rounded: then its faces cover what the old ones did, and nothing new
  /// can meet.
  [[nodiscard]] static bool is_exact(const Vec3& middle, const Vec3& p, const Vec3& q) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto sum = cdt::two_sum(p[axis], q[axis]);
      if (sum.low != 0 || middle[axis] != sum.high / 2) return false;
    }
    return true;
  }

  // --- Flips ---

  /// Puts the other diagonal of the two faces in sides_ in the place of an edge.
  bool flip(const Edge& e) {
    if (sides_.size() != 2 || tiles_[sides_[0].face].kind != tiles_[sides_[1].face].kind)
      return false;
    const auto [left, right] = ordered_sides(e);
    const std::uint32_t c = left.apex;
    const std::uint32_t d = right.apex;
    if (c == d || in_one_slice(c, d)) return false;
    const double squared = squared_length(minus(place(c), place(d)));
    if (squared > squared_most_ && squared >= e.squared_length) return false;
    const std::array old_faces{Nodes{e.from, e.to, c}, Nodes{e.to, e.from, d}};
    const std::array new_faces{Nodes{c, d, e.to}, Nodes{d, c, e.from}};
    if (!(worst_sine(new_faces) > worst_sine(old_faces)) || !is_flat(old_faces, new_faces) ||
        are_joined(c, d))
      return false;
    new_faces_.assign(new_faces.begin(), new_faces.end());
    if (!meet_nothing(new_faces_)) return false;
    replace_face(left.face, new_faces[0]);
    replace_face(right.face, new_faces[1]);
    for (const EdgeFace& side : {left, right})
      grid_->add(side.face, footprint(places(tiles_[side.face].nodes)));
    for (const auto& [a, b] : {std::pair{e.from, c}, std::pair{c, e.to}, std::pair{e.to, d},
                               std::pair{d, e.from}})
      if (!in_one_slice(a, b)) doubtful_.push_back(edge(a, b));
    return true;
  }

  /// The face that runs along the edge, and the one that runs against it.
  [[nodiscard]] std::pair<EdgeFace, EdgeFace> ordered_sides(const Edge& e) const {
    const Nodes& nodes = tiles_[sides_[0].face].nodes;
    const auto from = static_cast<std::size_t>(std::ranges::find(nodes, e.from) - nodes.begin());
    return nodes[(from + 1) % 3] == e.to ? std::pair{sides_[0], sides_[1]}
                                         : std::pair{sides_[1], sides_[0]};
  }

  [[nodiscard]] double worst_sine(std::span<const Nodes> faces) const {
    double worst = 1;
    for (const Nodes& nodes : faces) worst = std::min(worst, smallest_sine(places(nodes)));
    return worst;
  }

  [[nodiscard]] Vec3 normal(const Nodes& nodes) const {
    Corners corners = places(nodes);
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    const auto& [a, b, c] = corners;
    return cross(minus(b, a), minus(c, a));
  }

  [[nodiscard]] bool are_alike(const Vec3& a, const Vec3& b) const {
    return dot(a, b) >= least_cosine_ * std::sqrt(squared_length(a) * squared_length(b));
  }

  [[nodiscard]] bool is_flat(const std::array<Nodes, 2>& old_faces,
                             const std::array<Nodes, 2>& new_faces) const {
    const std::array normals{normal(old_faces[0]), normal(old_faces[1]), normal(new_faces[0]),
                             normal(new_faces[1])};
    for (std::size_t i = 0; i < normals.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!are_alike(normals[i], normals[j])) return false;
    return true;
  }

  [[nodiscard]] bool are_joined(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::any_of(faces_[a], [&](std::uint32_t face) {
      const Nodes& nodes = tiles_[face].nodes;
      return std::ranges::find(nodes, b) != nodes.end();
    });
  }

  // --- Collapses and moves ---

  /// Finds the faces at an added node and, in order, the nodes around it; whether they are one
  /// closed fan.
  bool find_fan(std::uint32_t node) {
    sides_.clear();
    link_.clear();
    const std::vector<std::uint32_t>& faces = faces_[node];
    if (faces.size() < 3) return false;
    const auto across = [&](std::uint32_t face) {  // the edge opposite to the node
      const Nodes& n = tiles_[face].nodes;
      const unsigned i = n[0] == node ? 0 : n[1] == node ? 1 : 2;
      return std::pair{n[(i + 1) % 3], n[(i + 2) % 3]};
    };
    std::uint32_t next = across(faces.front()).first;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const auto found = std::ranges::find_if(
          faces, [&](std::uint32_t face) { return across(face).first == next; });
      if (found == faces.end() || std::ranges::find(link_, next) != link_.end()) return false;
      link_.push_back(next);
      next = across(*found).second;
      sides_.push_back({*found, next});
    }
    if (next != link_.front()) return false;
    // Sums over the fan are rounded in one order, whatever the numbers.
    const auto first = std::ranges::min_element(
        link_, {}, [this](std::uint32_t other) { return place(other); });
    const auto turn = first - link_.begin();
    std::rotate(link_.begin(), link_.begin() + turn, link_.end());
    std::rotate(sides_.begin(), sides_.begin() + turn, sides_.end());
    return true;
  }

  /// Moves an added node into a neighbour: the two faces at the edge between them vanish.
  bool collapse(std::uint32_t node, std::uint32_t target) {
    if (node < first_added_ || !find_fan(node)) return false;
    const auto found = std::ranges::find(link_, target);
    if (found == link_.end()) return false;
    const auto at = static_cast<std::size_t>(found - link_.begin());
    if (!may_join(at)) return false;
    old_faces_.clear();
    new_faces_.clear();
    for (const EdgeFace& side : sides_) {
      Nodes nodes = tiles_[side.face].nodes;
      old_faces_.push_back(nodes);
      if (std::ranges::find(nodes, target) != nodes.end()) continue;
      const Vec3 old_normal = normal(nodes);
      std::ranges::replace(nodes, node, target);
      if (!are_alike(old_normal, normal(nodes))) return false;
      new_faces_.push_back(nodes);
    }
    if (worst_sine(new_faces_) < std::min(worst_sine(old_faces_), good_sine) ||
        !meet_nothing(new_faces_))
      return false;
    for (const EdgeFace& side : sides_) {
      Nodes nodes = tiles_[side.face].nodes;
      if (std::ranges::find(nodes, target) != nodes.end()) {
        for (const std::uint32_t corner : nodes) std::erase(faces_[corner], side.face);
        tiles_[side.face].nodes[0] = none;
      } else {
        std::ranges::replace(nodes, node, target);
        replace_face(side.face, nodes);
        grid_->add(side.face, footprint(places(nodes)));
      }
    }
    return true;
  }

  /// Whether the neighbour `at` can be joined with all others around the node: by edges that are
  /// new (the link condition), not too long, and not in a slice plane.
  [[nodiscard]] bool may_join(std::size_t at) const {
    const std::size_t n = link_.size();
    const std::uint32_t target = link_[at];
    for (std::size_t i = 2; i + 1 < n; ++i) {
      const std::uint32_t other = link_[(at + i) % n];
      if (in_one_slice(target, other) || are_joined(target, other) ||
          squared_length(minus(place(other), place(target))) > squared_most_)
        return false;
    }
    return n > 3;
  }

  void relax_node(std::uint32_t node) {
    if (!find_fan(node)) return;
    Vec3& at = inner_[node - contour_count_].place;
    const Vec3 old_place = at;
    new_faces_.clear();
    for (const EdgeFace& side : sides_) new_faces_.push_back(tiles_[side.face].nodes);
    std::vector<Vec3> normals;
    for (const Nodes& nodes : new_faces_) normals.push_back(normal(nodes));
    const double old_sine = worst_sine(new_faces_);
    at = middle_of_link(old_place, normals);
    if (keeps_lengths(old_place, at) && at[2] > lower_.z && at[2] < upper_.z &&
        worst_sine(new_faces_) > old_sine && keeps_normals(normals) && meet_nothing(new_faces_)) {
      for (const EdgeFace& side : sides_)
        grid_->add(side.face, footprint(places(tiles_[side.face].nodes)));
    } else {
      at = old_place;
    }
  }

  /// The middle of the nodes around a place, in the plane through it across the mean normal.
  [[nodiscard]] Vec3 middle_of_link(const Vec3& from, std::span<const Vec3> normals) const {
    Vec3 way{};
    for (const std::uint32_t other : link_)
      for (std::size_t axis = 0; axis < 3; ++axis)
        way[axis] += (place(other)[axis] - from[axis]) / static_cast<double>(link_.size());
    Vec3 mean{};
    for (const Vec3& n : normals)
      for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += n[axis];
    const double share = dot(way, mean) / squared_length(mean);
    return {from[0] + way[0] - share * mean[0], from[1] + way[1] - share * mean[1],
            from[2] + way[2] - share * mean[2]};
  }

  /// Whether no edge to the nodes around gets longer than allowed, or than it was.
  [[nodiscard]] bool keeps_lengths(const Vec3& from, const Vec3& to) const {
    return std::ranges::all_of(link_, [&](std::uint32_t other) {
      const double squared = squared_length(minus(place(other), to));
      return squared <= squared_most_ || squared <= squared_length(minus(place(other), from));
    });
  }

  [[nodiscard]] bool keeps_normals(std::span<const Vec3> normals) const {
    for (std::size_t i = 0; i < normals.size(); ++i)
      if (!are_alike(normals[i], normal(new_faces_[i]))) return false;
    return true;
  }

  /// Drops dead tiles and the added vertices that no tile uses.
  void compact() {
    std::erase_if(tiles_, [](const Tile& tile) { return tile.nodes[0] == none; });
    std::vector<std::uint32_t> renumbered(faces_.size());
    std::uint32_t count = 0;
    for (std::uint32_t node = 0; node < faces_.size(); ++node) {
      if (node >= first_added_ && faces_[node].empty()) continue;
      if (node >= contour_count_) inner_[count - contour_count_] = inner_[node - contour_count_];
      renumbered[node] = count++;
    }
    inner_.resize(count - contour_count_);
    for (Tile& tile : tiles_)
      for (std::uint32_t& node : tile.nodes) node = renumbered[node];
    index_faces();
  }

  std::vector<Tile>& tiles_;
  std::vector<InnerVertex>& inner_;
  const Region& lower_;
  const Region& upper_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
  std::uint32_t first_added_;                      // the first node that was not there before
  std::vector<std::vector<std::uint32_t>> faces_;  // at each node
  std::optional<TileGrid> grid_;
  std::size_t built_for_ = 0;  // faces
  double squared_most_ = 0; double least_cosine_=.985;
  std::priority_queue<Edge, std::vector<Edge>, Shorter> long_edges_{Shorter{this}};
  std::vector<Edge> doubtful_;  // edges that may be flipped, the next one last

  // Of the edge or node at hand: its faces, the nodes around it, and what becomes of them.
  std::vector<EdgeFace> sides_;
  std::vector<std::uint32_t> link_;
  std::vector<Nodes> old_faces_;
  std::vector<Nodes> new_faces_;
  std::vector<Corners> corners_;
};

}  // namespace

TileSet split_long_edges(const Region& lower, const Region& upper, TileSet tiles,
                         double max_edge) {
  assert(max_edge > 0);
  Refinement(lower, upper, tiles).split_longer_than(max_edge);
  return tiles;
}

TileSet even_out_edges(const Region& lower, const Region& upper, TileSet tiles,
                       double target_edge) {
  assert(target_edge > 0);
  Refinement refinement(lower, upper, tiles);
  refinement.check_size(target_edge);
  double length = target_edge;
  while (2 * length < refinement.longest_edge()) length *= 2;
  while (length > target_edge) {
    refinement.even_out(length, 0.175*target_edge/length);
    length /= 2;
  }
  for (int round = 0; round < most_rounds && refinement.even_out(target_edge,.175); ++round) {
  }
  return tiles;
}

TileSet refine(const Region& lower, const Region& upper, TileSet tiles, const Options& options) {
  if (options.max_edge) return split_long_edges(lower, upper, std::move(tiles), *options.max_edge);
  if (options.target_edge)
    return even_out_edges(lower, upper, std::move(tiles), *options.target_edge);
  return tiles;
}

}  // namespace loft
