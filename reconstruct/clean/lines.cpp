// SPDX-License-Identifier: MIT
#include "reconstruct/clean/lines.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "cdt/predicates.h"
#include "mesh/box_tree.h"
#include "reconstruct/clean/normal_form.h"
#include "reconstruct/plane/nearest.h"
#include "reconstruct/plane/signed_distance.h"

namespace loft {

namespace {

using cdt::Point;

/// A contour without an area: its places along it, and which points of the contour they are.
struct Line {
  std::uint32_t contour;  // index among the sources
  std::vector<Point> places;
  std::vector<std::uint32_t> numbers;
};

bool cross(const Segment& a, const Segment& b) {
  return cdt::orient(a[0], a[1], b[0]) * cdt::orient(a[0], a[1], b[1]) < 0 &&
         cdt::orient(b[0], b[1], a[0]) * cdt::orient(b[0], b[1], a[1]) < 0;
}

class Lines {
 public:
  Lines(Region& region, std::span<const ContourSource> contours, double nearest,
        std::vector<Defect>& repairs)
      : region_(region), contours_(contours), nearest_(nearest), repairs_(repairs) {}

  void add(std::span<const std::uint32_t> flat) {
    for (const std::uint32_t contour : flat) list(contour);
    std::ranges::sort(lines_, {}, [](const Line& line) {
      return std::tuple(line.places.size() == 1, line.places, line.contour);
    });
    drop_those_at_region();
    drop_those_that_meet();
    if (lines_.empty()) return;
    region_.line_starts.push_back(0);
    for (const Line& line : lines_) put_in(line);
  }

 private:
  void list(std::uint32_t contour) {
    const auto points = contours_[contour].points;
    std::map<Point, std::uint32_t> firsts;
    for (std::uint32_t i = 0; i < points.size(); ++i) firsts.try_emplace(points[i], i);
    Line line{contour, {}, {}};
    for (const auto& [place, number] : firsts) {
      if (!line.places.empty() &&
          distance(place, line.places.back(), line.places.back()) < nearest_)
        continue;
      line.places.push_back(place);
      line.numbers.push_back(number);
    }
    if (line.places.empty()) {
      drop(line, "");
    } else {
      lines_.push_back(std::move(line));
    }
  }

  void drop(const Line& line, const char* why) {
    const ContourSource& source = contours_[line.contour];
    repairs_.push_back(
        dropped_line(region_.z, source.slice, source.contour, line.places.size(), why));
    if (!line.places.empty()) repairs_.back().place = line.places.front();
  }

  /// A point is a segment without length.
  [[nodiscard]] static std::vector<Segment> segments(const Line& line) {
    std::vector<Segment> all;
    if (line.places.size() == 1) all.push_back({line.places[0], line.places[0]});
    for (std::size_t i = 0; i + 1 < line.places.size(); ++i)
      all.push_back({line.places[i], line.places[i + 1]});
    return all;
  }

  [[nodiscard]] Box3 box(const Segment& s) const {
    const auto [left, right] = std::minmax(s[0].x, s[1].x);
    const auto [low, high] = std::minmax(s[0].y, s[1].y);
    return {{left - nearest_, low - nearest_, 0}, {right + nearest_, high + nearest_, 0}};
  }

  void drop_those_at_region() {
    const std::vector<Segment> edges = boundary(region_);
    if (edges.empty() || lines_.empty()) return;
    const SignedDistance inside(edges);
    std::vector<Box3> boxes;
    for (const Segment& edge : edges) boxes.push_back(box(edge));
    const BoxTree tree(boxes);
    std::erase_if(lines_, [&](const Line& line) {
      bool is_at = std::ranges::any_of(line.places,
                                       [&](Point p) { return inside.at(p).distance <= nearest_; });
      for (const Segment& s : segments(line))
        tree.for_each_meeting(box(s), [&](std::uint32_t e) {
          is_at = is_at || cross(s, edges[e]) || distance(edges[e][0], s[0], s[1]) <= nearest_;
        });
      if (is_at) drop(line, " inside an outline of its slice, or at one");
      return is_at;
    });
  }

  /// Whether two segments have more in common than an end.
  [[nodiscard]] bool meet(const Segment& a, const Segment& b) const {
    const auto is_upon = [&](Point p, const Segment& s) {
      return p != s[0] && p != s[1] && distance(p, s[0], s[1]) <= nearest_;
    };
    const auto has_end = [](const Segment& s, Point p) { return p == s[0] || p == s[1]; };
    if (has_end(a, b[0]) && has_end(a, b[1])) return true;
    if (has_end(b, a[0]) && has_end(b, a[1])) return true;
    return is_upon(a[0], b) || is_upon(a[1], b) || is_upon(b[0], a) || is_upon(b[1], a) ||
           cross(a, b);
  }

  void drop_those_that_meet() {
    std::vector<Segment> all;
    std::vector<std::uint32_t> line_of;
    std::vector<Box3> boxes;
    for (std::uint32_t i = 0; i < lines_.size(); ++i) {
      for (const Segment& s : segments(lines_[i])) {
        all.push_back(s);
        line_of.push_back(i);
        boxes.push_back(box(s));
      }
    }
    std::vector<std::vector<std::uint32_t>> before(lines_.size());  // lines that a line meets
    BoxTree(boxes).for_each_pair([&](std::uint32_t a, std::uint32_t b) {
      const auto [first, second] = std::minmax(line_of[a], line_of[b]);
      if (first != second && meet(all[a], all[b])) before[second].push_back(first);
    });
    std::vector<Line> kept;
    std::vector<bool> is_kept(lines_.size());
    for (std::uint32_t i = 0; i < lines_.size(); ++i) {
      is_kept[i] = std::ranges::none_of(before[i], [&](std::uint32_t j) { return is_kept[j]; });
      if (!is_kept[i]) drop(lines_[i], " on another such contour, or across it");
    }
    for (std::uint32_t i = 0; i < lines_.size(); ++i)
      if (is_kept[i]) kept.push_back(std::move(lines_[i]));
    lines_ = std::move(kept);
  }

  void put_in(const Line& line) {
    const ContourSource& source = contours_[line.contour];
    for (std::size_t i = 0; i < line.places.size(); ++i) {
      const auto next = static_cast<std::uint32_t>(region_.points.size());
      const auto [there, is_new] = index_.try_emplace(line.places[i], next);
      region_.line_vertices.push_back(there->second);
      if (!is_new) continue;
      region_.points.push_back(line.places[i]);
      region_.origins.push_back(
          {VertexKind::contour, source.slice, source.contour, line.numbers[i]});
    }
    region_.line_starts.push_back(static_cast<std::uint32_t>(region_.line_vertices.size()));
    region_.line_origins.push_back(
        {VertexKind::contour, source.slice, source.contour, Origin::none});
  }

  Region& region_;
  std::span<const ContourSource> contours_;
  double nearest_;
  std::vector<Defect>& repairs_;
  std::vector<Line> lines_;
  std::map<Point, std::uint32_t> index_;  // of each place, in the region
};

}  // namespace

void add_lines(Region& region, std::span<const ContourSource> contours,
               std::span<const std::uint32_t> flat, double least_distance,
               std::vector<Defect>& repairs) {
  if (!flat.empty()) Lines(region, contours, 2 * least_distance, repairs).add(flat);
}

Defect dropped_line(double z, std::uint32_t slice, std::uint32_t contour, std::size_t places,
                    const char* why) {
  const std::string what = places == 0 ? "has no points" : places == 1 ? "is a point" : "is a line";
  return {places < 3 ? DefectKind::too_few_points : DefectKind::zero_area,
          z,
          slice,
          contour,
          {},
          {},
          0,
          what + why + "; dropped"};
}

Defect unused_line(const Region& region, std::size_t line) {
  const auto vertices = region.line(line);
  const Origin& origin = region.line_origins[line];
  Defect defect =
      dropped_line(region.z, origin.slice, origin.contour, vertices.size(),
                   " that no part ends in: none covers it that does not go on in this slice");
  defect.place = region.points[vertices.front()];
  return defect;
}

}  // namespace loft
