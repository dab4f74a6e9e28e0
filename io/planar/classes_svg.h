// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <ostream>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "fields/classes.h"
#include "io/planar/palette.h"

namespace loft::io {

/// A point that is classified, in a picture.
struct ClassDot {
  cdt::Point place;
  std::vector<fields::Sign> signs;
  double share = 1;  ///< how dark it is: 0 for the least value, 1 for the largest
};

/// Points, the separators that classify them, and what the plane falls into.
struct ClassPicture {
  cdt::Box box;  ///< what is shown
  std::vector<fields::ClassFace> faces = {};
  std::vector<std::vector<cdt::Point>> separators = {};  ///< two points at least
  std::vector<ClassDot> dots = {};                       ///< later ones lie above
};

/// The hue of a class: faces that differ in one sign have different hues, and the classes of three
/// separators have one each. `on` counts as right.
[[nodiscard]] std::size_t class_hue(std::span<const fields::Sign> signs);

/// The paper's way (Kallmann, Bieri and Thalmann 2003, section 7): a point's value makes its colour
/// lighter or darker, its class makes the hue. What is on a separator is grey.
[[nodiscard]] Colour class_colour(std::span<const fields::Sign> signs, double share);

/// Draws faces in the pale tones of their classes, separators as far as the picture reaches, and
/// points as dots. Coordinates are rounded to hundredths of a pixel. The same picture gives the
/// same bytes. Cost: O(n log n).
void write_classes_svg(std::ostream& out, const ClassPicture& picture, double width = 1200);

}  // namespace loft::io
