// SPDX-License-Identifier: MIT
// Uses shapes that move, and nothing that they do not stand on.
#include <overlay/overlay.h>

#include <vector>

int main() {
  using namespace loft::overlay;
  Overlay overlay;
  const LayerId park = overlay.add_layer("park");
  const std::vector<Point> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  overlay.insert(park, square);
  return overlay.area(overlay.watch(park)).to_double() == 4 ? 0 : 1;
}
