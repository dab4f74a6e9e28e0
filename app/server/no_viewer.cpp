// SPDX-License-Identifier: MIT
#include <array>

#include "app/server/assets.h"

namespace loft::app {

// The program was built without its pages.

std::span<const Asset> assets() {
  static constexpr std::array page{Asset{
      "/", "text/html; charset=utf-8",
      "<!doctype html><html lang=\"en\"><title>loft</title><body><h1>loft</h1><p>This program was "
      "built without its viewer, for which npm is needed. The surface: <a "
      "href=\"/surface.glb\">GLB</a>, <a href=\"/surface.ply\">PLY</a>; <a "
      "href=\"/status\">status</a>.</p></body></html>"}};
  return page;
}

std::span<const Asset> live_assets() {
  static constexpr std::array page{Asset{
      "/", "text/html; charset=utf-8",
      "<!doctype html><html lang=\"en\"><title>loft</title><body><h1>loft</h1><p>This program was "
      "built without its pages, for which npm is needed. Edits and events are served all the same: "
      "<a href=\"/tabs\">tabs</a>.</p></body></html>"}};
  return page;
}

}  // namespace loft::app
