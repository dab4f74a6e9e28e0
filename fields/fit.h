// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "fields/vector.h"

namespace loft::fields {

/// A value at a place, as seen from somewhere.
struct Around {
  cdt::Point place;
  double value = 0;

  friend auto operator<=>(const Around&, const Around&) = default;
};

/// The plane that fits values best, weighted by the inverse squares of their distances from a place
/// where none of them is: its value there. None if they hardly fix a plane, being almost in one
/// line. Precondition: there is at least one.
[[nodiscard]] std::optional<double> plane_value(cdt::Point at, const std::vector<Around>& around);

/// The same, where they may be in one line or in one place: what does not follow from them is flat.
[[nodiscard]] double nearest_plane_value(cdt::Point at, const std::vector<Around>& around);

/// The gradient, at a place with a value, of the quadratic polynomial through it that fits others
/// best, weighted by the inverse fourth powers of distances, as what is left out grows with their
/// third; terms that they do not fix are left out.
[[nodiscard]] Vector fit_gradient(cdt::Point at, double value, std::span<const Around> around);

}  // namespace loft::fields
