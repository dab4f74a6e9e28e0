// SPDX-License-Identifier: MIT
#include "overlay/validity.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "cdt/predicates.h"
#include "cdt/triangulation.h"
#include "overlay/edge_tree.h"
#include "overlay/ring_contacts.h"

namespace loft::overlay {

using cdt::Point;

namespace {

using InvalidityKind = Invalidity::Kind;

/// Rings by number, polygon by polygon: all edges of those that have an inside.
class NumberedRings {
 public:
  void add(RingOf name, std::span<const Point> corners) {
    if (name.ring == 0) outer_.push_back(edges_.ring_count());
    names_.push_back(name);
    edges_.add(corners);
  }

  [[nodiscard]] const RingEdges& edges() const { return edges_; }
  [[nodiscard]] std::uint32_t size() const { return edges_.ring_count(); }
  [[nodiscard]] RingOf name(std::uint32_t ring) const { return names_[ring]; }
  [[nodiscard]] std::size_t polygon(std::uint32_t ring) const { return names_[ring].polygon; }
  [[nodiscard]] bool is_hole(std::uint32_t ring) const { return names_[ring].ring != 0; }
  /// The outer ring of a ring's polygon.
  [[nodiscard]] std::uint32_t outer(std::uint32_t ring) const { return outer_[polygon(ring)]; }
  [[nodiscard]] bool are_of_one_polygon(std::uint32_t a, std::uint32_t b) const {
    return polygon(a) == polygon(b);
  }

 private:
  RingEdges edges_;
  std::vector<RingOf> names_;         // by ring
  std::vector<std::uint32_t> outer_;  // by polygon
};

/// Rings that are joined, step by step.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  /// Whether they were apart.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[a] = b;
    return a != b;
  }

 private:
  [[nodiscard]] std::uint32_t root(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

  std::vector<std::uint32_t> parent_;
};

/// A place on a ring just beside a point of it, to the right: `from` and a very little towards
/// `to`. Where rings do not run along one another, it is on no other ring.
struct Probe {
  Point from;
  Point to;

  [[nodiscard]] bool may_be_over(const cdt::Box& box) const {
    return box.low.x <= from.x && from.x < box.high.x && box.low.y <= from.y;
  }
  [[nodiscard]] bool is_over(const RingEdge& edge) const {
    const auto [left, right] = std::minmax(edge.from, edge.to);
    if (!(left.x <= from.x && from.x < right.x)) return false;
    const int side = cdt::orient(left, right, from);
    return side > 0 || (side == 0 && cdt::orient(left, right, to) > 0);
  }
};

std::optional<Probe> probe_of(std::span<const RingEdge> ring) {
  const auto edge =
      std::ranges::find_if(ring, [](const RingEdge& e) { return e.from.x != e.to.x; });
  if (edge == ring.end()) return std::nullopt;
  const auto [left, right] = std::minmax(edge->from, edge->to);
  return Probe{left, right};
}

class ValidityCheck {
 public:
  explicit ValidityCheck(const MultiPolygon& polygons) {
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      add_ring({p, 0}, polygons[p].outer);
      for (std::size_t h = 0; h < polygons[p].holes.size(); ++h)
        add_ring({p, h + 1}, polygons[p].holes[h]);
    }
    is_spoiled_.resize(polygons.size());
  }

  std::vector<Invalidity> problems() {
    const EdgeTree tree(rings_.edges().all());
    contacts_ = contacts(rings_.edges(), tree);
    check_contacts();
    for (std::uint32_t ring = 0; ring < rings_.size(); ++ring) {
      if (rings_.edges().of(ring).empty()) continue;
      check_orientation(ring);
      check_place(ring, rings_around(ring, tree));
    }
    check_connection();
    std::ranges::sort(problems_, {}, [](const Invalidity& problem) {
      return std::tuple(problem.ring, problem.kind, problem.place, problem.other);
    });
    return std::move(problems_);
  }

 private:
  void tell(InvalidityKind kind, RingOf ring, Point place,
            std::optional<RingOf> other = std::nullopt) {
    problems_.push_back({kind, ring, place, other});
  }

  /// A ring without what follows itself; without edges if it has no inside.
  void add_ring(RingOf name, const Ring& ring) {
    rings_.add(name, has_usable_points(name, ring) ? corners(name, ring) : Ring());
  }

  bool has_usable_points(RingOf name, const Ring& ring) {
    using cdt::Triangulation;
    const std::size_t before = problems_.size();
    for (const Point p : ring)
      if (!Triangulation::is_usable(p)) tell(InvalidityKind::unusable_point, name, p);
    return problems_.size() == before;
  }

  Ring corners(RingOf name, const Ring& ring) {
    Ring result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i] != ring[i == 0 ? ring.size() - 1 : i - 1])
        result.push_back(ring[i]);
      else if (ring.size() > 1)
        tell(InvalidityKind::repeated_point, name, ring[i]);
    }
    Ring different = result;
    std::ranges::sort(different);
    if (std::unique(different.begin(), different.end()) - different.begin() >= 3) return result;
    tell(InvalidityKind::too_few_points, name, ring.empty() ? Point() : ring.front());
    return {};
  }

  void check_contacts() {
    for (const RingContact& contact : contacts_) {
      if (contact.ring == contact.other)
        tell(kind_with_itself(contact.kind), rings_.name(contact.ring), contact.place);
      else if (contact.kind != RingContact::Kind::touch)
        tell(kind_with_other(contact.kind), rings_.name(contact.ring), contact.place,
             rings_.name(contact.other));
      if (contact.kind == RingContact::Kind::touch) continue;
      tangled_.emplace_back(contact.ring, contact.other);
      if (rings_.are_of_one_polygon(contact.ring, contact.other))
        is_spoiled_[rings_.polygon(contact.ring)] = true;
    }
    std::ranges::sort(tangled_);
  }

  [[nodiscard]] static InvalidityKind kind_with_itself(RingContact::Kind kind) {
    switch (kind) {
      case RingContact::Kind::crossing:
        return InvalidityKind::crosses_itself;
      case RingContact::Kind::stretch:
        return InvalidityKind::runs_along_itself;
      case RingContact::Kind::touch:
        break;
    }
    return InvalidityKind::touches_itself;
  }

  [[nodiscard]] static InvalidityKind kind_with_other(RingContact::Kind kind) {
    return kind == RingContact::Kind::crossing ? InvalidityKind::crosses_other
                                               : InvalidityKind::runs_along_other;
  }

  [[nodiscard]] bool is_tangled(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::binary_search(tangled_, std::pair(std::min(a, b), std::max(a, b)));
  }

  void check_orientation(std::uint32_t ring) {
    if (is_tangled(ring, ring)) return;
    ExactArea inside;
    Point smallest = rings_.edges().of(ring).front().from;
    for (const RingEdge& edge : rings_.edges().of(ring)) {
      inside.add_piece(edge.from, edge.to);
      smallest = std::min(smallest, edge.from);
    }
    if ((inside.sign() < 0) != rings_.is_hole(ring))
      tell(InvalidityKind::wrong_orientation, rings_.name(ring), smallest);
  }

  /// The rings that a ring is in: those of which an odd number of edges are below it. Sorted.
  [[nodiscard]] std::vector<std::uint32_t> rings_around(std::uint32_t ring,
                                                        const EdgeTree& tree) const {
    const auto probe = probe_of(rings_.edges().of(ring));
    if (!probe) return {};
    std::vector<std::uint32_t> below;
    tree.search([&](const cdt::Box& box) { return probe->may_be_over(box); },
                [&](std::uint32_t e) {
                  const RingEdge& edge = rings_.edges()[e];
                  if (edge.ring != ring && probe->is_over(edge)) below.push_back(edge.ring);
                });
    std::ranges::sort(below);
    return odd_ones(below);
  }

  [[nodiscard]] static std::vector<std::uint32_t> odd_ones(std::span<const std::uint32_t> sorted) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t number : sorted) {
      if (!result.empty() && result.back() == number)
        result.pop_back();
      else
        result.push_back(number);
    }
    return result;
  }

  void check_place(std::uint32_t ring, std::span<const std::uint32_t> around) {
    if (rings_.is_hole(ring))
      check_place_of_hole(ring, around);
    else
      check_place_of_outer(ring, around);
  }

  void check_place_of_hole(std::uint32_t hole, std::span<const std::uint32_t> around) {
    const std::uint32_t outer = rings_.outer(hole);
    if (!rings_.edges().of(outer).empty() && !is_tangled(hole, outer) &&
        !std::ranges::binary_search(around, outer))
      tell_place(InvalidityKind::hole_outside, hole, outer);
    for (const std::uint32_t other : around)
      if (rings_.are_of_one_polygon(hole, other) && rings_.is_hole(other) &&
          !is_tangled(hole, other))
        tell_place(InvalidityKind::hole_in_hole, hole, other);
  }

  /// In `around`, an outer ring comes before the holes of its polygon.
  void check_place_of_outer(std::uint32_t outer, std::span<const std::uint32_t> around) {
    for (std::size_t i = 0; i < around.size(); ++i) {
      const std::uint32_t other = around[i];
      if (rings_.is_hole(other) || is_tangled(outer, other)) continue;
      const bool is_in_hole =
          i + 1 < around.size() && rings_.are_of_one_polygon(other, around[i + 1]);
      if (!is_in_hole) tell_place(InvalidityKind::polygon_in_polygon, outer, other);
    }
  }

  void tell_place(InvalidityKind kind, std::uint32_t ring, std::uint32_t other) {
    tell(kind, rings_.name(ring), probe_of(rings_.edges().of(ring))->from, rings_.name(other));
    if (rings_.are_of_one_polygon(ring, other)) is_spoiled_[rings_.polygon(ring)] = true;
  }

  /// Rings are discs, and what is outside of the outer one is a disc too: they leave what is inside
  /// in one piece if and only if there is no way in a circle through them and the points in which
  /// they touch.
  void check_connection() {
    Joined joined(rings_.size());
    for (const RingContact& contact : contacts_) {
      if (contact.kind != RingContact::Kind::touch || contact.ring == contact.other) continue;
      if (!rings_.are_of_one_polygon(contact.ring, contact.other)) continue;
      if (is_spoiled_[rings_.polygon(contact.ring)]) continue;
      if (!joined.join(contact.ring, contact.other))
        tell(InvalidityKind::inside_cut, rings_.name(contact.ring), contact.place,
             rings_.name(contact.other));
    }
  }

  NumberedRings rings_;
  std::vector<RingContact> contacts_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tangled_;  // that cross or run along
  std::vector<bool> is_spoiled_;  // by polygon: whether rings do not lie as they should
  std::vector<Invalidity> problems_;
};

}  // namespace

const char* name_of(Invalidity::Kind kind) {
  switch (kind) {
    case InvalidityKind::unusable_point:
      return "has an unusable point";
    case InvalidityKind::too_few_points:
      return "has too few points";
    case InvalidityKind::repeated_point:
      return "repeats a point";
    case InvalidityKind::crosses_itself:
      return "crosses itself";
    case InvalidityKind::touches_itself:
      return "touches itself";
    case InvalidityKind::runs_along_itself:
      return "runs along itself";
    case InvalidityKind::wrong_orientation:
      return "has the wrong orientation";
    case InvalidityKind::crosses_other:
      return "crosses";
    case InvalidityKind::runs_along_other:
      return "runs along";
    case InvalidityKind::hole_outside:
      return "is a hole outside of";
    case InvalidityKind::hole_in_hole:
      return "is a hole inside";
    case InvalidityKind::inside_cut:
      return "cuts the inside of its polygon, touching";
    case InvalidityKind::polygon_in_polygon:
      return "is inside";
  }
  return "";
}

std::ostream& operator<<(std::ostream& out, const Invalidity& problem) {
  const auto say = [&](RingOf ring) {
    out << "polygon " << ring.polygon << " ring " << ring.ring << ' ';
  };
  say(problem.ring);
  out << name_of(problem.kind) << ' ';
  if (problem.other) say(*problem.other);
  return out << "at " << problem.place;
}

std::vector<Invalidity> validity_problems(const MultiPolygon& polygons) {
  return ValidityCheck(polygons).problems();
}

bool is_valid(const MultiPolygon& polygons) { return validity_problems(polygons).empty(); }

}  // namespace loft::overlay
