// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <span>

#include "mesh/check.h"
#include "mesh/measure.h"

namespace loft::python {

/// By the names of Measures, angles among them.
[[nodiscard]] pybind11::dict measures_dict(const Measures& measures);
/// (fault, faces, vertices) of each.
[[nodiscard]] pybind11::list finding_list(std::span<const Finding> findings);

}  // namespace loft::python
