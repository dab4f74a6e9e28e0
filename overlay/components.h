// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "cdt/triangulation.h"
#include "overlay/trace.h"

namespace loft::overlay {

/// What triangles fall into where some belong and some edges part them: each component is a region
/// of its own, counted from 1 in the order of their first triangles.
class Components {
 public:
  /// has(triangle), parts(edge), the latter asked of constrained edges only. Cost: O(triangles).
  template <class Has, class Parts>
  Components(const cdt::Triangulation& mesh, Has has, Parts parts)
      : mesh_(&mesh), mark_of_(mesh.triangle_bound(), CoverId(0)) {
    std::vector<bool> belongs(mesh.triangle_bound());
    for (std::uint32_t i = 0; i < belongs.size(); ++i)
      belongs[i] = mesh.is_triangle(cdt::TriangleId(i)) && has(cdt::TriangleId(i));
    for (std::uint32_t i = 0; i < belongs.size(); ++i)
      if (belongs[i] && mark_of_[i].index() == 0) spread(cdt::TriangleId(i), belongs, parts);
    numbers_.resize(count_ + 1);
    std::iota(numbers_.begin(), numbers_.end(), 0U);
  }

  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// 0 where it belongs to none.
  [[nodiscard]] std::uint32_t operator[](cdt::TriangleId t) const {
    return mark_of_[t.index()].index();
  }
  /// A view.
  [[nodiscard]] Regions regions() const {
    return {.mesh = mesh_, .covers = mark_of_, .region_of = numbers_};
  }

 private:
  template <class Parts>
  void spread(cdt::TriangleId start, const std::vector<bool>& belongs, Parts parts) {
    const CoverId mark(++count_);
    mark_of_[start.index()] = mark;
    std::vector<cdt::TriangleId> front{start};
    while (!front.empty()) {
      const cdt::TriangleId t = front.back();
      front.pop_back();
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = cdt::Triangulation::edge(t, corner);
        const cdt::TriangleId beyond = cdt::Triangulation::triangle(mesh_->twin(e));
        if (!belongs[beyond.index()] || mark_of_[beyond.index()].index() != 0) continue;
        if (mesh_->is_constrained(e) && parts(e)) continue;
        mark_of_[beyond.index()] = mark;
        front.push_back(beyond);
      }
    }
  }

  const cdt::Triangulation* mesh_;
  std::uint32_t count_ = 0;
  std::vector<CoverId> mark_of_;        // by triangle
  std::vector<std::uint32_t> numbers_;  // each for itself
};

}  // namespace loft::overlay
