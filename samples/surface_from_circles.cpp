// SPDX-License-Identifier: MIT
// Builds a vase from circles, closes it to a solid and writes it: surface_from_circles vase.glb
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "io/surfaces.h"
#include "reconstruct/reconstruct.h"

namespace {

loft::Contour circle(double radius, int points) {
  loft::Contour contour;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    contour.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return contour;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "vase.glb";

  std::vector<loft::Slice> slices;
  for (double z = 0; z <= 120; z += 2.5) {
    const double radius = 30 + 12 * std::sin(z / 19);
    loft::Slice slice{z, {circle(radius, 72)}};
    if (z > 5) slice.contours.push_back(circle(radius - 3, 60));  // the hollow, above the floor
    slices.push_back(slice);
  }

  const loft::Reconstructed vase = loft::reconstruct(slices);
  loft::io::write(path, std::array{loft::io::Part{"vase", &vase.surface}});
  std::cout << path << ": " << vase.surface.n_faces() << " triangles\n";
}
