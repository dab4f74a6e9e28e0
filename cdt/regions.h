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
  std::vector<TriangleId> front;
  std::vector<EdgeId> fences;  // constrained, from the side that was reached
  const auto reach = [&](TriangleId t, const Value& value) {
    is_reached[t.index()] = true;
    values[t.index()] = value;
    front.push_back(t);
  };
  const auto is_reached_beyond = [&](EdgeId e) {
    return is_reached[Triangulation::triangle(mesh.twin(e)).index()];
  };
  reach(Triangulation::triangle(mesh.edge(Triangulation::infinite)), outside);
  while (true) {
    // All that has the same value first: so few edges are crossed.
    while (!front.empty()) {
      const TriangleId t = front.back();
      front.pop_back();
      const Value here = values[t.index()];
      for (unsigned corner = 0; corner < 3; ++corner) {
        const EdgeId e = Triangulation::edge(t, corner);
        if (is_reached_beyond(e)) continue;
        if (mesh.is_constrained(e))
          fences.push_back(e);
        else
          reach(Triangulation::triangle(mesh.twin(e)), here);
      }
    }
    while (!fences.empty() && is_reached_beyond(fences.back())) fences.pop_back();
    if (fences.empty()) return values;
    const EdgeId e = fences.back();
    const Value here = values[Triangulation::triangle(e).index()];
    reach(Triangulation::triangle(mesh.twin(e)), cross(e, here));
  }
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
