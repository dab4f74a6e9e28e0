// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <istream>
#include <span>
#include <string_view>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// Reads orders to link contours, or not to: NDJSON, an order a line.
///
///     {"from": [slice, contour], "to": [slice, contour], "link": true}
///
/// `slice` is the index of a slice in the stack, in the order of the input, from 0; `contour` the
/// index of a contour in it. A slice may also be named by its height: `{"z": 1.25, "contour": 2}`
/// in the place of the pair; where several have that height, the first. `link` false keeps the two
/// apart; it is true where it is left out. Blank lines and unknown keys are ignored, misspelt keys
/// are errors as in a stack (slices_json.h).
///
/// Throws InputError that names `name` and line of each problem (the first 20, and how many more),
/// also for what find_bad_orders() finds; FileError if reading fails. Cost: O(orders * log).
[[nodiscard]] std::vector<LinkOrder> read_links_json(std::istream& in, std::string_view name,
                                                     std::span<const Slice> slices);

/// The same from a file.
[[nodiscard]] std::vector<LinkOrder> read_links_json(const std::filesystem::path& path,
                                                     std::span<const Slice> slices);

}  // namespace loft::io
