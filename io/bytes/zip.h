// SPDX-License-Identifier: MIT
// Archives by libzip. A build without it has none.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace loft::io {

struct ZipEntry {
  std::string name;
  std::string_view content;
};

[[nodiscard]] bool has_zip();
/// What to do where there is none.
inline constexpr std::string_view no_zip =
    "this build writes no zip archives; install libzip-dev (libzip) and build loft again";

/// The bytes of an archive: the same for the same entries, as all have the same date. Throws Error.
[[nodiscard]] std::string zip(std::span<const ZipEntry> entries);

}  // namespace loft::io
