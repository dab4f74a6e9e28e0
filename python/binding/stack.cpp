// SPDX-License-Identifier: MIT
#include "io/stack.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/stack_writer.h"
#include "python/binding/arrays.h"
#include "python/binding/job.h"
#include "python/binding/options.h"
#include "python/binding/parts.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/stack.h"
#include "reconstruct/usable.h"

namespace loft::python {

namespace {

using StackPointer = std::shared_ptr<Stack>;

std::vector<std::filesystem::path> to_paths(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

StackPointer read_stack_at(const std::vector<std::string>& names, const py::dict& options) {
  return result_of(py::none(), [paths = to_paths(names), from = read_options_of(options)](Job&) {
    return std::make_shared<Stack>(io::read_stack(paths, from));
  });
}

/// The contours of a stack one behind the other.
struct Flat {
  std::vector<std::array<double, 2>> points;
  std::vector<std::int64_t> offsets{0};  ///< of each contour's first point, and their number
  std::vector<std::int64_t> slices;      ///< of each contour
  std::vector<std::int64_t> labels;      ///< of each contour, in `names`
  std::vector<std::string> names;
  std::vector<double> heights;  ///< of each slice
};

Flat flatten(const Stack& stack) {
  Flat flat;
  flat.names = labels(stack.slices);
  std::map<std::string, std::int64_t> numbers;
  for (const std::string& name : flat.names)
    numbers.emplace(name, static_cast<std::int64_t>(numbers.size()));
  for (const Slice& slice : stack.slices) {
    for (const Contour& contour : slice.contours) {
      for (const cdt::Point& p : contour.points) flat.points.push_back({p.x, p.y});
      flat.offsets.push_back(static_cast<std::int64_t>(flat.points.size()));
      flat.slices.push_back(static_cast<std::int64_t>(flat.heights.size()));
      flat.labels.push_back(numbers.at(contour.label));
    }
    flat.heights.push_back(slice.z);
  }
  return flat;
}

py::tuple arrays(const Stack& stack) {
  Flat flat = flatten(stack);
  return py::make_tuple(to_array(std::move(flat.points)), to_array(std::move(flat.offsets)),
                        to_array(std::move(flat.slices)), to_array(std::move(flat.labels)),
                        flat.names, to_array(std::move(flat.heights)));
}

std::int64_t at(const Array<std::int64_t>& numbers, py::ssize_t i, py::ssize_t bound,
                const char* what) {
  const std::int64_t number = numbers.at(i);
  if (number < 0 || number >= bound)
    throw InputError(std::string(what) + " " + std::to_string(i) + ": " + std::to_string(number) +
                     " is none of " + std::to_string(bound));
  return number;
}

StackPointer stack_of_arrays(const Array<double>& points, const Array<std::int64_t>& offsets,
                             const Array<std::int64_t>& slices,
                             const Array<std::int64_t>& label_numbers,
                             const std::vector<std::string>& names, const Array<double>& heights,
                             const std::string& unit) {
  require_shape(points, "points", 2);
  require_shape(offsets, "offsets");
  require_shape(slices, "slices");
  require_shape(label_numbers, "labels");
  require_shape(heights, "heights");
  const py::ssize_t count = slices.shape(0);
  if (offsets.shape(0) != count + 1 || label_numbers.shape(0) != count)
    throw InputError(
        "contours: one slice, one label and one offset each, and one more, are wanted");
  auto stack = std::make_shared<Stack>();
  stack->unit = unit;
  for (py::ssize_t i = 0; i < heights.shape(0); ++i) stack->slices.push_back({heights.at(i), {}});
  for (py::ssize_t i = 0; i < count; ++i) {
    const std::int64_t begin = at(offsets, i, points.shape(0) + 1, "offset");
    const std::int64_t end = at(offsets, i + 1, points.shape(0) + 1, "offset");
    if (end < begin) throw InputError("offset " + std::to_string(i + 1) + ": they must not fall");
    const std::int64_t slice = at(slices, i, heights.shape(0), "slice of contour");
    const std::int64_t label =
        at(label_numbers, i, static_cast<py::ssize_t>(names.size()), "label of contour");
    Contour contour{{}, names[static_cast<std::size_t>(label)]};
    contour.points.reserve(static_cast<std::size_t>(end - begin));
    for (std::int64_t p = begin; p < end; ++p)
      contour.points.push_back({*points.data(p, 0), *points.data(p, 1)});
    stack->slices[static_cast<std::size_t>(slice)].contours.push_back(std::move(contour));
  }
  require_usable(stack->slices);
  return stack;
}

/// A copy with the contours of some labels alone; all slices stay.
StackPointer only_with(const Stack& stack, const std::vector<std::string>& names) {
  const std::set<std::string> wanted(names.begin(), names.end());
  auto chosen = std::make_shared<Stack>(stack);
  for (Slice& slice : chosen->slices)
    std::erase_if(slice.contours,
                  [&](const Contour& contour) { return !wanted.contains(contour.label); });
  std::erase_if(chosen->labels,
                [&](const StackLabel& label) { return !wanted.contains(label.name); });
  return chosen;
}

/// A copy: others may be reading it.
StackPointer with_unit(const Stack& stack, const std::string& unit) {
  auto changed = std::make_shared<Stack>(stack);
  changed->unit = unit;
  return changed;
}

py::object to_colour(const std::optional<Colour>& colour) {
  if (!colour) return py::none();
  return py::make_tuple(colour->red, colour->green, colour->blue);
}

/// (name, colour, id, kind, gap) of each label that the source tells more of.
py::list told(const Stack& stack) {
  py::list list;
  for (const StackLabel& label : stack.labels)
    list.append(
        py::make_tuple(label.name, to_colour(label.colour), label.id, label.kind, label.gap));
  return list;
}

py::object frame_rows(const Stack& stack) {
  if (!stack.frame) return py::none();
  std::vector<std::array<double, 4>> rows(stack.frame->rows.begin(), stack.frame->rows.end());
  return to_array(std::move(rows));
}

/// All that arrays() leaves out; the places of contours in the world one behind the other.
py::tuple rest(const Stack& stack) {
  std::vector<std::string> sources;
  std::vector<std::int64_t> counts;
  std::vector<std::array<double, 3>> places;
  for (const Slice& slice : stack.slices)
    for (const Contour& contour : slice.contours) {
      sources.push_back(contour.source);
      counts.push_back(static_cast<std::int64_t>(contour.places.size()));
      places.insert(places.end(), contour.places.begin(), contour.places.end());
    }
  py::object fill = py::none();
  if (stack.fill) fill = py::int_(static_cast<int>(*stack.fill));
  return py::make_tuple(frame_rows(stack), told(stack), fill, stack.keyhole_width, stack.gap,
                        stack.notes, sources, to_array(std::move(counts)),
                        to_array(std::move(places)));
}

void set_frame(Stack& stack, const py::object& given) {
  if (given.is_none()) return;
  const auto rows = py::cast<Array<double>>(given);
  require_shape(rows, "frame", 4);
  if (rows.shape(0) != 4) throw InputError("frame: a matrix of four rows is wanted");
  WorldFrame frame;
  for (py::ssize_t i = 0; i < 4; ++i)
    for (py::ssize_t k = 0; k < 4; ++k)
      frame.rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = rows.at(i, k);
  if (const std::string wrong = fault(frame); !wrong.empty()) throw InputError("frame: " + wrong);
  stack.frame = frame;
}

using ToldLabel = std::tuple<std::string, std::optional<std::array<std::uint8_t, 3>>, std::string,
                             std::string, std::optional<double>>;

void tell_labels(Stack& stack, const std::vector<ToldLabel>& labels) {
  for (const auto& [name, colour, id, kind, gap] : labels) {
    StackLabel& label = stack.labels.emplace_back(StackLabel{name});
    if (colour) label.colour = Colour{(*colour)[0], (*colour)[1], (*colour)[2]};
    label.id = id;
    label.kind = kind;
    label.gap = gap;
  }
}

void set_places(Stack& stack, const std::vector<std::string>& sources,
                const Array<std::int64_t>& counts, const Array<double>& places) {
  require_shape(counts, "counts");
  require_shape(places, "places", 3);
  py::ssize_t i = 0;
  py::ssize_t begin = 0;
  for (Slice& slice : stack.slices)
    for (Contour& contour : slice.contours) {
      if (i >= counts.shape(0) || static_cast<std::size_t>(i) >= sources.size())
        throw InputError("contours: as many sources and counts of places are wanted");
      contour.source = sources[static_cast<std::size_t>(i)];
      const std::int64_t count = counts.at(i++);
      if (count != 0 && count != static_cast<std::int64_t>(contour.points.size()))
        throw InputError("places: as many as points are wanted");
      if (count > places.shape(0) - begin) throw InputError("places: there are too few");
      for (std::int64_t p = 0; p < count; ++p, ++begin)
        contour.places.push_back({places.at(begin, 0), places.at(begin, 1), places.at(begin, 2)});
    }
}

void set_rest(Stack& stack, const py::object& frame, const std::vector<ToldLabel>& labels,
              const std::optional<int>& fill, const std::optional<double>& keyhole_width,
              const std::optional<double>& gap, const std::vector<std::string>& notes,
              const std::vector<std::string>& sources, const Array<std::int64_t>& counts,
              const Array<double>& places) {
  set_frame(stack, frame);
  tell_labels(stack, labels);
  if (fill && (*fill < 0 || *fill > 2)) throw InputError("fill: 0, 1 or 2 is wanted");
  if (fill) stack.fill = static_cast<Fill>(*fill);
  stack.keyhole_width = keyhole_width;
  stack.gap = gap;
  stack.notes = notes;
  set_places(stack, sources, counts, places);
}

std::vector<std::string> write_to(const StackPointer& stack, const std::string& path) {
  return result_of(py::none(), [stack, path](Job&) { return io::write_stack(path, *stack); });
}

}  // namespace

void add_stack(py::module_& module) {
  py::class_<Stack, StackPointer>(module, "Stack")
      .def_readonly("unit", &Stack::unit)
      .def("with_unit", &with_unit)
      .def_readonly("notes", &Stack::notes)
      .def("labels", [](const Stack& stack) { return labels(stack.slices); })
      .def("slice_count", [](const Stack& stack) { return stack.slices.size(); })
      .def("told", &told)
      .def("frame", &frame_rows)
      .def("set_frame", &set_frame)
      .def("arrays", &arrays)
      .def("rest", &rest)
      .def("set_rest", &set_rest)
      .def("only", &only_with)
      .def("write", &write_to)
      .def("__eq__", [](const Stack& a, const Stack& b) { return a == b; });
  module.def("labels_of", [](const std::vector<std::string>& names) {
    return io::labels_of(to_paths(names), io::Unlabelled::label_by_file);
  });
  module.def("read", &read_stack_at);
  module.def("stack_from_arrays", &stack_of_arrays);
}

}  // namespace loft::python
