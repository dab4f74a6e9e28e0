// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace loft::io {

/// The version of loft, for example `0.1.0`.
[[nodiscard]] std::string_view version();

/// What files written by loft name as their author: `loft 0.1.0`.
[[nodiscard]] std::string_view generator();

}  // namespace loft::io
