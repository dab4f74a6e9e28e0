// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace loft::io {

/// Whether bytes begin as a gzip file does.
[[nodiscard]] bool is_gzip(std::string_view bytes);

/// The first `most` bytes of what gzip (all of its members) or zlib has packed; fewer if there are
/// no more. What follows them is not looked at. Memory: what comes out.
///
/// Throws InputError, with `name` and the byte offset in `bytes` where the packed bytes are wrong
/// or end too early; `offset` is that of their first one.
[[nodiscard]] std::string inflate_first(std::string_view bytes, std::uint64_t most,
                                        std::string_view name, std::uint64_t offset = 0);

/// The same for exactly `size` bytes. Throws InputError if there are fewer, before any memory is
/// taken where packed bytes are too few to hold so many.
[[nodiscard]] std::string inflate_all(std::string_view bytes, std::uint64_t size,
                                      std::string_view name, std::uint64_t offset = 0);

}  // namespace loft::io
