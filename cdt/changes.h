// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/ids.h"

namespace loft::cdt {

/// What an edit did to the triangles, for whoever keeps something beside each of them: forget what
/// belongs to those in `unmade`, then compute it for those in `made`. Ids are reused: a triangle
/// with other corners than before is in both lists. Both are sorted; infinite triangles count.
struct Changes {
  std::vector<TriangleId> unmade;  ///< were there before the edit, are not there as they were
  std::vector<TriangleId> made;    ///< are there now, were not or had other corners or edges before
};

}  // namespace loft::cdt
