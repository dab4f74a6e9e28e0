// SPDX-License-Identifier: MIT
#include "python/binding/errors.h"

#include <pybind11/stl.h>

#include <exception>
#include <stdexcept>

#include "io/bytes/file.h"
#include "reconstruct/reconstruct.h"

namespace loft::python {

namespace {

/// File names need not be UTF-8.
py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      bytes.data(), static_cast<py::ssize_t>(bytes.size()), "surrogateescape"));
}

template <class... Values>
void raise(const char* type, const Values&... values) {
  const py::object error = py::module_::import("loft.errors").attr(type);
  PyErr_SetObject(error.ptr(), error(values...).ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const InputError& error) {
    raise("InputError", text(error.what()), defect_list(error.defects()));
  } catch (const io::FileError& error) {
    raise("FileError", text(error.what()), text(error.path().string()));
  } catch (const io::UnknownFormat& error) {
    raise("InputError", text(error.what()));
  } catch (const Cancelled& error) {
    raise("Cancelled", text(error.what()));
  } catch (const Error& error) {
    raise("Error", text(error.what()));
  } catch (const std::invalid_argument& error) {
    raise("InputError", text(error.what()));
  } catch (const std::length_error& error) {
    PyErr_SetString(PyExc_MemoryError, error.what());
  }
}

}  // namespace

py::tuple to_tuple(const Defect& defect) {
  py::object place = py::none();
  if (defect.place) place = py::make_tuple(defect.place->x, defect.place->y);
  return py::make_tuple(name(defect.kind), defect.message, defect.z, defect.slice, defect.contour,
                        defect.point, place, defect.area);
}

py::list defect_list(std::span<const Defect> defects) {
  py::list list;
  for (const Defect& defect : defects) list.append(to_tuple(defect));
  return list;
}

void translate_errors() { py::register_exception_translator(translate); }

}  // namespace loft::python
