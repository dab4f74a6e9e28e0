// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reconstruct/defect.h"

namespace loft::python {

namespace py = pybind11;

/// An array as Loft reads it: rows one after the other; others are copied.
template <class Number>
using Array = py::array_t<Number, py::array::c_style | py::array::forcecast>;

/// Throws InputError where an array has not so many dimensions, or columns.
template <class Number>
void require_shape(const Array<Number>& array, const char* what, py::ssize_t columns = 0) {
  const py::ssize_t dimensions = columns > 0 ? 2 : 1;
  if (array.ndim() == dimensions && (columns == 0 || array.shape(1) == columns)) return;
  std::string shape = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) shape += std::to_string(array.shape(i)) + ", ";
  throw InputError(std::string(what) + ": an array of shape (n" +
                   (columns > 0 ? ", " + std::to_string(columns) : ",") + ") is wanted, not " +
                   shape + ")");
}

/// Numbers in C++ as an array that cannot be written to, without a copy: `owner` lives as long.
template <class Number, class Owner>
py::array view(const Number* numbers, std::vector<py::ssize_t> shape,
               const std::shared_ptr<Owner>& owner) {
  const py::capsule keeper(new std::shared_ptr<const void>(owner), [](void* pointer) {
    delete static_cast<std::shared_ptr<const void>*>(pointer);
  });
  py::array_t<Number> array(std::move(shape), numbers, keeper);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// A vector of rows as an array of its own, (n, columns) or (n,).
template <class Number, std::size_t columns>
py::array to_array(std::vector<std::array<Number, columns>> rows) {
  auto owner = std::make_shared<const std::vector<std::array<Number, columns>>>(std::move(rows));
  return view(owner->empty() ? nullptr : owner->front().data(),
              {static_cast<py::ssize_t>(owner->size()), columns}, owner);
}

template <class Number>
py::array to_array(std::vector<Number> numbers) {
  auto owner = std::make_shared<const std::vector<Number>>(std::move(numbers));
  return view(owner->data(), {static_cast<py::ssize_t>(owner->size())}, owner);
}

}  // namespace loft::python
