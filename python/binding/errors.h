// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <span>

#include "reconstruct/defect.h"

namespace loft::python {

namespace py = pybind11;

/// (kind, message, z, slice, contour, point, place, area), as loft.Defect takes them.
[[nodiscard]] py::tuple to_tuple(const Defect& defect);
[[nodiscard]] py::list defect_list(std::span<const Defect> defects);

/// Loft's exceptions become those of loft/errors.py, with their fields.
void translate_errors();

}  // namespace loft::python
