// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/triangulation.h"

namespace loft {

/// Numbers that something takes: 0, and magnitudes from `smallest` to `largest`. NaN and infinities
/// are in no range.
struct Range {
  double smallest;
  double largest;

  [[nodiscard]] constexpr bool admits(double value) const {
    const double size = value < 0 ? -value : value;
    return size == 0 || (size >= smallest && size <= largest);
  }
  /// The same for what has no sign: 0 is admitted.
  [[nodiscard]] constexpr bool admits_length(double value) const {
    return value >= 0 && admits(value);
  }
};

/// What every door of Loft admits, by quantity; tests/io/doors_test.cpp walks the table.
///
/// Exact arithmetic is exact as long as no product over- or underflows. That of the plane
/// multiplies up to four differences of coordinates, that of space three. A difference of two
/// numbers of at least s is 0 or at least s * 2^-52. What comes in has head-room on both sides of
/// what is worked with: shears and shifts add up numbers of the input, and their sums stay in the
/// range of the plane; points between others and rounded ends stay in that of a mesh.
namespace admitted {

/// x and y in a triangulation of the plane, and its epsilon.
inline constexpr Range planar{cdt::Triangulation::smallest_coordinate,
                              cdt::Triangulation::largest_coordinate};
/// x, y and z of slices; lengths and distances in options (not negative).
inline constexpr Range slice{1e-34, 1e70};
inline constexpr Range length{1e-30, 1e70};
/// x, y and z of a mesh that is checked: products of three differences.
inline constexpr Range mesh{1e-90, 1e90};
/// Metres a unit (positive): from far below an atom to far beyond what is seen of the sky.
inline constexpr Range unit{1e-20, 1e30};

static_assert(slice.smallest * 0x1p-52 >= planar.smallest, "what two numbers differ in is usable");
static_assert(slice.largest * 1e3 <= planar.largest, "so is what a few add up to");
static_assert(planar.smallest * 1e-30 >= mesh.smallest && planar.largest <= mesh.largest);

}  // namespace admitted

}  // namespace loft
