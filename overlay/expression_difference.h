// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "overlay/expression.h"

namespace loft::overlay {

/// The layers that matter to the difference of two expressions, sorted: both say the same of every
/// place where none of these is. None known if they may disagree anywhere. Cost: O(terms).
[[nodiscard]] std::optional<std::vector<LayerId>> layers_of_difference(const Expression& a,
                                                                       const Expression& b);

}  // namespace loft::overlay
