// SPDX-License-Identifier: MIT
// Uses all layers: a frustum from two squares, checked and written; and made slice by slice.
#include <io/surfaces.h>
#include <mesh/check.h>
#include <mesh/measure.h>
#include <reconstruct/reconstruct.h>
#include <reconstruct/reconstruction.h>

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

  loft::Reconstruction live;
  for (const loft::Slice& slice : slices) live.insert(slice);

  constexpr double expected = 28;  // 3/3 * (16 + 4 + sqrt(16 * 4))
  const double volume = loft::measure(loft::to_mesh(frustum.surface)).volume;
  const bool is_solid = loft::check(frustum.surface).empty();
  std::cout << "volume " << volume << (is_solid ? ", a solid\n" : ", not a solid\n");
  const auto is_expected = [](double v) { return std::abs(v - expected) < 1e-9; };
  return is_solid && is_expected(volume) && is_expected(live.volume()) ? 0 : 1;
}
