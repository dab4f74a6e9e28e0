// SPDX-License-Identifier: MIT
#include "reconstruct/clean/simple_slice.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "cdt/predicates.h"
#include "mesh/box_tree.h"
#include "mesh/triangle_pairs.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/outline_depths.h"
#include "reconstruct/plane/nearest.h"
#include "reconstruct/plane/tile_grid.h"

namespace loft {

namespace {

using cdt::Box;
using cdt::Point;

/// Looking at all whose boxes meet may take that many steps a point. Where long edges run side by
/// side, or outlines are nested, there is a way that takes longer elsewhere.
constexpr std::size_t most_steps = 64;

/// A point of the plane, for trees of boxes in space.
Vec3 flat(Point p) { return {p.x, p.y, 0}; }

class SimpleSlice {
 public:
  SimpleSlice(std::span<const ContourSource> contours, double least_distance)
      : contours_(contours), nearest_(2 * least_distance) {}

  std::optional<Region> run(double z, Fill rule) {
    if (rule == Fill::keyhole_aware || !list_edges() || !are_apart() || !find_turns() ||
        !find_directions(rule))
      return {};
    Region region;
    region.z = z;
    region.slice = contours_.empty() ? 0 : contours_.front().slice;
    region.loop_starts.push_back(0);
    add_loops(region);
    return region;
  }

 private:
  struct Edge {
    Point from;
    Point to;
    std::uint32_t contour;
    std::uint32_t index;  // of its start

    [[nodiscard]] Box box() const {
      Box box;
      box.add(from);
      box.add(to);
      return box;
    }
  };
  struct Outline {
    Box box;
    std::uint32_t smallest = 0;  // its smallest point
    bool turns_left = true;
    bool goes_left = true;  // as a loop: the region on its left
  };

  [[nodiscard]] std::span<const Point> points(std::uint32_t contour) const {
    return contours_[contour].points;
  }
  [[nodiscard]] std::uint32_t size(std::uint32_t contour) const {
    return static_cast<std::uint32_t>(points(contour).size());
  }

  bool list_edges() {
    outlines_.resize(contours_.size());
    for (std::uint32_t c = 0; c < contours_.size(); ++c) {
      const auto p = points(c);
      if (p.size() < 3) return false;
      for (std::uint32_t i = 0; i < p.size(); ++i) {
        edges_.push_back({p[i], p[i + 1 == p.size() ? 0 : i + 1], c, i});
        outlines_[c].box.add(p[i]);
        if (p[i] < p[outlines_[c].smallest]) outlines_[c].smallest = i;
      }
    }
    return true;
  }

  [[nodiscard]] bool follows(const Edge& a, const Edge& b) const {
    return a.contour == b.contour && (a.index + 1 == size(a.contour) ? 0 : a.index + 1) == b.index;
  }

  [[nodiscard]] bool is_near(Point p, const Edge& e) const {
    return distance(p, e.from, e.to) <= nearest_;
  }

  /// Whether two edges meet, or nearly so, elsewhere than in a common corner.
  [[nodiscard]] bool meet(const Edge& a, const Edge& b) const {
    if (follows(a, b)) return is_near(a.from, b) || is_near(b.to, a);
    if (follows(b, a)) return is_near(b.from, a) || is_near(a.to, b);
    if (is_near(a.from, b) || is_near(a.to, b) || is_near(b.from, a) || is_near(b.to, a))
      return true;
    return cdt::orient(a.from, a.to, b.from) != cdt::orient(a.from, a.to, b.to) &&
           cdt::orient(b.from, b.to, a.from) != cdt::orient(b.from, b.to, a.to);
  }

  [[nodiscard]] bool are_apart() {
    std::vector<Box> boxes;
    boxes.reserve(edges_.size());
    for (const Edge& edge : edges_) {
      Box& box = boxes.emplace_back(edge.box());
      box.low = {box.low.x - nearest_, box.low.y - nearest_};
      box.high = {box.high.x + nearest_, box.high.y + nearest_};
    }
    TileGrid grid(edges_.size(), [&](std::uint32_t i) { return boxes[i]; });
    std::size_t steps_left = most_steps * edges_.size();
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      const bool is_apart = grid.all_of_near(boxes[i], [&](std::uint32_t j) {
        if (steps_left == 0) return false;
        --steps_left;
        return j <= i || !boxes_meet(boxes[i], boxes[j]) || !meet(edges_[i], edges_[j]);
      });
      if (steps_left == 0) return crowded_are_apart(boxes);
      if (!is_apart) return false;
    }
    return true;
  }

  /// The same by a tree of boxes: one long outline has nearly all of its edges in a few cells of a
  /// grid.
  [[nodiscard]] bool crowded_are_apart(std::span<const Box> boxes) const {
    std::vector<Box3> flat_boxes;
    flat_boxes.reserve(boxes.size());
    for (const Box& box : boxes) flat_boxes.push_back({flat(box.low), flat(box.high)});
    std::size_t steps_left = most_steps * edges_.size();
    const bool is_apart = BoxTree(flat_boxes).all_of_pairs([&](std::uint32_t i, std::uint32_t j) {
      if (steps_left == 0) return false;
      --steps_left;
      return !meet(edges_[i], edges_[j]);
    });
    return steps_left == 0 ? slanted_are_apart() : is_apart;
  }

  /// The same by a tree of turned boxes.
  [[nodiscard]] bool slanted_are_apart() const {
    std::vector<Corners> slim;
    std::vector<TrianglePairs::Vertices> none_common;
    for (const Edge& e : edges_) {
      const auto next = static_cast<std::uint32_t>(3 * slim.size());
      slim.push_back({flat(e.from), flat(e.to), flat(e.to)});
      none_common.push_back({next, next + 1, next + 2});
    }
    return TrianglePairs(slim, none_common, 3 * slim.size(), nearest_)
        .all_of([this](std::uint32_t i, std::uint32_t j) { return !meet(edges_[i], edges_[j]); });
  }

  /// A simple outline turns as it does at its smallest point.
  bool find_turns() {
    for (std::uint32_t c = 0; c < outlines_.size(); ++c) {
      const auto p = points(c);
      const std::uint32_t i = outlines_[c].smallest;
      const int turn =
          cdt::orient(p[i == 0 ? p.size() - 1 : i - 1], p[i], p[i + 1 == p.size() ? 0 : i + 1]);
      if (turn == 0) return false;
      outlines_[c].turns_left = turn > 0;
    }
    return true;
  }

  /// By the ray from p to the right; p is not near the contour.
  [[nodiscard]] bool encloses(std::uint32_t contour, Point p) const {
    bool is_inside = false;
    const auto all = points(contour);
    Point a = all.back();
    for (const Point b : all) {
      if ((a.y > p.y) != (b.y > p.y) && (cdt::orient(a, b, p) > 0) == (b.y > a.y))
        is_inside = !is_inside;
      a = b;
    }
    return is_inside;
  }

  [[nodiscard]] std::vector<OutlineDepth> find_depths() const {
    std::vector<Box3> boxes;
    boxes.reserve(outlines_.size());
    for (const Outline& outline : outlines_)
      boxes.push_back({flat(outline.box.low), flat(outline.box.high)});
    const BoxTree tree(boxes);
    const std::size_t most = most_steps * edges_.size();
    std::size_t steps = 0;
    std::vector<OutlineDepth> depths(outlines_.size());
    for (std::uint32_t c = 0; c < outlines_.size() && steps <= most; ++c) {
      const Point p = points(c)[outlines_[c].smallest];
      tree.for_each_meeting({flat(p), flat(p)}, [&](std::uint32_t d) {
        if (d == c || steps > most) return;
        steps += size(d);
        if (steps > most || !encloses(d, p)) return;
        ++depths[c].depth;
        depths[c].winding += outlines_[d].turns_left ? 1 : -1;
      });
    }
    return steps <= most ? depths : swept_depths();
  }

  [[nodiscard]] std::vector<OutlineDepth> swept_depths() const {
    std::vector<SimpleOutline> simple;
    for (std::uint32_t c = 0; c < outlines_.size(); ++c)
      simple.push_back({points(c), outlines_[c].turns_left});
    return outline_depths(simple);
  }

  /// Which way round each outline has the region on its left, from those that enclose it.
  bool find_directions(Fill rule) {
    const std::vector<OutlineDepth> depths = find_depths();
    for (std::uint32_t c = 0; c < outlines_.size(); ++c) {
      Outline& outline = outlines_[c];
      const auto [depth, winding] = depths[c];
      if (rule == Fill::even_odd) {
        outline.goes_left = depth % 2 == 0;
        continue;
      }
      const int within = winding + (outline.turns_left ? 1 : -1);
      if ((winding == 0) == (within == 0)) return false;  // a contour without effect
      outline.goes_left = winding == 0;
    }
    return true;
  }

  void add_loops(Region& region) const {
    std::vector<std::uint32_t> order(outlines_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::uint32_t c) { return points(c)[outlines_[c].smallest]; });
    region.points.reserve(edges_.size());
    region.origins.reserve(edges_.size());
    for (const std::uint32_t c : order) {
      const Outline& outline = outlines_[c];
      const bool is_forward = outline.turns_left == outline.goes_left;
      const std::uint32_t n = size(c);
      for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t i = (outline.smallest + (is_forward ? k : n - k)) % n;
        region.points.push_back(points(c)[i]);
        region.origins.push_back(
            {VertexKind::contour, contours_[c].slice, contours_[c].contour, i});
      }
      region.loop_starts.push_back(static_cast<std::uint32_t>(region.points.size()));
    }
    region.loop_vertices.resize(region.points.size());
    std::iota(region.loop_vertices.begin(), region.loop_vertices.end(), 0);
  }

  std::span<const ContourSource> contours_;
  double nearest_;
  std::vector<Edge> edges_;
  std::vector<Outline> outlines_;  // of each contour
};

}  // namespace

std::optional<Region> simple_region(std::span<const ContourSource> contours, double z, Fill rule,
                                    double least_distance) {
  return SimpleSlice(contours, least_distance).run(z, rule);
}

}  // namespace loft
