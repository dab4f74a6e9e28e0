// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cdt/triangulation.h"

namespace loft::cdt {

/// By rational arithmetic, knowing nothing of check(): each segment's edges lead from its start to
/// its end, and no vertex on the way is further from it than 2^-50 of its largest coordinate. What
/// is wrong first, in words; empty if nothing is.
[[nodiscard]] std::string wrong_course(const Triangulation& mesh);

}  // namespace loft::cdt
