// SPDX-License-Identifier: MIT
#include <pybind11/pybind11.h>

#include <string>

#include "io/meshes.h"
#include "io/stack.h"
#include "io/surfaces.h"
#include "io/unit.h"
#include "io/version.h"
#include "python/binding/errors.h"
#include "python/binding/job.h"
#include "python/binding/parts.h"

PYBIND11_MODULE(_loft, module) {
  using namespace loft::python;
  module.doc() = "What the package loft stands on: arrays in, arrays out.";
  module.attr("version") = std::string(loft::io::version());
  module.def("stack_extensions", &loft::io::stack_extensions);
  module.def("surface_extensions", &loft::io::surface_extensions);
  module.def("mesh_extensions", &loft::io::mesh_extensions);
  module.def("is_unit",
             [](const std::string& unit) { return loft::io::metres_per_unit(unit).has_value(); });
  module.def("wait_for_abandoned", &wait_for_abandoned);
  watch_forks();
  translate_errors();
  add_stack(module);
  add_volume(module);
  add_surface(module);
  add_reconstruct(module);
  add_meshes(module);
  add_triangulation(module);
  add_live(module);
}
