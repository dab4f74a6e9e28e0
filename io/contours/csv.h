// SPDX-License-Identifier: MIT
#pragma once

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads points from a table of text: a line a point, columns apart by tabs, semicolons, commas or
/// blanks. Numbers have a point or, where no comma parts columns, a comma.
///
/// A header names the columns, in any order: `x`, `y`, `z` (or `height`, `elevation`), `contour`
/// (or `contour_id`, `loop`, `ring`, `polygon`, `curve`), `label` (or `name`, `structure`, `roi`,
/// `organ`, `object`), capitals aside; what is in brackets behind is the unit: `x [mm]`. Others are
/// ignored. Without a header the columns are x y z contour label, as many as there are.
///
/// A contour ends where contour, label or height change, and at a blank line. Lines that begin with
/// `#` are comments (the first may be the header). Throws InputError that lists the bad lines.
[[nodiscard]] Stack read_csv(const StackInput& input, const ReadOptions& options);

}  // namespace loft::io
