// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

#include "reconstruct/surface.h"

namespace loft::python {

namespace py = pybind11;

/// A surface that Python's arrays look into; it never changes. Several may look at once.
class SharedSurface {
 public:
  explicit SharedSurface(std::shared_ptr<const Surface> surface) : surface_(std::move(surface)) {}

  [[nodiscard]] const std::shared_ptr<const Surface>& get() const { return surface_; }

 private:
  std::shared_ptr<const Surface> surface_;
};

// Each adds what it is called after to the module.
void add_stack(py::module_& module);
void add_volume(py::module_& module);
void add_surface(py::module_& module);
void add_reconstruct(py::module_& module);
void add_meshes(py::module_& module);
void add_triangulation(py::module_& module);
void add_live(py::module_& module);

}  // namespace loft::python
