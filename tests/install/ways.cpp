// SPDX-License-Identifier: MIT
// Finds a way through shapes, and uses nothing that this does not stand on.
#include <paths/shortest.h>

#include <vector>

int main() {
  using namespace loft;
  overlay::Overlay overlay;
  const overlay::LayerId room = overlay.add_layer("room");
  overlay.insert(room, std::vector<overlay::Point>{{0, 0}, {9, 0}, {9, 9}, {0, 9}});
  paths::FreeSpace space(overlay, room);
  space.keep_gaps();
  const paths::Path path = paths::shortest_path(space, {.from = {2, 2}, .to = {5, 6}, .radius = 1});
  return path.length == 5 ? 0 : 1;
}
