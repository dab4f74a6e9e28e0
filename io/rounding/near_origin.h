// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "io/rounding/rounded_parts.h"

namespace loft::io {

/// Parts of one file without vertices, rounded to `float` about `origin`. None: about 0, if these
/// are solids there; otherwise, and where coordinates are so far from 0 that `float` says little of
/// them, about a place near them in round numbers, which `origin` is then.
[[nodiscard]] RoundedParts round_as_they_are(std::span<const Part> parts,
                                             std::optional<Vec3>& origin, unsigned threads = 1);

}  // namespace loft::io
