// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/lines.h"
#include "reconstruct/live/live_stack.h"
#include "reconstruct/live/stack_edit.h"
#include "reconstruct/nearest_height.h"
#include "reconstruct/number_text.h"
#include "reconstruct/usable.h"

namespace loft {

namespace {

InputError no_slice(double z, const LiveStack& stack) {
  return InputError(no_slice_at(z, stack.stations));
}

}  // namespace

Reconstruction::Reconstruction(Options options)
    : stack_(std::make_unique<LiveStack>(std::move(options))) {
  if (stack_->options.simplify || !stack_->options.links.empty() ||
      stack_->options.height_tolerance != 0 || stack_->options.cap == Cap::extend)
    throw std::invalid_argument(
        "simplify, links, height_tolerance and Cap::extend need the whole stack");
  require_usable(stack_->options);
}
Reconstruction::~Reconstruction() = default;
Reconstruction::Reconstruction(Reconstruction&&) noexcept = default;
Reconstruction& Reconstruction::operator=(Reconstruction&&) noexcept = default;

SurfaceChange Reconstruction::insert(Slice slice) {
  return insert(std::make_shared<const Slice>(std::move(slice)));
}

SurfaceChange Reconstruction::insert(std::shared_ptr<const Slice> slice) {
  const double z = slice->z;
  const Slice* there = find(z);
  if (there == nullptr) return apply(*stack_, {{z, std::move(slice)}});
  // Before its contours have other numbers.
  const std::uint32_t number = stack_->stations.find(z)->second.number;
  if (auto unusable = find_unusable(*slice, number, stack_->options.label); !unusable.empty())
    throw InputError(std::move(unusable));
  Slice both = *there;
  both.contours.insert(both.contours.end(), slice->contours.begin(), slice->contours.end());
  return apply(*stack_, {{z, std::make_shared<const Slice>(std::move(both)), true}});
}

SurfaceChange Reconstruction::replace(double z, Slice slice) {
  return replace(z, std::make_shared<const Slice>(std::move(slice)));
}

SurfaceChange Reconstruction::replace(double z, std::shared_ptr<const Slice> slice) {
  if (find(z) == nullptr) throw no_slice(z, *stack_);
  const double new_z = slice->z;
  if (new_z == z) return apply(*stack_, {{z, std::move(slice)}});
  if (find(new_z) != nullptr)
    throw InputError("there is a slice at z = " + exact(new_z) +
                     " already; remove it first, or replace it");
  return apply(*stack_, {{z}, {new_z, std::move(slice)}});
}

SurfaceChange Reconstruction::replace(std::vector<Slice> slices) {
  std::vector<SliceEdit> edits;
  for (Slice& slice : slices) {
    if (find(slice.z) == nullptr) throw no_slice(slice.z, *stack_);
    const double z = slice.z;
    edits.push_back({z, std::make_shared<const Slice>(std::move(slice))});
  }
  std::ranges::sort(edits, {}, &SliceEdit::z);
  const auto twice = std::ranges::adjacent_find(edits, {}, &SliceEdit::z);
  if (twice != edits.end())
    throw InputError("two slices for z = " + exact(twice->z) + "; each height has one");
  if (edits.empty()) return {};
  return apply(*stack_, std::move(edits));
}

SurfaceChange Reconstruction::remove(double z) {
  if (find(z) == nullptr) throw no_slice(z, *stack_);
  return apply(*stack_, {{z}});
}

SurfaceChange Reconstruction::move_contour(double z, std::size_t contour,
                                           std::vector<cdt::Point> points) {
  const Slice* there = find(z);
  if (there == nullptr) throw no_slice(z, *stack_);
  if (contour >= there->contours.size())
    throw InputError("the slice at z = " + exact(z) + " has no contour " + std::to_string(contour));
  Slice slice = *there;
  slice.contours[contour].points = std::move(points);
  const auto& repairs = stack_->stations.find(z)->second.repairs;
  const bool is_merged =
      std::ranges::find(repairs, DefectKind::merged_slices, &Defect::kind) != repairs.end();
  return apply(*stack_, {{z, std::make_shared<const Slice>(std::move(slice)), is_merged}});
}

const Surface& Reconstruction::surface() const { return stack_->surface.surface(); }
std::size_t Reconstruction::vertex_count() const { return stack_->surface.vertex_count(); }
std::size_t Reconstruction::face_count() const { return stack_->surface.face_count(); }

double Reconstruction::volume() const {
  double sum = 0;
  for (const auto& [z, slab] : stack_->slabs) sum += slab.frozen->volume;
  return sum;
}

void Reconstruction::collect_garbage() {
  std::vector<Faces*> faces;
  std::vector<Rim*> rims;
  for (auto& [z, slab] : stack_->slabs)
    for (Faces* some : {&slab.bottom, &slab.faces, &slab.top}) faces.push_back(some);
  for (auto& [z, station] : stack_->stations) rims.push_back(&station.rim);
  stack_->surface.collect_garbage(faces, rims);
}

std::size_t Reconstruction::slice_count() const { return stack_->stations.size(); }

const Slice* Reconstruction::find(double z) const {
  if (std::isnan(z)) return nullptr;  // no key of a map
  const auto found = stack_->stations.find(z);
  return found == stack_->stations.end() ? nullptr : found->second.slice.get();
}

std::vector<Slice> Reconstruction::slices() const {
  std::vector<Slice> all;
  for (const auto& [z, station] : stack_->stations) all.push_back(*station.slice);
  return all;
}

std::size_t Reconstruction::slab_count() const { return stack_->slabs.size(); }

std::vector<SlabInfo> Reconstruction::slabs() const {
  std::vector<SlabInfo> all;
  for (const auto& [z, slab] : stack_->slabs) all.push_back(slab.frozen->info);
  return all;
}

std::vector<Defect> Reconstruction::repairs() const {
  std::vector<Defect> all;
  std::uint32_t rank = 0;
  const auto add = [&](Defect repair) {
    repair.slice = rank;
    all.push_back(std::move(repair));
  };
  const auto& ends = stack_->ends;
  for (const auto& [z, station] : stack_->stations) {
    for (const Defect& repair : station.repairs) add(repair);
    if (station.region->is_empty() && ends && z > ends->first && z < ends->second)
      add(empty_slice(*station.region));
    const auto slab = stack_->slabs.find(z);
    if (ends && z >= ends->first && z <= ends->second)
      for (const std::uint32_t line : stack_->unused_lines_at(z))
        add(unused_line(*station.region, line));
    if (slab != stack_->slabs.end() && !slab->second.frozen->linked->is_linked)
      add(unlinked_slices(*station.region));
    ++rank;
  }
  return all;
}

Snapshot Reconstruction::snapshot() const {
  std::vector<std::shared_ptr<const FrozenSlab>> slabs;
  for (const auto& [z, slab] : stack_->slabs) slabs.push_back(slab.frozen);
  std::vector<std::shared_ptr<const Slice>> slices;
  std::vector<std::uint32_t> numbers;
  for (const auto& [z, station] : stack_->stations) {
    slices.push_back(station.slice);
    numbers.push_back(station.number);
  }
  return {std::move(slabs), std::move(slices), numbers, stack_->options.cap};
}

}  // namespace loft
