// SPDX-License-Identifier: MIT
#include "io/volumes/volume.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "io/volumes/outlines.h"
#include "python/binding/arrays.h"
#include "python/binding/job.h"
#include "python/binding/options.h"
#include "python/binding/parts.h"

namespace loft::python {

namespace {

/// Pixels of a row as doubles; `step` bytes from one to the next.
using ReadRow = void (*)(const char* first, py::ssize_t step, std::span<double> row);

template <class Number>
void read_row(const char* pixel, py::ssize_t step, std::span<double> row) {
  for (double& value : row) {
    value = static_cast<double>(*reinterpret_cast<const Number*>(pixel));
    pixel += step;
  }
}

ReadRow reader_of(const py::array& array) {
  const char kind = array.dtype().kind();
  const py::ssize_t size = array.itemsize();
  if (kind == 'b') return read_row<std::uint8_t>;
  if (kind == 'f' && size == 4) return read_row<float>;
  if (kind == 'f' && size == 8) return read_row<double>;
  if (kind == 'u' || kind == 'i') {
    const bool is_signed = kind == 'i';
    if (size == 1) return is_signed ? read_row<std::int8_t> : read_row<std::uint8_t>;
    if (size == 2) return is_signed ? read_row<std::int16_t> : read_row<std::uint16_t>;
    if (size == 4) return is_signed ? read_row<std::int32_t> : read_row<std::uint32_t>;
    if (size == 8) return is_signed ? read_row<std::int64_t> : read_row<std::uint64_t>;
  }
  throw InputError("pixels: numbers are wanted, not " +
                   py::cast<std::string>(py::str(array.dtype())));
}

/// An array's pixels, by slice, row and column, in its own memory.
struct Layer {
  Kept array;
  ReadRow read = nullptr;
  const char* first = nullptr;
  std::array<py::ssize_t, 3> steps{};

  explicit Layer(const py::array& pixels)
      : array(pixels),
        read(reader_of(pixels)),
        first(static_cast<const char*>(pixels.data())),
        steps{pixels.strides(0), pixels.strides(1), pixels.strides(2)} {}
};

std::uint32_t size_of(const py::array& array, py::ssize_t axis) {
  const py::ssize_t size = array.shape(axis);
  if (size > std::numeric_limits<std::int32_t>::max())
    throw InputError("pixels: more than 2^31 along an axis");
  return static_cast<std::uint32_t>(size);
}

std::vector<Layer> layers_of(const std::vector<py::array>& arrays) {
  if (arrays.empty()) throw InputError("pixels: there are none");
  std::vector<Layer> layers;
  for (const py::array& array : arrays) {
    if (array.ndim() != 3)
      throw InputError("pixels: an array of three axes, z, y, x, is wanted, not of " +
                       std::to_string(array.ndim()));
    for (py::ssize_t axis = 0; axis < 3; ++axis)
      if (array.shape(axis) != arrays[0].shape(axis))
        throw InputError("pixels: all layers must have the same shape");
    layers.emplace_back(array);
  }
  return layers;
}

/// Name, layer and value.
using PixelLabel = std::tuple<std::string, std::uint32_t, double>;

void tell_pixel_labels(io::Volume& volume, const std::vector<PixelLabel>& labels) {
  for (const auto& [name, layer, value] : labels)
    volume.labels.push_back({StackLabel{name}, layer, value});
}

void set_world(io::Volume& volume, const Array<double>& to_world) {
  require_shape(to_world, "affine", 4);
  if (to_world.shape(0) < 3) throw InputError("affine: a matrix of 4 by 4 is wanted");
  for (py::ssize_t i = 0; i < 3; ++i)
    for (py::ssize_t k = 0; k < 4; ++k)
      volume.to_world[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = to_world.at(i, k);
}

std::shared_ptr<Stack> trace(const std::vector<py::array>& arrays, const Array<double>& to_world,
                             const std::vector<PixelLabel>& labels,
                             const std::optional<double>& level, const std::string& unit,
                             const py::dict& options) {
  io::Volume volume;
  auto layers = std::make_shared<const std::vector<Layer>>(layers_of(arrays));
  volume.name = "pixels";
  volume.slices = size_of(arrays[0], 0);
  volume.rows = size_of(arrays[0], 1);
  volume.columns = size_of(arrays[0], 2);
  volume.layers = static_cast<std::uint32_t>(arrays.size());
  volume.level = level;
  volume.unit = unit;
  tell_pixel_labels(volume, labels);
  set_world(volume, to_world);
  volume.read = [layers, columns = volume.columns](std::uint32_t slice, std::uint32_t number,
                                                   std::span<double> pixels) {
    const Layer& layer = (*layers)[number];
    const char* row = layer.first + static_cast<py::ssize_t>(slice) * layer.steps[0];
    for (; !pixels.empty(); pixels = pixels.subspan(columns), row += layer.steps[1])
      layer.read(row, layer.steps[2], pixels.first(columns));
  };
  return result_of(py::none(), [volume, from = read_options_of(options)](Job&) {
    return std::make_shared<Stack>(io::trace(volume, from));
  });
}

}  // namespace

void add_volume(py::module_& module) { module.def("trace", &trace); }

}  // namespace loft::python
