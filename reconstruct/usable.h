// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reconstruct/defect.h"
#include "reconstruct/slice.h"

namespace loft {

/// What is wrong with the numbers of a slice (DefectKind::not_finite), of its contours with one
/// label or of all; `index` is its number in the stack.
[[nodiscard]] std::vector<Defect> find_unusable(const Slice& slice, std::uint32_t index,
                                                const std::optional<std::string>& label = {});

}  // namespace loft
