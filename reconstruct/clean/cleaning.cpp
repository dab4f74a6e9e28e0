// SPDX-License-Identifier: MIT
#include "reconstruct/clean/cleaning.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "cdt/regions.h"
#include "reconstruct/clean/keyholes.h"
#include "reconstruct/clean/lines.h"
#include "reconstruct/clean/meetings.h"
#include "reconstruct/clean/near_copies.h"
#include "reconstruct/clean/normal_form.h"
#include "reconstruct/clean/simple_slice.h"
#include "reconstruct/clean/weld.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::Triangulation;
using cdt::VertexId;

/// Outlines of a slice that are nearer to each other than that touch: 16 roundings of the
/// coordinates, and 1e-12 of the slice's width. Between nearer ones, crossings with the contours of
/// the next slice could not be told apart.
struct Extent {
  double width = 0;     // the longer side of the box around all contours
  double farthest = 0;  // the largest coordinate

  [[nodiscard]] double least_distance() const {
    return std::max(0x1p-49 * farthest, 0x1p-40 * width);
  }
};

Extent extent(std::span<const ContourSource> contours) {
  cdt::Box box;
  double farthest = 0;
  for (const ContourSource& contour : contours) {
    for (const Point p : contour.points) {
      box.add(p);
      farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
    }
  }
  const double width =
      box.is_empty() ? 0 : std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  return {width, farthest};
}

/// Whether some of the contours are the same but for less than the tolerance, without coming so
/// near that they could not be told apart.
bool has_near_copies(std::span<const ContourSource> contours, double tolerance) {
  std::vector<std::span<const Point>> rings;
  for (const ContourSource& contour : contours) rings.push_back(contour.points);
  return !find_near_copies(rings, tolerance).empty();
}

/// The cleaning of one slice, stage by stage.
class Cleaning {
 public:
  Cleaning(std::span<const ContourSource> contours, double z, const Filling& filling,
           const Extent& extent, std::vector<Defect>& repairs, Triangulation& memory)
      : contours_(contours),
        z_(z),
        filling_(filling),
        least_distance_(extent.least_distance()),
        tolerance_(filling.tolerance * extent.width),
        repairs_(repairs),
        mesh_(memory) {
    mesh_.clear();
  }

  Region run() {
    choose_contours();
    insert();
    find_inside();
    report_meetings();
    return follow_loops();
  }

  /// For what is a region already: copies cancel each other, there is nothing to report.
  Region run_again() {
    for (std::uint32_t i = 0; i < contours_.size(); ++i)
      if (!contours_[i].points.empty()) rings_.push_back({i, {}, true});
    insert();
    find_inside();
    return follow_loops();
  }

  /// The contours that have no area.
  [[nodiscard]] std::span<const std::uint32_t> flat() const { return flat_; }
  /// Whether the region's vertices are those of the contours, and nothing is too near.
  [[nodiscard]] bool is_settled() const {
    return is_settled_ && !has_near_vertices() &&
           std::ranges::find(origins_.begin() + 1, origins_.end(), VertexKind::cleaning,
                             &Origin::kind) == origins_.end();
  }

 private:
  /// A closed line that is inserted: a contour, or what is left of it.
  struct Ring {
    std::uint32_t contour;               // index in contours_
    std::vector<std::uint32_t> numbers;  // of its points; none where it has all
    bool turns_left;
  };

  Defect& report(DefectKind kind, std::uint32_t contour, std::string message) {
    const ContourSource& source = contours_[contour];
    repairs_.push_back({kind, z_, source.slice, source.contour, {}, {}, 0, std::move(message)});
    return repairs_.back();
  }
  /// What messages call a contour.
  [[nodiscard]] std::string called(std::uint32_t contour) const {
    return "contour " + std::to_string(contours_[contour].contour);
  }

  void choose_contours() {
    std::map<std::vector<Point>, std::size_t> seen;  // where the first one is in rings_
    std::vector<std::span<const Point>> places;      // of each of these
    for (std::uint32_t i = 0; i < contours_.size(); ++i) {
      NormalForm form = normal_form(contours_[i].points);
      if (form.places.empty() || are_in_line(form.places)) {
        flat_.push_back(i);
        continue;
      }
      if (form.laps > 1)
        report(DefectKind::repeated_contour, i,
               "goes round the same points " + std::to_string(form.laps) + " times; kept once")
            .place = form.places.front();
      Ring ring{i, {}, form.turns_left};
      if (form.laps > 1) ring.numbers = std::move(form.numbers);
      const auto [other, is_new] = seen.try_emplace(std::move(form.places), rings_.size());
      if (is_new) {
        places.emplace_back(other->first);
        rings_.push_back(std::move(ring));
      } else {
        drop_copy(rings_[other->second], std::move(ring));
      }
    }
    drop_near_copies(places);
    if (filling_.rule == Fill::keyhole_aware) cut_channels();
  }

  void drop_near_copies(std::span<const std::span<const Point>> places) {
    const std::vector<NearCopy> copies = find_near_copies(places, tolerance_);
    if (copies.empty()) return;
    std::vector<bool> is_dropped(rings_.size());
    for (const auto& [kept, dropped] : copies) {
      is_dropped[dropped] = true;
      report(DefectKind::repeated_contour, rings_[dropped].contour,
             "runs along " + called(rings_[kept].contour) +
                 " all the way round, but for rounding; one copy dropped")
          .place = contours_[rings_[dropped].contour].points.front();
    }
    std::vector<Ring> left;
    for (std::size_t i = 0; i < rings_.size(); ++i)
      if (!is_dropped[i]) left.push_back(std::move(rings_[i]));
    rings_ = std::move(left);
  }

  /// Of two that go round opposite ways the one that turns left stays: with it, whatever else is
  /// there, a point that only these two wind around is inside, and the order does not matter.
  void drop_copy(Ring& kept, Ring dropped) {
    const bool is_turned = kept.turns_left != dropped.turns_left;
    if (is_turned && dropped.turns_left) std::swap(kept, dropped);
    report(DefectKind::repeated_contour, dropped.contour,
           "is the same as " + called(kept.contour) + (is_turned ? ", the other way round" : "") +
               "; one copy dropped")
        .place = contours_[dropped.contour].points.front();
  }

  void cut_channels() {
    std::vector<Ring> all;
    for (Ring& ring : rings_) {
      const std::vector<Point> points = points_of(ring);
      KeyholeCut cut = cut_keyholes(points, filling_.channel_width(points));
      if (cut.channels.empty()) {
        all.push_back(std::move(ring));
        continue;
      }
      for (auto& part : cut.rings) {
        if (!ring.numbers.empty())
          for (std::uint32_t& number : part) number = ring.numbers[number];
        all.push_back({ring.contour, std::move(part), ring.turns_left});
      }
      for (const Channel& channel : cut.channels) {
        Defect& defect =
            report(DefectKind::keyhole, ring.contour,
                   "leads through a channel to a hole and back; cut there, the hole taken out");
        defect.place = channel.place;
        defect.area = channel.area;
      }
    }
    rings_ = std::move(all);
  }

  [[nodiscard]] std::vector<Point> points_of(const Ring& ring) const {
    const auto points = contours_[ring.contour].points;
    if (ring.numbers.empty()) return {points.begin(), points.end()};
    std::vector<Point> result;
    for (const std::uint32_t number : ring.numbers) result.push_back(points[number]);
    return result;
  }

  void insert() {
    std::size_t count = 0;
    for (const Ring& ring : rings_) count += contours_[ring.contour].points.size();
    mesh_.reserve(count);
    std::vector<std::vector<Point>> parts;  // of contours that are not inserted as they are
    parts.reserve(rings_.size());
    std::vector<cdt::Polyline> lines;
    for (const Ring& ring : rings_) {
      if (!ring.numbers.empty()) parts.push_back(points_of(ring));
      lines.push_back({ring.numbers.empty() ? contours_[ring.contour].points
                                            : std::span<const Point>(parts.back()),
                       cdt::closed});
    }
    mesh_.insert(lines);
    note_sources();
  }

  /// Which input point each vertex is; the first one where there are several.
  void note_sources() {
    origins_.assign(mesh_.vertex_bound(),
                    Origin{VertexKind::cleaning, Origin::none, Origin::none, Origin::none});
    for (std::uint32_t r = 0; r < rings_.size(); ++r) {
      const Ring& ring = rings_[r];
      const ContourSource& source = contours_[ring.contour];
      const auto segments = mesh_.segments(cdt::ConstraintId(r));
      std::uint32_t repeated = 0;
      for (std::uint32_t i = 0; i < segments.size(); ++i) {
        Origin& origin = origins_[segments[i].from.index()];
        const bool is_closing = i + 1 == segments.size();
        if (segments[i].from == segments[i].to && !is_closing) ++repeated;
        if (origin.contour != Origin::none) continue;
        origin = {VertexKind::contour, source.slice, source.contour,
                  ring.numbers.empty() ? i : ring.numbers[i]};
      }
      if (repeated != 0)
        report(DefectKind::repeated_point, ring.contour,
               std::to_string(repeated) + " points given twice in a row; kept once");
    }
  }

  void find_inside() {
    if (filling_.rule != Fill::nonzero) {
      is_inside_ = cdt::odd_parity(mesh_);
    } else {
      const auto windings = cdt::winding_numbers(mesh_);
      is_inside_.resize(windings.size());
      for (std::size_t t = 0; t < windings.size(); ++t) is_inside_[t] = windings[t] != 0;
    }
  }

  [[nodiscard]] bool is_inside(EdgeId e) const {
    return is_inside_[Triangulation::triangle(e).index()];
  }
  /// Whether the region is on the left of e and not on its right.
  [[nodiscard]] bool is_boundary(EdgeId e) const {
    return is_inside(e) && !is_inside(mesh_.twin(e));
  }

  [[nodiscard]] std::uint32_t contour_of(cdt::ConstraintId ring) const {
    return rings_[ring.index()].contour;
  }
  [[nodiscard]] std::uint32_t contour_of(cdt::Passage passage) const {
    return contour_of(mesh_.segment(passage.segment()).constraint);
  }

  /// One report for each contour, or pair of contours, and way in which they meet.
  void report_meetings() {
    for (const Meeting& meeting : find_meetings(mesh_, is_inside_)) {
      const std::uint32_t one = contour_of(meeting.one);
      const std::uint32_t other = contour_of(meeting.other);
      Defect& defect = report(kind_of(meeting, one == other), other, message(meeting, one, other));
      defect.place = meeting.place;
      defect.area = meeting.area;
    }
  }

  [[nodiscard]] static DefectKind kind_of(const Meeting& meeting, bool is_one_contour) {
    switch (meeting.kind) {
      case Meeting::Kind::crossing:
        return is_one_contour ? DefectKind::self_crossing : DefectKind::overlap;
      case Meeting::Kind::doubled:
        return DefectKind::spike;
      case Meeting::Kind::covered:
        return DefectKind::covered;
      default:
        return DefectKind::touching;
    }
  }

  [[nodiscard]] std::string message(const Meeting& meeting, std::uint32_t one,
                                    std::uint32_t other) const {
    const std::string what = one == other ? "itself" : called(one);
    switch (meeting.kind) {
      case Meeting::Kind::crossing:
        return "crosses " + what +
               (meeting.places == 1 ? "" : ", " + std::to_string(meeting.places) + " times") +
               (filling_.rule == Fill::nonzero
                    ? "; parts that are wound around are inside (--fill nonzero)"
                    : "; parts enclosed twice are outside (--fill evenodd); --fill nonzero keeps "
                      "them");
      case Meeting::Kind::doubled:
        return "runs out and back along the same line, a spike or the channel to a hole; left out";
      case Meeting::Kind::shared_side:
        return "shares part of its outline with " + what + "; joined there";
      case Meeting::Kind::upon_side:
        return "has a corner on a side of " + what + ", or the reverse; the side is split there";
      case Meeting::Kind::covered:
        break;
    }
    return "is inside of others that make it no hole (--fill nonzero); without effect";
  }

  /// The next boundary edge with the same inside on its left: around the end of e, through the
  /// region. So loops that meet in a point do not cross there.
  [[nodiscard]] EdgeId next_boundary(EdgeId e) const {
    EdgeId ahead = Triangulation::next(e);
    while (!is_boundary(ahead)) ahead = Triangulation::next(mesh_.twin(ahead));
    return ahead;
  }

  using Segments = std::vector<cdt::SegmentId>;

  [[nodiscard]] Segments segments_along(EdgeId e) const {
    Segments all;
    for (const cdt::Passage passage : mesh_.passages(e)) all.push_back(passage.segment());
    return all;
  }

  [[nodiscard]] static Segments common(const Segments& some, const Segments& others) {
    Segments both;
    for (const cdt::SegmentId s : some)
      if (std::ranges::find(others, s) != others.end()) both.push_back(s);
    return both;
  }

  /// A crossing vertex where the region's boundary touches nothing else: it may have nothing left
  /// to cross.
  [[nodiscard]] bool may_be_left_over(VertexId v) const {
    if (origins_[v.index()].kind == VertexKind::contour) return false;
    std::size_t boundary_edges = 0;
    const EdgeId first = mesh_.edge(v);
    EdgeId e = first;
    do {
      boundary_edges += is_boundary(e) ? 1U : 0U;
      e = mesh_.rotated(e);
    } while (e != first);
    return boundary_edges == 1;
  }

  Region follow_loops() {
    Region region;
    region.z = z_;
    region.slice = contours_.empty() ? 0 : contours_.front().slice;
    region.loop_starts.push_back(0);
    std::vector<bool> is_done(mesh_.edge_bound());
    index_.assign(mesh_.vertex_bound(), Origin::none);
    for (std::uint32_t v = 1; v < mesh_.vertex_bound(); ++v) {
      const EdgeId first = mesh_.edge(VertexId(v));
      if (first.is_none()) continue;
      EdgeId e = first;
      do {
        if (is_boundary(e) && !is_done[e.index()]) follow_loop(e, is_done, region);
        e = mesh_.rotated(e);
      } while (e != first);
    }
    return region;
  }

  void follow_loop(EdgeId start, std::vector<bool>& is_done, Region& region) {
    // The boundary runs straight on at a vertex if one and the same segment leads along all of it
    // from the corner before to the corner after: where two crossings are a last place apart, each
    // edge shares a segment with the next one, and there is a corner all the same.
    Segments straight = segments_along(start);
    std::optional<Segments> to_first_corner;
    EdgeId e = start;
    do {
      is_done[e.index()] = true;
      const EdgeId after = next_boundary(e);
      if (const VertexId v = vertex_upon(e); !v.is_none()) {
        region.loop_vertices.push_back(add_point(v, region));
        report_led_through(e, v);
        is_settled_ = false;
      }
      const bool is_last = after == start && to_first_corner.has_value();
      const Segments ahead = is_last ? *to_first_corner : segments_along(after);
      Segments both = common(straight, ahead);
      if (both.empty() || !may_be_left_over(mesh_.from(after))) {
        region.loop_vertices.push_back(add_point(mesh_.from(after), region));
        if (!to_first_corner) to_first_corner = straight;
        both = ahead;
      }
      straight = std::move(both);
      e = after;
    } while (e != start);
    // The walk began with the end of the first edge: let the loop begin with its start.
    const auto begin =
        region.loop_vertices.begin() + static_cast<std::ptrdiff_t>(region.loop_starts.back());
    std::rotate(begin, region.loop_vertices.end() - 1, region.loop_vertices.end());
    region.loop_starts.push_back(static_cast<std::uint32_t>(region.loop_vertices.size()));
  }

  /// The nearest of several vertices is a neighbour in the triangulation.
  [[nodiscard]] bool has_near_vertices() const {
    for (std::uint32_t i = 0; i < mesh_.edge_bound(); ++i) {
      const EdgeId e(i);
      if (!mesh_.is_triangle(Triangulation::triangle(e))) continue;
      if (mesh_.from(e) == Triangulation::infinite || mesh_.to(e) == Triangulation::infinite)
        continue;
      const Point a = mesh_.point(mesh_.from(e));
      const Point b = mesh_.point(mesh_.to(e));
      if (std::abs(a.x - b.x) < least_distance_ && std::abs(a.y - b.y) < least_distance_)
        return true;
    }
    return false;
  }

  /// A vertex that is too near to an edge: the outline is led through it.
  [[nodiscard]] VertexId vertex_upon(EdgeId e) const {
    const Point a = mesh_.point(mesh_.from(e));
    const Point b = mesh_.point(mesh_.to(e));
    for (const EdgeId side : {e, mesh_.twin(e)}) {
      const VertexId v = mesh_.apex(side);
      if (v == Triangulation::infinite) continue;
      const Point p = mesh_.point(v);
      const double along = (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y);
      const double length = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
      const double area = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (along > 0 && along < length && std::abs(area) < least_distance_ * std::sqrt(length))
        return v;
    }
    return VertexId::none();
  }

  void report_led_through(EdgeId e, VertexId v) {
    report(DefectKind::touching, contour_of(mesh_.passages(e).front()),
           "a side comes nearer to a corner than can be told apart; led through it")
        .place = mesh_.point(v);
  }

  std::uint32_t add_point(VertexId v, Region& region) {
    std::uint32_t& index = index_[v.index()];
    if (index == Origin::none) {
      index = static_cast<std::uint32_t>(region.points.size());
      region.points.push_back(mesh_.point(v));
      region.origins.push_back(origins_[v.index()]);
      if (region.origins.back().kind == VertexKind::cleaning)
        region.origins.back().slice = region.slice;
    }
    return index;
  }

  bool is_settled_ = true;  // no outline was led through a vertex beside it
  std::span<const ContourSource> contours_;
  double z_;
  Filling filling_;
  double least_distance_;
  double tolerance_;  // between contours that are one
  std::vector<Defect>& repairs_;
  std::vector<Ring> rings_;          // by constraint
  std::vector<std::uint32_t> flat_;  // contours without an area
  Triangulation& mesh_;
  std::vector<Origin> origins_;       // of each vertex
  std::vector<bool> is_inside_;       // of each triangle
  std::vector<std::uint32_t> index_;  // of each vertex, in the region
};

}  // namespace

namespace {

/// Rounding may set a crossing down on the wrong side of an edge next to it, or on it. More rounds
/// than a few were never seen.
constexpr int most_rounds = 16;

/// The loops of a region cleaned once more, as long as that changes anything.
Region settle(Region region, const Extent& extent, std::vector<Defect>& repairs,
              Triangulation& memory) {
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<std::uint32_t> target = weld(region, extent.least_distance(), repairs);
    std::vector<std::vector<Point>> loops(region.loop_count());
    std::vector<ContourSource> sources;
    for (std::uint32_t i = 0; i < loops.size(); ++i) {
      for (const std::uint32_t v : region.loop(i)) loops[i].push_back(region.points[target[v]]);
      sources.push_back({loops[i], region.slice, i});
    }
    std::vector<Defect> known;
    Region again = Cleaning(sources, region.z, {}, extent, known, memory).run_again();
    for (Origin& origin : again.origins)
      if (origin.kind == VertexKind::contour)
        origin = region.origins[target[region.loop(origin.contour)[origin.point]]];
    const bool is_same =
        again.points == region.points && again.loop_vertices == region.loop_vertices;
    region = std::move(again);
    if (is_same) break;
  }
  return region;
}

}  // namespace

double Filling::channel_width(std::span<const cdt::Point> contour) const {
  if (keyhole_width) return *keyhole_width;
  cdt::Box box;
  for (const Point p : contour) box.add(p);
  return box.is_empty() ? 0 : 1e-3 * std::hypot(box.high.x - box.low.x, box.high.y - box.low.y);
}

Region clean(std::span<const ContourSource> contours, double z, const Filling& filling,
             std::vector<Defect>& repairs, Triangulation& memory) {
  const Extent size = extent(contours);
  if (auto simple = simple_region(contours, z, filling.rule, size.least_distance()))
    if (contours.size() == 1 || !has_near_copies(contours, filling.tolerance * size.width))
      return std::move(*simple);
  Cleaning cleaning(contours, z, filling, size, repairs, memory);
  Region region = cleaning.run();
  if (!cleaning.is_settled()) region = settle(std::move(region), size, repairs, memory);
  add_lines(region, contours, cleaning.flat(), size.least_distance(), repairs);
  return region;
}

Region clean(std::span<const ContourSource> contours, double z, const Filling& filling,
             std::vector<Defect>& repairs) {
  Triangulation memory;
  return clean(contours, z, filling, repairs, memory);
}

}  // namespace loft
