// SPDX-License-Identifier: MIT
#include "reconstruct/region.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "cdt/predicates.h"
#include "cdt/regions.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::Triangulation;
using cdt::VertexId;

/// A contour without points given twice in a row, in an order that does not depend on where it
/// starts and which way round it goes.
std::vector<Point> normal_form(std::span<const Point> points) {
  std::vector<Point> ring;
  for (const Point p : points)
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  std::vector<Point> best;
  for (int direction = 0; direction < 2; ++direction) {
    std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
    if (best.empty() || ring < best) best = ring;
    std::ranges::reverse(ring);
  }
  return best;
}

bool are_in_line(std::span<const Point> points) {
  const auto ends = std::ranges::minmax(points);
  return std::ranges::all_of(points,
                             [&](Point p) { return cdt::orient(ends.min, ends.max, p) == 0; });
}

/// A vertex and an edge that are nearer than that, relative to the coordinates, touch: 16
/// roundings.
constexpr double tightness = 0x1p-49;

/// The cleaning of one slice, stage by stage.
class Cleaning {
 public:
  Cleaning(std::span<const ContourSource> contours, double z, Fill fill,
           std::vector<Defect>& repairs, Triangulation& memory)
      : contours_(contours), z_(z), fill_(fill), repairs_(repairs), mesh_(memory) {
    mesh_.clear();
  }

  Region run() {
    choose_contours();
    insert();
    find_inside();
    report_crossings();
    report_overlaps();
    return follow_loops();
  }

  /// Whether the region's vertices are those of the contours, and none is upon an edge.
  [[nodiscard]] bool is_settled() const {
    return is_settled_ && std::ranges::find(origins_.begin() + 1, origins_.end(),
                                            VertexKind::cleaning, &Origin::kind) == origins_.end();
  }

 private:
  Defect& report(DefectKind kind, std::uint32_t contour, std::string message) {
    const ContourSource& source = contours_[contour];
    repairs_.push_back({kind, z_, source.slice, source.contour, {}, {}, 0, std::move(message)});
    return repairs_.back();
  }

  void choose_contours() {
    std::map<std::vector<Point>, std::uint32_t> seen;
    for (std::uint32_t i = 0; i < contours_.size(); ++i) {
      std::vector<Point> ring = normal_form(contours_[i].points);
      if (ring.empty() || are_in_line(ring)) {
        report_degenerate(i, ring);
      } else if (const auto [other, is_new] = seen.try_emplace(std::move(ring), i); !is_new) {
        report(DefectKind::repeated_contour, i,
               "is the same as contour " + std::to_string(contours_[other->second].contour) +
                   "; one copy dropped")
            .place = other->first.front();
      } else {
        chosen_.push_back(i);
      }
    }
  }

  void report_degenerate(std::uint32_t contour, const std::vector<Point>& ring) {
    const std::size_t places = std::set<Point>(ring.begin(), ring.end()).size();
    Defect& defect =
        places < 3 ? report(DefectKind::too_few_points, contour,
                            "an outline needs 3 different points, this has " +
                                std::to_string(places) + "; dropped")
                   : report(DefectKind::zero_area, contour, "all points are in one line; dropped");
    if (!ring.empty()) defect.place = ring.front();
  }

  void insert() {
    std::size_t count = 0;
    for (const std::uint32_t i : chosen_) count += contours_[i].points.size();
    mesh_.reserve(count);
    for (const std::uint32_t i : chosen_) mesh_.insert(contours_[i].points, cdt::closed);
    note_sources();
  }

  /// Which input point each vertex is; the first one where there are several.
  void note_sources() {
    origins_.assign(mesh_.vertex_bound(),
                    Origin{VertexKind::cleaning, Origin::none, Origin::none, Origin::none});
    for (std::uint32_t c = 0; c < chosen_.size(); ++c) {
      const ContourSource& source = contours_[chosen_[c]];
      const auto segments = mesh_.segments(cdt::ConstraintId(c));
      std::uint32_t repeated = 0;
      for (std::uint32_t i = 0; i < segments.size(); ++i) {
        Origin& origin = origins_[segments[i].from.index()];
        const bool is_closing = i + 1 == segments.size();
        if (segments[i].from == segments[i].to && !is_closing) ++repeated;
        if (origin.contour != Origin::none) continue;
        origin = {VertexKind::contour, source.slice, source.contour, i};
      }
      if (repeated != 0)
        report(DefectKind::repeated_point, chosen_[c],
               std::to_string(repeated) + " points given twice in a row; kept once");
    }
  }

  void find_inside() {
    if (fill_ == Fill::even_odd) {
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

  [[nodiscard]] std::uint32_t contour_of(cdt::Passage passage) const {
    return chosen_[mesh_.segment(passage.segment()).constraint.index()];
  }

  /// One report for each contour, or pair of contours, that cross: the first place and how many.
  void report_crossings() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<VertexId, std::size_t>> found;
    for (std::uint32_t i = 1; i < mesh_.vertex_bound(); ++i) {
      if (!mesh_.is_vertex(VertexId(i)) || origins_[i].kind == VertexKind::contour) continue;
      std::set<std::uint32_t> around;
      const EdgeId first = mesh_.edge(VertexId(i));
      EdgeId e = first;
      do {
        for (const cdt::Passage passage : mesh_.passages(e)) around.insert(contour_of(passage));
        e = mesh_.rotated(e);
      } while (e != first);
      ++found.try_emplace({*around.begin(), *around.rbegin()}, VertexId(i), 0).first->second.second;
    }
    for (const auto& [pair, crossings] : found) {
      const auto& [place, count] = crossings;
      const std::string times = count == 1 ? "" : ", " + std::to_string(count) + " times";
      const std::string rule = fill_ == Fill::even_odd
                                   ? "; parts enclosed twice are outside (--fill evenodd); "
                                     "--fill nonzero keeps them"
                                   : "; parts that it winds around are inside (--fill nonzero)";
      Defect& defect =
          pair.first == pair.second
              ? report(DefectKind::self_crossing, pair.first, "crosses itself" + times + rule)
              : report(DefectKind::overlap, pair.second,
                       "crosses contour " + std::to_string(contours_[pair.first].contour) + times +
                           rule);
      defect.place = mesh_.point(place);
      defect.area = changed_area(pair.first, pair.second);
    }
  }

  /// The area that the fill rule decided otherwise than the contours, each taken for itself and
  /// as one simple outline, would have it.
  [[nodiscard]] double changed_area(std::uint32_t one, std::uint32_t other) const {
    const auto windings = cdt::winding_numbers(mesh_, [&](cdt::ConstraintId c) {
      return chosen_[c.index()] == one || chosen_[c.index()] == other;
    });
    double positive = 0;
    double negative = 0;
    double multiple = 0;
    for (std::uint32_t t = 0; t < windings.size(); ++t) {
      if (windings[t] == 0) continue;
      const double area = triangle_area(cdt::TriangleId(t));
      (windings[t] > 0 ? positive : negative) += area;
      if (std::abs(windings[t]) > 1) multiple += area;
    }
    return multiple + (one == other ? std::min(positive, negative) : 0);
  }

  [[nodiscard]] double triangle_area(cdt::TriangleId t) const {
    const EdgeId e = Triangulation::edge(t);
    const Point a = mesh_.point(mesh_.from(e));
    const Point b = mesh_.point(mesh_.to(e));
    const Point c = mesh_.point(mesh_.apex(e));
    return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }

  /// Edges along which contours run more than once: spikes, and outlines that share a side.
  void report_overlaps() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Point> found;
    for (std::uint32_t i = 0; i < mesh_.edge_bound(); ++i) {
      const EdgeId e(i);
      const auto passages = mesh_.passages(e);
      if (passages.size() < 2 || mesh_.twin(e) < e) continue;
      const std::pair<std::uint32_t, std::uint32_t> pair =
          std::minmax({contour_of(passages.front()), contour_of(passages.back())});
      found.try_emplace(pair, mesh_.point(mesh_.from(e)));
    }
    for (const auto& [pair, place] : found) {
      Defect& defect = pair.first == pair.second
                           ? report(DefectKind::spike, pair.first,
                                    "runs out and back along the same line; the spike is removed")
                           : report(DefectKind::touching, pair.second,
                                    "shares part of its outline with contour " +
                                        std::to_string(contours_[pair.first].contour));
      defect.place = place;
    }
  }

  /// The next boundary edge with the same inside on its left: around the end of e, through the
  /// region. So loops that meet in a point do not cross there.
  [[nodiscard]] EdgeId next_boundary(EdgeId e) const {
    EdgeId ahead = Triangulation::next(e);
    while (!is_boundary(ahead)) ahead = Triangulation::next(mesh_.twin(ahead));
    return ahead;
  }

  /// A crossing vertex with nothing left to cross: the region's boundary runs straight on.
  [[nodiscard]] bool is_left_over(EdgeId before, EdgeId after) const {
    const VertexId v = mesh_.from(after);
    if (origins_[v.index()].kind == VertexKind::contour) return false;
    std::size_t boundary_edges = 0;
    const EdgeId first = mesh_.edge(v);
    EdgeId e = first;
    do {
      boundary_edges += is_boundary(e) ? 1U : 0U;
      e = mesh_.rotated(e);
    } while (e != first);
    const auto in = mesh_.passages(before);
    return boundary_edges == 1 &&
           std::ranges::any_of(mesh_.passages(after), [&](cdt::Passage passage) {
             return std::ranges::any_of(
                 in, [&](cdt::Passage p) { return p.segment() == passage.segment(); });
           });
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
    EdgeId e = start;
    do {
      is_done[e.index()] = true;
      const EdgeId after = next_boundary(e);
      if (const VertexId v = vertex_upon(e); !v.is_none()) {
        region.loop_vertices.push_back(add_point(v, region));
        is_settled_ = false;
      }
      if (!is_left_over(e, after))
        region.loop_vertices.push_back(add_point(mesh_.from(after), region));
      e = after;
    } while (e != start);
    // The walk began with the end of the first edge: let the loop begin with its start.
    const auto begin =
        region.loop_vertices.begin() + static_cast<std::ptrdiff_t>(region.loop_starts.back());
    std::rotate(begin, region.loop_vertices.end() - 1, region.loop_vertices.end());
    region.loop_starts.push_back(static_cast<std::uint32_t>(region.loop_vertices.size()));
  }

  /// A vertex that is beside an edge by a few roundings only: the outline is led through it, or
  /// the next rounding, where contours of two slices cross, might put it on the other side.
  [[nodiscard]] VertexId vertex_upon(EdgeId e) const {
    const Point a = mesh_.point(mesh_.from(e));
    const Point b = mesh_.point(mesh_.to(e));
    const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
    for (const EdgeId side : {e, mesh_.twin(e)}) {
      const VertexId v = mesh_.apex(side);
      if (v == Triangulation::infinite) continue;
      const Point p = mesh_.point(v);
      const double along = (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y);
      const double length = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
      const double area = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (along > 0 && along < length && std::abs(area) < tightness * size * std::sqrt(length))
        return v;
    }
    return VertexId::none();
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
  Fill fill_;
  std::vector<Defect>& repairs_;
  std::vector<std::uint32_t> chosen_;  // contour of each constraint
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

/// For each point the one to put in its place: a crossing within a few roundings of another point
/// is that point. Points of contours stay.
std::vector<std::uint32_t> weld(const Region& region) {
  const auto& points = region.points;
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::uint32_t> target = order;
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return points[i]; });
  const auto is_crossing = [&](std::uint32_t i) {
    return region.origins[i].kind == VertexKind::cleaning;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Point p = points[order[i]];
    const double near = 2 * tightness * std::max(std::abs(p.x), std::abs(p.y));
    for (std::size_t j = i + 1; j < order.size() && points[order[j]].x - p.x <= near; ++j) {
      if (std::abs(points[order[j]].y - p.y) > near) continue;
      if (is_crossing(order[j])) {
        target[order[j]] = target[order[i]];
      } else if (is_crossing(order[i])) {
        target[order[i]] = order[j];
      }
    }
  }
  for (std::uint32_t& i : target) i = target[i];
  return target;
}

/// The loops of a region cleaned once more, as long as that changes anything.
Region settle(Region region, Triangulation& memory) {
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<std::uint32_t> target = weld(region);
    std::vector<std::vector<Point>> loops(region.loop_count());
    std::vector<ContourSource> sources;
    for (std::uint32_t i = 0; i < loops.size(); ++i) {
      for (const std::uint32_t v : region.loop(i)) loops[i].push_back(region.points[target[v]]);
      sources.push_back({loops[i], region.slice, i});
    }
    std::vector<Defect> nothing_new;
    Region again = Cleaning(sources, region.z, Fill::even_odd, nothing_new, memory).run();
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

Region clean(std::span<const ContourSource> contours, double z, Fill fill,
             std::vector<Defect>& repairs, Triangulation& memory) {
  Cleaning cleaning(contours, z, fill, repairs, memory);
  Region region = cleaning.run();
  return cleaning.is_settled() ? region : settle(std::move(region), memory);
}

Region clean(std::span<const ContourSource> contours, double z, Fill fill,
             std::vector<Defect>& repairs) {
  Triangulation memory;
  return clean(contours, z, fill, repairs, memory);
}

void insert_loops(const Region& region, cdt::Triangulation& mesh, Point shift) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    points.clear();
    for (const std::uint32_t v : region.loop(i))
      points.push_back({region.points[v].x + shift.x, region.points[v].y + shift.y});
    mesh.insert(points, cdt::closed);
  }
}

}  // namespace loft
