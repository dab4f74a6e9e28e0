// SPDX-License-Identifier: MIT
// Builds a surface slice by slice, as a scanner or an operator would, and says what each edit
// changed: edit_by_edit part.glb
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "io/surfaces.h"
#include "reconstruct/reconstruction.h"

namespace {

loft::Contour circle(double radius, loft::cdt::Point centre) {
  constexpr int points = 64;
  loft::Contour contour;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    contour.points.push_back(
        {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return contour;
}

/// A trunk that forks.
loft::Slice slice(double z) {
  if (z < 5) return {z, {circle(10, {0, 0})}};
  const double apart = 6 + z / 2;
  return {z, {circle(5, {-apart, 0}), circle(5, {apart, 0})}};
}

void say(const std::string& edit, const loft::SurfaceChange& change) {
  std::cout << edit << ": " << change.removed.size() << " slabs gone, " << change.added.size()
            << " made, " << change.faces_removed << " triangles gone, " << change.faces_added
            << " new\n";
}

}  // namespace

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "part.glb";
  loft::Reconstruction part({.smooth = true});

  // Slices may come in any order.
  for (const double z : {0.0, 9.0, 3.0, 6.0, 7.0, 1.5, 4.5})
    say("insert z = " + std::to_string(z), part.insert(slice(z)));

  // An operator drags a contour, redraws a slice, takes one out.
  say("move a contour", part.move_contour(7, 1, circle(5, {11, 2}).points));
  loft::Slice redrawn = slice(3);
  redrawn.contours.push_back(circle(4, {0, 0}));  // a cavity
  say("replace z = 3", part.replace(3, std::move(redrawn)));
  say("remove z = 1.5", part.remove(1.5));

  // A bad edit changes nothing.
  try {
    part.insert({2, {{{{0, 0}, {1, 0}, {NAN, 1}}, ""}}});
  } catch (const loft::InputError& error) {
    std::cout << "refused: " << error.what() << '\n';
  }

  const loft::Surface surface = part.snapshot().surface();
  loft::io::write(path, std::array{loft::io::Part{"part", &surface}});
  std::cout << path << ": " << surface.n_faces() << " triangles, volume " << part.volume() << '\n';
}
