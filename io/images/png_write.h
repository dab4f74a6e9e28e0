// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace loft::io {

/// A PNG of so many columns, from red, green, blue and opacity of each pixel, row by row from the
/// top. The same pixels give the same bytes. Throws std::runtime_error where libpng fails, or this
/// build has none. Precondition: whole rows, one at least.
[[nodiscard]] std::string to_png(std::span<const std::uint8_t> pixels, std::size_t columns);

/// Whether to_png() can do it.
[[nodiscard]] bool writes_png();

}  // namespace loft::io
