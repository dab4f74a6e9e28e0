// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace loft::io {

/// The names that metres_per_unit() knows, and that it takes a number, too.
constexpr std::string_view unit_names =
    "m, cm, mm, um, nm, in, ft or a number of metres from 1e-20 to 1e30";

/// The length in metres of a unit given by name or as a number that admitted::unit has; none
/// if it is neither.
[[nodiscard]] std::optional<double> metres_per_unit(std::string_view unit);

}  // namespace loft::io
