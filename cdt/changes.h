// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/ids.h"

namespace loft::cdt {

/// What an edit did to the triangles, for whoever keeps something beside each of them: forget what
/// belongs to those in `unmade`, then compute it for those in `made`. Ids are reused: a triangle
/// with other corners than before is in both lists. All are sorted; infinite triangles count.
struct Changes {
  std::vector<TriangleId> unmade;  ///< were there before the edit, are not there as they were
  std::vector<TriangleId> made;    ///< are there now, were not or had other corners or edges before
  /// Of those in both lists the ones that have the same corners, and along each side the same
  /// segments, as before: what is new is where the corners are. So what depends on who is whose
  /// neighbour alone is still there.
  std::vector<TriangleId> moved;
};

/// Of `some`, which are `unmade` or `made` of these changes, those that have not only moved, in
/// order: take(triangle).
template <class Take>
void for_each_not_moved(const Changes& changes, const std::vector<TriangleId>& some, Take take) {
  auto moved = changes.moved.begin();
  for (const TriangleId t : some) {
    if (moved != changes.moved.end() && *moved == t)
      ++moved;
    else
      take(t);
  }
}

}  // namespace loft::cdt
