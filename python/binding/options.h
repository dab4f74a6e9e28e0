// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "io/stacks/read_options.h"
#include "reconstruct/options.h"

namespace loft::python {

namespace py = pybind11;

/// Options by their names in the program, `_` in the place of `-`; None: not set. Throws InputError
/// for names and values that are none, with those that are.
[[nodiscard]] Options options_of(const py::dict& named);
[[nodiscard]] io::ReadOptions read_options_of(const py::dict& named);

}  // namespace loft::python
