// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace loft::io {

/// The bytes of a raw deflate stream, as Deflated Explicit VR Little Endian has them. Throws
/// InputError where the stream is damaged or cut off, or inflates to more than any data set of this
/// transfer syntax needs.
[[nodiscard]] std::string inflate(std::string_view bytes, std::string_view name);

}  // namespace loft::io
