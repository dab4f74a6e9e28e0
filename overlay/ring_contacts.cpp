// SPDX-License-Identifier: MIT
#include "overlay/ring_contacts.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "cdt/predicates.h"

namespace loft::overlay {

using cdt::Point;

void RingEdges::add(std::span<const Point> ring) {
  const std::uint32_t number = ring_count();
  for (std::size_t i = 0; i < ring.size(); ++i)
    edges_.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], number});
  first_.push_back(static_cast<std::uint32_t>(edges_.size()));
}

namespace {

using ContactKind = RingContact::Kind;

/// How two edges meet, and where.
struct Meeting {
  ContactKind kind;
  Point place;
};

std::optional<Meeting> meeting_in_line(const RingEdge& e, const RingEdge& f) {
  const auto [e_low, e_high] = std::minmax(e.from, e.to);
  const auto [f_low, f_high] = std::minmax(f.from, f.to);
  const Point low = std::max(e_low, f_low);
  const Point high = std::min(e_high, f_high);
  if (low > high) return std::nullopt;
  return Meeting{low < high ? ContactKind::stretch : ContactKind::touch, low};
}

/// Of edges that begin or end in one point.
Meeting meeting_from(Point shared, Point e_other, Point f_other, const RingEdge& e,
                     const RingEdge& f) {
  if (cdt::orient(shared, e_other, f_other) == 0) return *meeting_in_line(e, f);
  return {ContactKind::touch, shared};
}

std::optional<Meeting> meeting(const RingEdge& e, const RingEdge& f) {
  if (e.from == f.from) return meeting_from(e.from, e.to, f.to, e, f);
  if (e.from == f.to) return meeting_from(e.from, e.to, f.from, e, f);
  if (e.to == f.from) return meeting_from(e.to, e.from, f.to, e, f);
  if (e.to == f.to) return meeting_from(e.to, e.from, f.from, e, f);
  const int f_from = cdt::orient(e.from, e.to, f.from);
  const int f_to = cdt::orient(e.from, e.to, f.to);
  if (f_from * f_to > 0) return std::nullopt;
  if (f_from == 0 && f_to == 0) return meeting_in_line(e, f);
  const int e_from = cdt::orient(f.from, f.to, e.from);
  const int e_to = cdt::orient(f.from, f.to, e.to);
  if (e_from * e_to > 0) return std::nullopt;
  // Their lines meet in one point: which end of one is on the line of the other, is there.
  if (f_from == 0) return Meeting{ContactKind::touch, f.from};
  if (f_to == 0) return Meeting{ContactKind::touch, f.to};
  if (e_from == 0) return Meeting{ContactKind::touch, e.from};
  if (e_to == 0) return Meeting{ContactKind::touch, e.to};
  return Meeting{ContactKind::crossing, cdt::intersection(e.from, e.to, f.from, f.to)};
}

bool is_within(Point p, const cdt::Box& box) {
  return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y;
}

/// Whether a box, of which some is in the edge's own, is all on one side of the edge. Most are
/// decided without exact arithmetic, which corners of the box on the edge's line would need.
bool is_beside(const RingEdge& e, const cdt::Box& box) {
  if (e.from.x == e.to.x || e.from.y == e.to.y) return false;
  if (is_within(e.from, box) || is_within(e.to, box)) return false;
  const bool rises = (e.from.x < e.to.x) == (e.from.y < e.to.y);
  const Point left{box.low.x, rises ? box.high.y : box.low.y};
  const Point right{box.high.x, rises ? box.low.y : box.high.y};
  return cdt::orient(e.from, e.to, left) * cdt::orient(e.from, e.to, right) > 0;
}

/// A ring at a place: it comes from `before` and goes to `after`.
struct Visit {
  Point place;
  std::uint32_t ring;
  std::uint32_t edge;  // begins there, or leads through
  Point before;
  Point after;

  [[nodiscard]] auto rank() const { return std::tuple(place, ring, edge); }
};

Visit visit_at(const RingEdges& edges, std::uint32_t e, Point place) {
  if (place == edges[e].to) e = edges.next(e);
  const bool is_corner = place == edges[e].from;
  const Point before = edges[is_corner ? edges.previous(e) : e].from;
  return {place, edges[e].ring, e, before, edges[e].to};
}

/// Whether a is before b on a turn around a place that begins to the right.
bool turns_before(Point place, Point a, Point b) {
  const auto is_low = [&](Point p) { return p.y != place.y ? p.y < place.y : p.x < place.x; };
  if (is_low(a) != is_low(b)) return is_low(b);
  return cdt::orient(place, a, b) > 0;
}

bool is_same_way(Point place, Point a, Point b) {
  return !turns_before(place, a, b) && !turns_before(place, b, a);
}

/// Whether two visits of a place go, or come, the same way.
bool share_a_way(const Visit& a, const Visit& b) {
  return is_same_way(a.place, a.before, b.before) || is_same_way(a.place, a.before, b.after) ||
         is_same_way(a.place, a.after, b.before) || is_same_way(a.place, a.after, b.after);
}

/// Finds contacts, first of edges, then of the rings that come to a place.
class ContactFinder {
 public:
  ContactFinder(const RingEdges& edges, const EdgeTree& tree) : edges_(&edges), tree_(&tree) {}

  std::vector<RingContact> contacts() {
    visit_shared_corners();
    for (std::uint32_t e = 0; e < edges_->all().size(); ++e) meet_others(e);
    std::ranges::sort(visits_, {}, &Visit::rank);
    const auto is_same = [](const Visit& a, const Visit& b) { return a.rank() == b.rank(); };
    visits_.erase(std::unique(visits_.begin(), visits_.end(), is_same), visits_.end());
    for (std::size_t i = 0, next = 0; i < visits_.size(); i = next) {
      while (next < visits_.size() && visits_[next].place == visits_[i].place) ++next;
      meet_at_place(std::span(visits_).subspan(i, next - i));
    }
    return std::move(contacts_);
  }

 private:
  void visit_shared_corners() {
    const auto corner = [&](std::uint32_t e) { return (*edges_)[e].from; };
    std::vector<std::uint32_t> sorted(edges_->all().size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::ranges::sort(sorted, {}, corner);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const Point place = corner(sorted[i]);
      if ((i > 0 && corner(sorted[i - 1]) == place) ||
          (i + 1 < sorted.size() && corner(sorted[i + 1]) == place))
        visits_.push_back(visit_at(*edges_, sorted[i], place));
    }
  }

  /// An edge with those of larger numbers.
  void meet_others(std::uint32_t e) {
    const RingEdge& edge = (*edges_)[e];
    const cdt::Box box = edge.box();
    tree_->search(
        [&](const cdt::Box& other) { return meet(box, other) && !is_beside(edge, other); },
        [&](std::uint32_t f) {
          if (e < f && meet(box, (*edges_)[f].box())) meet_other(e, f);
        });
  }

  void meet_other(std::uint32_t e, std::uint32_t f) {
    const auto met = meeting((*edges_)[e], (*edges_)[f]);
    if (!met) return;
    if (met->kind != ContactKind::touch) return add(met->kind, met->place, e, f);
    if (ends_at(e, met->place) && ends_at(f, met->place)) return;
    visits_.push_back(visit_at(*edges_, e, met->place));
    visits_.push_back(visit_at(*edges_, f, met->place));
  }

  [[nodiscard]] bool ends_at(std::uint32_t e, Point place) const {
    return (*edges_)[e].from == place || (*edges_)[e].to == place;
  }

  void add(ContactKind kind, Point place, std::uint32_t e, std::uint32_t f) {
    const auto [ring, other] = std::minmax((*edges_)[e].ring, (*edges_)[f].ring);
    contacts_.push_back({kind, place, ring, other});
  }

  void meet_at_place(std::span<const Visit> visits) {
    find_crossings(visits);
    for (std::size_t i = 1; i < visits.size(); ++i)
      if (!crossed(visits[i - 1], visits[i]) && !share_a_way(visits[i - 1], visits[i]))
        add(ContactKind::touch, visits[i].place, visits[i - 1].edge, visits[i].edge);
  }

  /// Two visits cross where their ways alternate on a turn around the place: one that ends crosses
  /// what has begun after it and has not ended.
  void find_crossings(std::span<const Visit> visits) {
    struct Way {
      Point to;
      std::size_t visit;
    };
    std::vector<Way> ways;
    for (std::size_t i = 0; i < visits.size(); ++i) {
      ways.push_back({visits[i].before, i});
      ways.push_back({visits[i].after, i});
    }
    std::ranges::sort(ways, [&](const Way& a, const Way& b) {
      return turns_before(visits.front().place, a.to, b.to);
    });
    crossed_.clear();
    begun_.clear();
    has_begun_.assign(visits.size(), 0);
    for (const Way& way : ways) {
      if (has_begun_[way.visit]++ == 0)
        begun_.push_back(&visits[way.visit]);
      else
        end(visits[way.visit]);
    }
    std::ranges::sort(crossed_);
  }

  void end(const Visit& visit) {
    const auto own = std::ranges::find(begun_.rbegin(), begun_.rend(), &visit);
    for (auto other = begun_.rbegin(); other != own; ++other) {
      if (share_a_way(visit, **other)) continue;
      crossed_.push_back(std::minmax(visit.edge, (*other)->edge));
      add(ContactKind::crossing, visit.place, visit.edge, (*other)->edge);
    }
    begun_.erase(std::next(own).base());
  }

  [[nodiscard]] bool crossed(const Visit& a, const Visit& b) const {
    return std::ranges::binary_search(crossed_, EdgePair(std::minmax(a.edge, b.edge)));
  }

  using EdgePair = std::pair<std::uint32_t, std::uint32_t>;

  const RingEdges* edges_;
  const EdgeTree* tree_;
  std::vector<Visit> visits_;
  std::vector<RingContact> contacts_;

  // At one place.
  std::vector<EdgePair> crossed_;
  std::vector<const Visit*> begun_;
  std::vector<std::uint8_t> has_begun_;  // by visit
};

}  // namespace

std::vector<RingContact> contacts(const RingEdges& edges, const EdgeTree& tree) {
  return ContactFinder(edges, tree).contacts();
}

}  // namespace loft::overlay
