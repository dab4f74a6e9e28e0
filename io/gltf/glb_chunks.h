// SPDX-License-Identifier: MIT
// GLB is a header of three numbers, then chunks with their sizes: JSON, bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace loft::io {

/// The JSON of a GLB; none where it, or the chunk behind it, is cut off.
[[nodiscard]] std::optional<std::string_view> json_chunk(std::string_view glb);

/// The same file with other JSON. Precondition: json_chunk() finds the old one.
[[nodiscard]] std::string with_json(std::string_view glb, std::string json);

}  // namespace loft::io
