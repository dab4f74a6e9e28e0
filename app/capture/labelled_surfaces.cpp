// SPDX-License-Identifier: MIT
#include "app/capture/labelled_surfaces.h"

#include <algorithm>
#include <cstdint>

#include "app/report.h"
#include "cdt/effort.h"
#include "reconstruct/defect.h"
#include "reconstruct/fair/stairs.h"
#include "reconstruct/number_text.h"
#include "reconstruct/usable.h"

namespace loft::app {

namespace {

/// Each contour takes room for itself, for what is said about it, and in every surface.
constexpr std::size_t most_contours = std::size_t{1} << 18U;

SurfaceChange put_into(Reconstruction& surface, const LabelledSurfaces::Exchange& exchange) {
  if (exchange.after == nullptr) return surface.remove(exchange.z);
  return exchange.before == nullptr ? surface.insert(exchange.after)
                                    : surface.replace(exchange.z, exchange.after);
}

/// `slice` as it came; `all`: with what is at its height already.
void check(const Slice& slice, const Slice& all, std::size_t index) {
  if (all.contours.size() > most_contours)
    throw InputError("the slice has " + std::to_string(all.contours.size()) +
                     " contours; at most " + std::to_string(most_contours) +
                     " fit into a live surface");
  if (auto unusable = find_unusable(slice, static_cast<std::uint32_t>(index)); !unusable.empty())
    throw InputError(std::move(unusable));
}

}  // namespace

LabelledSurfaces::Exchange LabelledSurfaces::apply(const io::Edit& edit, NetChange& change) {
  const double z = edit.slice.z;
  if (const auto problem = stack_.problem(edit)) throw InputError(*problem);
  Exchange exchange{z, stack_.find(z), stack_.after(edit)};
  if (exchange.after != nullptr) {
    check(edit.slice, *exchange.after, stack_.slices().size());
    add_labels(edit.slice, change);
  }
  put(exchange, change);
  warn_of_stairs(edit.slice, change);
  if (edit.kind == io::Edit::Kind::insert && exchange.before != nullptr)
    change.note("slice at z = " + exact(z) +
                ": came at a height where there was a slice already; merged with it");
  return exchange;
}

/// Once is enough.
void LabelledSurfaces::warn_of_stairs(const Slice& slice, NetChange& change) {
  if (!bends_as_they_are(options_) || has_warned_) return;
  Stairs stairs;
  stairs.add(slice);
  if (!stairs.are_there()) return;
  change.note("slice at z = " + exact(slice.z) + ": " + stairs_are_bent);
  has_warned_ = true;
}

void LabelledSurfaces::take_back(const Exchange& exchange, NetChange& change) {
  put(exchange.reversed(), change);
}

void LabelledSurfaces::put(const Exchange& exchange, NetChange& change) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    try {
      change.add(i, parts_[i].label, put_into(*parts_[i].surface, exchange));
    } catch (...) {
      const cdt::Effort without_limit;  // what was there can be made again
      for (std::size_t k = 0; k < i; ++k)
        change.add(k, parts_[k].label, put_into(*parts_[k].surface, exchange.reversed()));
      throw;
    }
  }
  stack_.set(exchange.z, exchange.after);
}

void LabelledSurfaces::add_labels(const Slice& slice, NetChange& change) {
  const auto add = [&](const std::string& label) {
    if (std::ranges::find(parts_, label, &Part::label) != parts_.end()) return;
    Options options = options_;
    options.label = label;
    Part part{label, std::make_unique<Reconstruction>(options)};
    for (const auto& [z, there] : stack_.slices())
      change.add(parts_.size(), label, part.surface->insert(there));
    parts_.push_back(std::move(part));
  };
  if (slice.contours.empty() && parts_.empty()) add("");
  for (const Contour& contour : slice.contours) add(contour.label);
}

void LabelledSurfaces::insert(const io::StackState::SharedSlice& slice) {
  for (Part& part : parts_) static_cast<void>(part.surface->insert(slice));
  stack_.set(slice->z, slice);
}

Json LabelledSurfaces::counts() const {
  std::size_t slabs = 0;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const Part& part : parts_) {
    slabs += part.surface->slab_count();
    vertices += part.surface->vertex_count();
    faces += part.surface->face_count();
  }
  return {{"slices", stack_.slices().size()},
          {"slabs", slabs},
          {"vertices", vertices},
          {"faces", faces}};
}

double LabelledSurfaces::volume() const {
  double volume = 0;
  for (const Part& part : parts_) volume += part.surface->volume();
  return volume;
}

}  // namespace loft::app
