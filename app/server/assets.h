// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace loft::app {

/// A file of the viewer, built into the program.
struct Asset {
  std::string_view path;  ///< `/viewer.js`
  std::string_view type;  ///< `text/javascript`
  std::string_view content;
};

/// All of them; the page itself is `/`.
[[nodiscard]] std::span<const Asset> assets();

}  // namespace loft::app
