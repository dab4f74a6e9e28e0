// SPDX-License-Identifier: MIT
#include "cdt/regions.h"

namespace loft::cdt {

namespace {

/// Calls visit(passage) for the passages along e that belong to chosen constraints.
template <class Visit>
void for_each_chosen(const Triangulation& mesh, EdgeId e, const ConstraintFilter& is_chosen,
                     Visit visit) {
  for (const Passage passage : mesh.passages(e))
    if (!is_chosen || is_chosen(mesh.segment(passage.segment()).constraint)) visit(passage);
}

}  // namespace

std::vector<int> winding_numbers(const Triangulation& mesh, const ConstraintFilter& is_chosen) {
  return flood(mesh, 0, [&](EdgeId e, int value) {
    // Leaving the left side of e: a passage along e had it on its left, too.
    for_each_chosen(mesh, e, is_chosen,
                    [&](Passage passage) { value += mesh.is_forward(e, passage) ? -1 : 1; });
    return value;
  });
}

std::vector<bool> odd_parity(const Triangulation& mesh, const ConstraintFilter& is_chosen) {
  return flood<bool>(mesh, false, [&](EdgeId e, bool value) {
    for_each_chosen(mesh, e, is_chosen, [&](Passage) { value = !value; });
    return value;
  });
}

}  // namespace loft::cdt
