// SPDX-License-Identifier: MIT
// A target for libFuzzer: bytes are edits of shapes in three layers. What follows the edits must be
// what a fresh build has, and every result's polygons must be valid and have its area.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "overlay/validity.h"
#include "tests/fuzz/edit_bytes.h"
#include "tests/overlay/player.h"

namespace loft::overlay {
namespace {

void demand(bool holds, const char* what, const cdt::Script& script) {
  if (holds) return;
  std::fprintf(stderr, "%s\n%s\n", what, cdt::as_text(script).c_str());
  std::abort();
}

void judge(const Player& player, const cdt::Script& script) {
  const Overlay& overlay = player.overlay();
  for (const ResultId result : player.results()) {
    const MultiPolygon polygons = overlay.polygons(result);
    demand(area(polygons) == overlay.area(result), "polygons of another area", script);
    demand(is_valid(polygons), "polygons that are not valid", script);
  }
  if (!overlay.triangulation().snaps().empty()) return;
  const Player fresh = player.fresh();
  for (std::size_t i = 0; i < player.results().size(); ++i) {
    const ResultId result = player.results()[i];
    const ResultId other = fresh.results()[i];
    demand(overlay.area(result) == fresh.overlay().area(other), "not the fresh area", script);
    demand(overlay.polygons(result) == fresh.overlay().polygons(other), "not the fresh polygons",
           script);
  }
}

}  // namespace
}  // namespace loft::overlay

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  const cdt::Script script = cdt::EditBytes({bytes, size}).script();
  overlay::Player player;
  std::size_t count = 0;
  for (const cdt::Edit& edit : script) {
    player.play(edit);
    if (++count % 8 == 0 || count == script.size()) overlay::judge(player, script);
  }
  return 0;
}
