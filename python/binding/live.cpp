// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/binding/arrays.h"
#include "python/binding/errors.h"
#include "python/binding/in_turn.h"
#include "python/binding/job.h"
#include "python/binding/options.h"
#include "python/binding/parts.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/reconstruction.h"
#include "reconstruct/stack.h"

namespace loft::python {

namespace {

struct Live {
  Reconstruction surface;
  unsigned threads = 0;  ///< that it may use
};

using SharedLive = InTurn<Live>;
using LivePointer = std::shared_ptr<SharedLive>;

Options live_options(const py::dict& named, const std::optional<std::string>& label) {
  Options options = options_of(named);
  options.height_tolerance = 0;  // which needs the whole stack
  options.label = label;
  return options;
}

LivePointer live_of(const Options& options) {
  return std::make_shared<SharedLive>(std::in_place, Reconstruction(options), options.threads);
}

/// Throws Error where the threads that it has begun stayed behind in a fork.
void require_threads(unsigned threads) {
  if (threads != 1 && usable_threads(0) == 1)
    throw Error(
        "this reconstruction came along in a fork, and its threads did not: make it with "
        "threads=1, or pickle it and use the copy");
}

/// work(surface) on a thread of its own.
template <class Work>
auto edit_live(const LivePointer& live, Work work) {
  require_threads(live->use([](Live& there) { return there.threads; }));
  return result_of(py::none(), [live, work = std::move(work)](Job&) {
    return live->use_in_job([&](Live& there) { return work(there.surface); });
  });
}

py::list slab_rows(const std::vector<SlabInfo>& slabs) {
  py::list list;
  for (const SlabInfo& slab : slabs) list.append(py::make_tuple(slab.id, slab.low, slab.high));
  return list;
}

py::tuple change_tuple(const SurfaceChange& change) {
  py::object bounds = py::none();
  if (change.bounds) bounds = py::make_tuple(change.bounds->low, change.bounds->high);
  return py::make_tuple(change.removed, slab_rows(change.added), change.resewn,
                        change.vertices_added, change.vertices_removed, change.faces_added,
                        change.faces_removed, bounds, defect_list(change.repairs));
}

const Slice& only_slice(const Stack& stack) {
  if (stack.slices.size() != 1) throw InputError("one slice is wanted");
  return stack.slices.front();
}

py::tuple insert_slice(const LivePointer& live, const std::shared_ptr<Stack>& stack) {
  return change_tuple(edit_live(
      live, [slice = only_slice(*stack)](Reconstruction& there) { return there.insert(slice); }));
}

py::tuple replace_slice(const LivePointer& live, double z, const std::shared_ptr<Stack>& stack) {
  return change_tuple(edit_live(live, [z, slice = only_slice(*stack)](Reconstruction& there) {
    return there.replace(z, slice);
  }));
}

py::tuple replace_slices(const LivePointer& live, const std::shared_ptr<Stack>& stack) {
  return change_tuple(edit_live(
      live, [slices = stack->slices](Reconstruction& there) { return there.replace(slices); }));
}

py::tuple remove_slice(const LivePointer& live, double z) {
  return change_tuple(edit_live(live, [z](Reconstruction& there) { return there.remove(z); }));
}

py::tuple move_contour(const LivePointer& live, double z, std::size_t contour,
                       const Array<double>& array) {
  require_shape(array, "points", 2);
  std::vector<cdt::Point> points;
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    points.push_back({*array.data(i, 0), *array.data(i, 1)});
  return change_tuple(edit_live(
      live, [=](Reconstruction& there) { return there.move_contour(z, contour, points); }));
}

/// A reconstruction of the slices of a stack, from low to high, which is the fastest.
LivePointer live_of_stack(const std::shared_ptr<Stack>& stack, const py::dict& named,
                          const std::optional<std::string>& label) {
  const Options options = live_options(named, label);
  std::vector<Slice> ascending = stack->slices;
  std::ranges::stable_sort(ascending, {}, &Slice::z);
  return result_of(py::none(), [slices = std::move(ascending), options](Job& job) {
    Reconstruction surface(options);
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(slices.size());
      if (!job.report(Stage::tile, part)) throw Cancelled();
      surface.insert(slices[i]);
    }
    return std::make_shared<SharedLive>(std::in_place, std::move(surface), options.threads);
  });
}

std::shared_ptr<Stack> stack_of(std::vector<Slice> slices) {
  auto stack = std::make_shared<Stack>();
  stack->slices = std::move(slices);
  return stack;
}

std::shared_ptr<Stack> live_stack(const LivePointer& live) {
  return stack_of(live->use([](Live& there) { return there.surface.slices(); }));
}

/// A stack of the slice at a height; None where there is none.
std::shared_ptr<Stack> slice_at(const LivePointer& live, double z) {
  auto found = live->use([z](Live& there) {
    const Slice* slice = there.surface.find(z);
    return slice != nullptr ? std::vector<Slice>{*slice} : std::vector<Slice>{};
  });
  return found.empty() ? nullptr : stack_of(std::move(found));
}

bool has_slice(const LivePointer& live, double z) {
  return live->use([z](Live& there) { return there.surface.find(z) != nullptr; });
}

/// Slices, slabs, vertices, faces.
std::array<std::size_t, 4> live_counts(const LivePointer& live) {
  return live->use([](Live& there) {
    return std::array{there.surface.slice_count(), there.surface.slab_count(),
                      there.surface.vertex_count(), there.surface.face_count()};
  });
}

std::pair<Snapshot, unsigned> state_of(const LivePointer& live) {
  return live->use([](Live& there) { return std::pair(there.surface.snapshot(), there.threads); });
}

/// The whole surface, the volume between the slices, and how many slices there were then.
py::tuple live_surface(const LivePointer& live) {
  const auto [snapshot, threads] = state_of(live);
  require_threads(threads);
  const std::size_t slices = snapshot.slice_count();
  auto surface = result_of(py::none(), [snapshot = snapshot, threads = threads](Job&) {
    return std::make_shared<const Surface>(snapshot.surface(threads));
  });
  return py::make_tuple(SharedSurface(std::move(surface)), slices);
}

/// Of some slabs, counted from below: points, faces, kinds and places of the points' origins, kinds
/// of faces, and the slab of each.
py::tuple live_patch(const LivePointer& live, std::size_t first, std::size_t last) {
  const Snapshot snapshot = state_of(live).first;
  if (first > last || last > snapshot.slab_count())
    throw InputError("slabs " + std::to_string(first) + " to " + std::to_string(last) +
                     ": there are " + std::to_string(snapshot.slab_count()));
  Patch patch =
      result_of(py::none(), [snapshot, first, last](Job&) { return snapshot.patch(first, last); });
  std::vector<std::uint8_t> kinds;
  std::vector<std::array<std::int32_t, 3>> origins_of_points;
  for (const Origin& origin : patch.origins) {
    kinds.push_back(static_cast<std::uint8_t>(origin.kind));
    origins_of_points.push_back({static_cast<std::int32_t>(origin.slice),
                                 static_cast<std::int32_t>(origin.contour),
                                 static_cast<std::int32_t>(origin.point)});
  }
  std::vector<std::uint8_t> face_kinds;
  for (const FaceKind kind : patch.kinds) face_kinds.push_back(static_cast<std::uint8_t>(kind));
  return py::make_tuple(to_array(std::move(patch.mesh.points)),
                        to_array(std::move(patch.mesh.faces)), to_array(std::move(kinds)),
                        to_array(std::move(origins_of_points)), to_array(std::move(face_kinds)),
                        to_array(std::move(patch.slabs)));
}

}  // namespace

void add_live(py::module_& module) {
  py::class_<SharedLive, LivePointer>(module, "Reconstruction")
      .def(py::init([](const py::dict& named, const std::optional<std::string>& label) {
        return live_of(live_options(named, label));
      }))
      .def("insert", &insert_slice)
      .def("replace", &replace_slice)
      .def("replace_many", &replace_slices)
      .def("remove", &remove_slice)
      .def("move_contour", &move_contour)
      .def("stack", &live_stack)
      .def("slice", &slice_at)
      .def("has", &has_slice)
      .def("counts", &live_counts)
      .def("surface", &live_surface)
      .def("patch", &live_patch)
      .def("volume",
           [](const LivePointer& live) {
             return live->use([](Live& there) { return there.surface.volume(); });
           })
      .def("slabs",
           [](const LivePointer& live) {
             return slab_rows(live->use([](Live& there) { return there.surface.slabs(); }));
           })
      .def("repairs", [](const LivePointer& live) {
        return defect_list(live->use([](Live& there) { return there.surface.repairs(); }));
      });
  module.def("reconstruction_of_stack", &live_of_stack);
}

}  // namespace loft::python
