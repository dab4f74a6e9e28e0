// SPDX-License-Identifier: MIT
#include "reconstruct/clean/meetings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace loft {

namespace {

using cdt::ConstraintId;
using cdt::EdgeId;
using cdt::Passage;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;
using cdt::VertexId;

using Rings = std::pair<ConstraintId, ConstraintId>;

constexpr std::uint32_t none = 0xffff'ffff;

Rings in_order(ConstraintId a, ConstraintId b) { return a < b ? Rings{a, b} : Rings{b, a}; }

/// The parts of the plane that constrained edges leave, and which rings enclose each.
class Faces {
 public:
  /// How often a ring winds around a face; not 0.
  struct Member {
    ConstraintId ring;
    int winding;
  };

  /// Only the rings for which `counts` holds are noted.
  Faces(const Triangulation& mesh, const std::vector<bool>& counts)
      : mesh_(mesh), counts_(counts), face_of_(mesh.triangle_bound(), none) {
    find_faces();
    find_members();
  }

  [[nodiscard]] std::size_t size() const { return areas_.size(); }
  [[nodiscard]] double area(std::size_t face) const { return areas_[face]; }
  [[nodiscard]] std::span<const Member> members(std::size_t face) const {
    return std::span(members_).subspan(starts_[face], ends_[face] - starts_[face]);
  }
  /// Of the face left of an edge.
  [[nodiscard]] std::span<const Member> members(EdgeId e) const { return members(face(e)); }
  [[nodiscard]] int winding(EdgeId e, ConstraintId ring) const {
    const auto all = members(e);
    const auto found = std::ranges::lower_bound(all, ring, {}, &Member::ring);
    return found == all.end() || found->ring != ring ? 0 : found->winding;
  }

 private:
  [[nodiscard]] std::uint32_t face(EdgeId e) const {
    return face_of_[Triangulation::triangle(e).index()];
  }

  void find_faces() {
    std::vector<TriangleId> front;
    for (std::uint32_t t = 0; t < mesh_.triangle_bound(); ++t) {
      if (!mesh_.is_triangle(TriangleId(t)) || face_of_[t] != none) continue;
      const auto face = static_cast<std::uint32_t>(areas_.size());
      double area = 0;
      face_of_[t] = face;
      front.push_back(TriangleId(t));
      while (!front.empty()) {
        const TriangleId here = front.back();
        front.pop_back();
        area += area_of(here);
        for (unsigned corner = 0; corner < 3; ++corner) {
          const EdgeId e = Triangulation::edge(here, corner);
          const TriangleId beyond = Triangulation::triangle(mesh_.twin(e));
          if (mesh_.is_constrained(e) || face_of_[beyond.index()] != none) continue;
          face_of_[beyond.index()] = face;
          front.push_back(beyond);
        }
      }
      areas_.push_back(area);
    }
  }

  [[nodiscard]] double area_of(TriangleId t) const {
    if (mesh_.is_infinite(t)) return 0;
    const EdgeId e = Triangulation::edge(t);
    const Point a = mesh_.point(mesh_.from(e));
    const Point b = mesh_.point(mesh_.to(e));
    const Point c = mesh_.point(mesh_.apex(e));
    return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }

  /// From the outside inwards, across the edges between faces.
  void find_members() {
    std::vector<std::vector<EdgeId>> borders(areas_.size());
    for (std::uint32_t i = 0; i < mesh_.edge_bound(); ++i)
      if (mesh_.is_triangle(Triangulation::triangle(EdgeId(i))) && mesh_.is_constrained(EdgeId(i)))
        borders[face(EdgeId(i))].push_back(EdgeId(i));
    starts_.assign(areas_.size(), none);
    ends_.assign(areas_.size(), 0);
    const std::uint32_t outside = face(mesh_.edge(Triangulation::infinite));
    starts_[outside] = 0;
    std::vector<std::uint32_t> front{outside};
    while (!front.empty()) {
      const std::uint32_t here = front.back();
      front.pop_back();
      for (const EdgeId e : borders[here]) {
        const std::uint32_t beyond = face(mesh_.twin(e));
        if (starts_[beyond] != none) continue;
        add_members(here, e, beyond);
        front.push_back(beyond);
      }
    }
  }

  /// Those of `here`, but for what crossing e, with `here` on its left, changes.
  void add_members(std::uint32_t here, EdgeId e, std::uint32_t beyond) {
    list_.assign(members_.begin() + starts_[here], members_.begin() + ends_[here]);
    for (const Passage passage : mesh_.passages(e)) {
      const ConstraintId ring = mesh_.segment(passage.segment()).constraint;
      if (!counts_[ring.index()]) continue;
      auto found = std::ranges::lower_bound(list_, ring, {}, &Member::ring);
      if (found == list_.end() || found->ring != ring) found = list_.insert(found, {ring, 0});
      found->winding += mesh_.is_forward(e, passage) ? -1 : 1;
    }
    std::erase_if(list_, [](const Member& member) { return member.winding == 0; });
    starts_[beyond] = static_cast<std::uint32_t>(members_.size());
    members_.insert(members_.end(), list_.begin(), list_.end());
    ends_[beyond] = static_cast<std::uint32_t>(members_.size());
  }

  const Triangulation& mesh_;
  const std::vector<bool>& counts_;
  std::vector<std::uint32_t> face_of_;  // of each triangle
  std::vector<double> areas_;
  std::vector<Member> members_;  // of one face after the other
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> ends_;
  std::vector<Member> list_;
};

class Search {
 public:
  Search(const Triangulation& mesh, const std::vector<bool>& is_inside)
      : mesh_(mesh), is_inside_(is_inside) {}

  std::vector<Meeting> run() {
    look_at_edges();
    find_covered();
    if (is_crowded_) {
      const Faces faces(mesh_, is_meeting_);
      find_corners();
      find_crossings_of_two(faces);
      find_crossings_of_one(faces);
      find_doubled_and_shared();
      find_upon_sides();
    }
    std::ranges::sort(found_, {},
                      [](const Meeting& m) { return std::tuple(m.kind, m.one, m.other); });
    return std::move(found_);
  }

 private:
  [[nodiscard]] ConstraintId ring(Passage passage) const {
    return mesh_.segment(passage.segment()).constraint;
  }
  /// Whether this is the one of an edge's two directions that loops over edges look at.
  [[nodiscard]] bool is_first_side(EdgeId e) const {
    return mesh_.is_triangle(Triangulation::triangle(e)) && mesh_.is_constrained(e) &&
           e < mesh_.twin(e);
  }
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (std::uint32_t i = 0; i < mesh_.edge_bound(); ++i)
      if (is_first_side(EdgeId(i))) visit(EdgeId(i));
  }
  template <class Visit>
  void for_each_edge_at(VertexId v, Visit visit) const {
    const EdgeId first = mesh_.edge(v);
    EdgeId e = first;
    do {
      visit(e);
      e = mesh_.rotated(e);
    } while (e != first);
  }

  /// Where an outline only comes and goes, nothing meets: finds the vertices with more than that.
  void look_at_edges() {
    passages_at_.assign(mesh_.vertex_bound(), 0);
    is_bounding_.assign(mesh_.constraint_bound(), false);
    for_each_edge([&](EdgeId e) {
      const auto count = static_cast<std::uint32_t>(mesh_.passages(e).size());
      passages_at_[mesh_.from(e).index()] += count;
      passages_at_[mesh_.to(e).index()] += count;
      const bool is_bound = is_inside_[Triangulation::triangle(e).index()] !=
                            is_inside_[Triangulation::triangle(mesh_.twin(e)).index()];
      if (is_bound)
        for (const Passage passage : mesh_.passages(e)) is_bounding_[ring(passage).index()] = true;
    });
    is_meeting_.assign(mesh_.constraint_bound(), false);
    for (std::uint32_t i = 1; i < mesh_.vertex_bound(); ++i) {
      if (!mesh_.is_vertex(VertexId(i)) || passages_at_[i] <= 2) continue;
      is_crowded_ = true;
      for_each_edge_at(VertexId(i), [&](EdgeId e) {
        for (const Passage passage : mesh_.passages(e)) is_meeting_[ring(passage).index()] = true;
      });
    }
  }

  /// The first ring that has a corner at each vertex.
  void find_corners() {
    corner_of_.assign(mesh_.vertex_bound(), ConstraintId::none());
    for (std::uint32_t s = 0; s < mesh_.segment_bound(); ++s) {
      if (!mesh_.is_segment(cdt::SegmentId(s))) continue;
      const cdt::Segment& segment = mesh_.segment(cdt::SegmentId(s));
      ConstraintId& first = corner_of_[segment.from.index()];
      first = std::min(first, segment.constraint);  // none is the largest
    }
  }

  void find_covered() {
    for (std::uint32_t c = 0; c < mesh_.constraint_bound(); ++c) {
      const ConstraintId id(c);
      if (!mesh_.is_constraint(id) || is_bounding_[c] || mesh_.segments(id).empty()) continue;
      const Point place = mesh_.point(mesh_.first_vertex(id));
      found_.push_back({Meeting::Kind::covered, id, id, place, 1, enclosed(id)});
    }
  }

  [[nodiscard]] double enclosed(ConstraintId id) const {
    const Point origin = mesh_.point(mesh_.first_vertex(id));
    double twice = 0;
    for (const cdt::Segment& segment : mesh_.segments(id)) {
      const Point a = mesh_.point(segment.from);
      const Point b = mesh_.point(segment.to);
      twice += (a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x);
    }
    return std::abs(twice) / 2;
  }

  /// What is known of two rings: whether one comes into the other, and where.
  struct Evidence {
    bool one_enters = false;
    bool other_enters = false;
    std::vector<VertexId> at;
    double area = 0;

    [[nodiscard]] bool is_crossing() const { return one_enters && other_enters; }
  };

  /// Two outlines cross if part of each is inside the other.
  void find_crossings_of_two(const Faces& faces) {
    for_each_edge([&](EdgeId e) {
      for (const Faces::Member& member : faces.members(e)) {
        if (faces.winding(mesh_.twin(e), member.ring) == 0) continue;
        for (const Passage passage : mesh_.passages(e)) note(e, ring(passage), member.ring);
      }
    });
    for (std::size_t f = 0; f < faces.size(); ++f) add_area(faces.members(f), faces.area(f));
    for (auto& [rings, evidence] : evidence_) {
      if (!evidence.is_crossing()) continue;
      std::ranges::sort(evidence.at, {}, [&](VertexId v) { return mesh_.point(v); });
      const auto last = std::unique(evidence.at.begin(), evidence.at.end());
      const auto places = static_cast<std::size_t>(last - evidence.at.begin());
      if (places == 0) continue;
      found_.push_back({Meeting::Kind::crossing, rings.first, rings.second,
                        mesh_.point(evidence.at.front()), places, evidence.area});
    }
  }

  /// Edge e of ring `inner` is inside of ring `around`.
  void note(EdgeId e, ConstraintId inner, ConstraintId around) {
    if (inner == around) return;
    Evidence& evidence = evidence_[in_order(inner, around)];
    (inner < around ? evidence.one_enters : evidence.other_enters) = true;
    for (const VertexId v : {mesh_.from(e), mesh_.to(e)})
      if (has(v, around)) evidence.at.push_back(v);
  }

  [[nodiscard]] bool has(VertexId v, ConstraintId wanted) const {
    if (passages_at_[v.index()] <= 2) return false;
    bool is_found = false;
    for_each_edge_at(v, [&](EdgeId e) {
      for (const Passage passage : mesh_.passages(e)) is_found |= ring(passage) == wanted;
    });
    return is_found;
  }

  void add_area(std::span<const Faces::Member> members, double area) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        const auto found = evidence_.find({members[i].ring, members[j].ring});
        if (found == evidence_.end() || !found->second.is_crossing()) continue;
        found->second.area += area;
        return;
      }
    }
  }

  /// A ring crosses itself if it winds around something more than once, or both ways, or if it
  /// passes a place several times where it has no corner.
  void find_crossings_of_one(const Faces& faces) {
    struct Areas {
      double left = 0;
      double right = 0;
      double multiple = 0;
    };
    std::vector<Areas> areas(mesh_.constraint_bound());
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (const auto& [ring, winding] : faces.members(f)) {
        Areas& here = areas[ring.index()];
        (winding > 0 ? here.left : here.right) += faces.area(f);
        if (winding > 1 || winding < -1) here.multiple += faces.area(f);
      }
    }
    std::map<ConstraintId, Meeting> crossings;
    for (std::uint32_t i = 1; i < mesh_.vertex_bound(); ++i) {
      if (passages_at_[i] <= 2 || !mesh_.is_vertex(VertexId(i))) continue;
      for (const ConstraintId ring : rings_crossing_at(VertexId(i), faces)) {
        const Point place = mesh_.point(VertexId(i));
        const auto& [left, right, multiple] = areas[ring.index()];
        auto [at, is_new] =
            crossings.try_emplace(ring, Meeting{Meeting::Kind::crossing, ring, ring, place, 0,
                                                multiple + std::min(left, right)});
        Meeting& meeting = at->second;
        ++meeting.places;
        meeting.place = std::min(meeting.place, place);
      }
    }
    for (const auto& [ring, meeting] : crossings) found_.push_back(meeting);
  }

  /// The rings whose winding takes three values or more around a vertex, and those that only pass
  /// it.
  [[nodiscard]] std::vector<ConstraintId> rings_crossing_at(VertexId v, const Faces& faces) const {
    std::map<ConstraintId, std::uint32_t> here;
    for_each_edge_at(v, [&](EdgeId e) {
      for (const Passage passage : mesh_.passages(e)) ++here[ring(passage)];
    });
    std::vector<ConstraintId> result;
    const bool is_corner = !corner_of_[v.index()].is_none();
    for (const auto& entry : here) {
      const ConstraintId ring = entry.first;
      if (entry.second <= 2) continue;
      if (!is_corner) {
        result.push_back(ring);
        continue;
      }
      int low = std::numeric_limits<int>::max();
      int high = std::numeric_limits<int>::min();
      for_each_edge_at(v, [&](EdgeId e) {
        const int winding = faces.winding(e, ring);
        low = std::min(low, winding);
        high = std::max(high, winding);
      });
      if (high - low > 1) result.push_back(ring);
    }
    return result;
  }

  /// One meeting a pair of rings, at the first of its places.
  class ByRings {
   public:
    explicit ByRings(Meeting::Kind kind) : kind_(kind) {}
    void add(Rings rings, Point place) {
      const auto [found, is_new] = first_.try_emplace(rings, place);
      found->second = std::min(found->second, place);
    }
    /// Those of rings that are not known to meet otherwise.
    void move_to(std::vector<Meeting>& all) const {
      std::set<Rings> known;
      for (const Meeting& meeting : all) known.emplace(meeting.one, meeting.other);
      for (const auto& [rings, place] : first_)
        if (!known.contains(rings)) all.push_back({kind_, rings.first, rings.second, place, 1, 0});
    }

   private:
    Meeting::Kind kind_;
    std::map<Rings, Point> first_;
  };

  void find_doubled_and_shared() {
    ByRings doubled(Meeting::Kind::doubled);
    ByRings shared(Meeting::Kind::shared_side);
    for_each_edge([&](EdgeId e) {
      const auto passages = mesh_.passages(e);
      for (std::size_t i = 0; i + 1 < passages.size(); ++i) {
        const Rings rings = in_order(ring(passages[i]), ring(passages[i + 1]));
        const Point place = std::min(mesh_.point(mesh_.from(e)), mesh_.point(mesh_.to(e)));
        if (rings.first != rings.second) {
          shared.add(rings, place);
        } else if (passages[i].is_upward() != passages[i + 1].is_upward()) {
          doubled.add(rings, place);
        }
      }
    });
    doubled.move_to(found_);
    shared.move_to(found_);
  }

  void find_upon_sides() {
    ByRings upon(Meeting::Kind::upon_side);
    for_each_edge([&](EdgeId first) {
      for (const EdgeId e : {first, mesh_.twin(first)}) {
        const VertexId v = mesh_.to(e);
        if (corner_of_[v.index()].is_none()) continue;
        for (const Passage passage : mesh_.passages(e))
          if (mesh_.is_forward(e, passage) && mesh_.segment(passage.segment()).to != v)
            upon.add(in_order(ring(passage), corner_of_[v.index()]), mesh_.point(v));
      }
    });
    upon.move_to(found_);
  }

  const Triangulation& mesh_;
  const std::vector<bool>& is_inside_;
  std::vector<Meeting> found_;
  std::vector<std::uint32_t> passages_at_;  // of each vertex: 2 where an outline just passes
  std::vector<bool> is_bounding_;           // of each ring: whether it bounds the region anywhere
  std::vector<bool> is_meeting_;            // of each ring: whether it has a crowded vertex
  bool is_crowded_ = false;
  std::vector<ConstraintId> corner_of_;  // of each vertex
  std::map<Rings, Evidence> evidence_;
};

}  // namespace

std::vector<Meeting> find_meetings(const cdt::Triangulation& mesh,
                                   const std::vector<bool>& is_inside) {
  return Search(mesh, is_inside).run();
}

}  // namespace loft
