// SPDX-License-Identifier: MIT
#include "mesh/sections.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <numeric>
#include <utility>

namespace loft {

namespace {

using cdt::Point;

/// An edge of the mesh that a plane meets.
struct Crossing {
  std::uint32_t below;
  std::uint32_t above;

  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

/// What a face adds to a section: from one of its edges to another.
struct Step {
  Crossing from;
  Crossing to;
};

class Cut {
 public:
  Cut(const Mesh& mesh, double z) : mesh_(mesh), z_(z) {}

  void add(std::uint32_t face) {
    const auto& corners = mesh_.faces[face];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t apex = corners[i];
      const std::uint32_t next = corners[(i + 1) % 3];
      const std::uint32_t last = corners[(i + 2) % 3];
      if (is_above(apex) == is_above(next) || is_above(apex) == is_above(last)) continue;
      // Seen from outside, with what is above on top, the way with the inside on its left goes from
      // left to right; the edge behind a corner is on the left of the one before it where that is
      // the upper one.
      if (is_above(apex)) {
        steps_.push_back({{next, apex}, {last, apex}});
      } else {
        steps_.push_back({{apex, last}, {apex, next}});
      }
    }
  }

  [[nodiscard]] Section run() {
    Section section;
    section.z = z_;
    std::ranges::sort(steps_, {}, [](const Step& s) { return std::pair(s.from, s.to); });
    is_done_.assign(steps_.size(), false);
    start_open_lines(section);
    for (std::size_t i = 0; i < steps_.size(); ++i)
      if (!is_done_[i]) follow(i, section);
    return section;
  }

 private:
  [[nodiscard]] bool is_above(std::uint32_t v) const { return mesh_.points[v][2] >= z_; }

  /// The point of an edge in the plane. An end in the plane is exact.
  [[nodiscard]] Point place(Crossing crossing) const {
    const Vec3& a = mesh_.points[crossing.below];
    const Vec3& b = mesh_.points[crossing.above];
    const double share = (z_ - a[2]) / (b[2] - a[2]);
    if (share >= 1) return {b[0], b[1]};
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
  }

  /// A step from an edge that is still to be gone.
  [[nodiscard]] std::size_t next(Crossing from) const {
    auto found = std::ranges::lower_bound(steps_, from, {}, &Step::from);
    while (found != steps_.end() && found->from == from) {
      const auto i = static_cast<std::size_t>(found - steps_.begin());
      if (!is_done_[i]) return i;
      ++found;
    }
    return steps_.size();
  }

  /// Lines that begin at a rim are gone first, so that no outline begins in the middle of one.
  void start_open_lines(Section& section) {
    std::vector<Crossing> ends;
    for (const Step& step : steps_) ends.push_back(step.to);
    std::ranges::sort(ends);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (is_done_[i] || std::ranges::binary_search(ends, steps_[i].from)) continue;
      follow(i, section);
    }
  }

  void follow(std::size_t step, Section& section) {
    const Crossing start = steps_[step].from;
    std::vector<Point> outline;
    for (; step < steps_.size(); step = next(steps_[step].to)) {
      is_done_[step] = true;
      const Point p = place(steps_[step].from);
      if (outline.empty() || outline.back() != p) outline.push_back(p);
      if (steps_[step].to == start) {
        if (outline.size() > 1 && outline.back() == outline.front()) outline.pop_back();
        if (outline.size() > 2) section.outlines.push_back(std::move(outline));
        return;
      }
    }
    ++section.open;
  }

  const Mesh& mesh_;
  double z_;
  std::vector<Step> steps_;
  std::vector<bool> is_done_;
};

}  // namespace

std::vector<Section> sections(const Mesh& mesh, std::span<const double> heights) {
  std::vector<std::size_t> order(heights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return heights[i]; });
  std::vector<Cut> cuts;
  for (const std::size_t i : order) cuts.emplace_back(mesh, heights[i]);
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    const auto [low, high] = std::minmax({mesh.points[a][2], mesh.points[b][2], mesh.points[c][2]});
    auto i = std::ranges::upper_bound(order, low, {}, [&](std::size_t k) { return heights[k]; });
    for (; i != order.end() && heights[*i] <= high; ++i)
      cuts[static_cast<std::size_t>(i - order.begin())].add(f);
  }
  std::vector<Section> made(heights.size());
  for (std::size_t i = 0; i < order.size(); ++i) made[order[i]] = cuts[i].run();
  return made;
}

}  // namespace loft
