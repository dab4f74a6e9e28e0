// SPDX-License-Identifier: MIT
// Uses all layers: a frustum from two squares, checked and written.
#include <io/surfaces.h>
#include <reconstruct/check.h>
#include <reconstruct/measure.h>
#include <reconstruct/reconstruct.h>

#include <array>
#include <cmath>
#include <iostream>
#include <vector>

int main() {
  const std::vector<loft::Slice> slices{
      {0, {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, ""}}},
      {3, {{{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, ""}}},
  };
  const loft::Reconstructed frustum = loft::reconstruct(slices);
  loft::io::write("frustum.ply", std::array{loft::io::Part{"frustum", &frustum.surface}});

  const double expected = 28;  // 3/3 * (16 + 4 + sqrt(16 * 4))
  const double volume = loft::measure(loft::to_mesh(frustum.surface)).volume;
  const bool is_solid = loft::check(frustum.surface).empty();
  std::cout << "volume " << volume << (is_solid ? ", a solid\n" : ", not a solid\n");
  return is_solid && std::abs(volume - expected) < 1e-9 ? 0 : 1;
}
