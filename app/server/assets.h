// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace loft::app {

/// A file of a page, built into the program.
struct Asset {
  std::string_view path;  ///< `/viewer.js`
  std::string_view type;  ///< `text/javascript`
  std::string_view content;
};

/// All files of the viewer; the page itself is `/`.
[[nodiscard]] std::span<const Asset> assets();
/// Those of the page of `loft live`.
[[nodiscard]] std::span<const Asset> live_assets();

}  // namespace loft::app
