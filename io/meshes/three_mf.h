// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <span>

#include "io/meshes/part.h"

namespace loft::io {

/// Writes 3MF (core specification 1.3), as printers and their programs take it: an object a part,
/// named by its label, in its colour, all at their places. Coordinates have all digits, in the
/// unit of the input where 3MF knows it (micrometre, mm, cm, inch, foot, metre), in mm otherwise.
/// A part that is open is a `surface`, no `model`. Parts without faces are left out.
/// Throws Error where no part has faces, and in a build without libzip.
void write_3mf(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// What write_3mf() multiplies coordinates by.
[[nodiscard]] double three_mf_factor(double metres_per_unit);

}  // namespace loft::io
