// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "cdt/triangulation.h"

namespace loft::cdt {

/// A value for every triangle (by its id), spread from the outside inwards: infinite triangles have
/// `outside`, and a neighbour across edge e has cross(e, value), where e has the value's triangle
/// on its left. Edges without passages are passed unchanged. Precondition: crossing edges leads to
/// the same value on every way (true of anything that adds up passages of closed polylines). Cost:
/// O(triangles).
template <class Value, class Cross>
[[nodiscard]] std::vector<Value> flood(const Triangulation& mesh, Value outside, Cross cross) {
  std::vector<Value> values(mesh.triangle_bound(), outside);
  if (mesh.triangle_count() == 0) return values;
  std::vector<bool> is_reached(mesh.triangle_bound());
  std::vector<TriangleId> front{Triangulation::triangle(mesh.edge(Triangulation::infinite))};
  is_reached[front.front().index()] = true;
  while (!front.empty()) {
    const TriangleId t = front.back();
    front.pop_back();
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const TriangleId beyond = Triangulation::triangle(mesh.twin(e));
      if (is_reached[beyond.index()]) continue;
      is_reached[beyond.index()] = true;
      const Value here = values[t.index()];
      values[beyond.index()] = mesh.is_constrained(e) ? cross(e, here) : here;
      front.push_back(beyond);
    }
  }
  return values;
}

/// Chooses among constraints.
using ConstraintFilter = std::function<bool(ConstraintId)>;

/// How often the chosen closed constraints wind around each triangle, counter-clockwise positive.
[[nodiscard]] std::vector<int> winding_numbers(const Triangulation& mesh,
                                               const ConstraintFilter& is_chosen = {});

/// Whether an odd number of edges of the chosen closed constraints is between each triangle and
/// the outside.
[[nodiscard]] std::vector<bool> odd_parity(const Triangulation& mesh,
                                           const ConstraintFilter& is_chosen = {});

}  // namespace loft::cdt
