// SPDX-License-Identifier: MIT
#include "reconstruct/link/parts.h"

#include <algorithm>
#include <utility>

#include "reconstruct/tile/slab.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::TriangleId;
using cdt::Triangulation;

class PartFinder {
 public:
  explicit PartFinder(const Slab& slab) : slab_(slab), mesh_(slab.overlay()) {}

  PartGraph run() {
    PartGraph graph;
    graph.lower_count = label(Level::lower, graph.lower_part);
    const std::vector<std::uint32_t> lower = label_;
    graph.upper_count = label(Level::upper, graph.upper_part);
    std::vector<std::pair<PartGraph::Overlap, double>> shared;  // of triangles, with their areas
    for (std::uint32_t t = 0; t < label_.size(); ++t)
      if (lower[t] != Origin::none && label_[t] != Origin::none)
        shared.push_back({{lower[t], label_[t]}, area(TriangleId(t))});
    std::ranges::sort(shared);
    for (const auto& [overlap, area] : shared) {
      if (graph.overlaps.empty() || graph.overlaps.back() != overlap) {
        graph.overlaps.push_back(overlap);
        graph.areas.push_back(0);
      }
      graph.areas.back() += area;
    }
    return graph;
  }

 private:
  [[nodiscard]] bool is_inside(EdgeId e, Level level) const {
    const auto bit = static_cast<unsigned>(level == Level::lower ? Side::lower : Side::upper);
    return (static_cast<unsigned>(slab_.side(e)) & bit) != 0;
  }

  [[nodiscard]] double area(TriangleId t) const {
    const auto corner = [&](unsigned i) {
      return mesh_.point(mesh_.from(Triangulation::edge(t, i)));
    };
    const cdt::Point a = corner(0);
    const cdt::Point b = corner(1);
    const cdt::Point c = corner(2);
    return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }

  /// Numbers the parts of a slice in label_, for each triangle; for each loop the part on its left.
  std::uint32_t label(Level level, std::vector<std::uint32_t>& part_of_loop) {
    label_.assign(mesh_.triangle_bound(), Origin::none);
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < mesh_.triangle_bound(); ++t) {
      if (label_[t] != Origin::none || !mesh_.is_triangle(TriangleId(t))) continue;
      if (is_inside(Triangulation::edge(TriangleId(t)), level)) fill(TriangleId(t), level, count++);
    }
    const Region& region = slab_.region(level);
    part_of_loop.assign(region.loop_count(), Origin::none);
    for (std::uint32_t i = 0; i < mesh_.edge_bound(); ++i) {
      const EdgeId e(i);
      if (!mesh_.is_triangle(Triangulation::triangle(e)) || !is_inside(e, level)) continue;
      for (const cdt::Passage passage : mesh_.passages(e)) {
        if (slab_.level(passage.segment()) != level) continue;
        part_of_loop[slab_.loop(passage.segment())] = label_[Triangulation::triangle(e).index()];
      }
    }
    return count;
  }

  void fill(TriangleId start, Level level, std::uint32_t part) {
    std::vector<TriangleId> front{start};
    label_[start.index()] = part;
    while (!front.empty()) {
      const TriangleId t = front.back();
      front.pop_back();
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = Triangulation::edge(t, corner);
        const TriangleId beyond = Triangulation::triangle(mesh_.twin(e));
        if (label_[beyond.index()] != Origin::none || slab_.is_contour(e, level)) continue;
        label_[beyond.index()] = part;
        front.push_back(beyond);
      }
    }
  }

  const Slab& slab_;
  const Triangulation& mesh_;
  std::vector<std::uint32_t> label_;  // the part of each triangle, or none
};

/// Whether each loop has a part. One that is little larger than what is taken for a contact may
/// have lost its inside to a vertex of the other slice.
bool has_all_loops(const PartGraph& graph) {
  const auto has_all = [](const std::vector<std::uint32_t>& parts) {
    return std::ranges::find(parts, Origin::none) == parts.end();
  };
  return has_all(graph.lower_part) && has_all(graph.upper_part);
}

}  // namespace

PartGraph find_parts(const Region& lower, const Region& upper) {
  const Slab slab(lower, upper);
  const double contact = loft::contact(lower, upper);
  if (slab.has_near_contact(contact)) {
    if (const auto merged = Slab::merged(lower, upper, {}, contact)) {
      PartGraph graph = PartFinder(*merged).run();
      if (has_all_loops(graph)) return graph;
    }
  }
  return PartFinder(slab).run();
}

}  // namespace loft
