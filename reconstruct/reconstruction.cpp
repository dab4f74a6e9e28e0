// SPDX-License-Identifier: MIT
#include "reconstruct/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "reconstruct/heights.h"
#include "reconstruct/link_orders.h"
#include "reconstruct/links.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/refine.h"
#include "reconstruct/region.h"
#include "reconstruct/smooth.h"
#include "reconstruct/tiles.h"

namespace loft {

namespace {

/// A slice of the stack and what has been made of it.
struct Station {
  std::shared_ptr<const Slice> slice;
  std::uint32_t number = 0;  // in order of arrival
  std::shared_ptr<const Region> region;
  std::shared_ptr<const SliceShape> shape;  // where the surface is bent
  std::vector<Defect> repairs;

  [[nodiscard]] bool is_empty() const { return region->is_empty(); }
};

using Stations = std::map<double, Station>;

/// A slab of the stack: what is in the surface, and what its neighbours look at.
struct LiveSlab {
  std::shared_ptr<const FrozenSlab> frozen;
  std::shared_ptr<const Pieces> found;  // before ends were linked
  std::vector<EndLink> links;
};

InputError wrong(double z, const std::string& message) {
  return InputError("slice at z = " + std::to_string(z) + ' ' + message);
}

}  // namespace

/// By heights; slabs by the heights they begin at.
class Reconstruction::Stack {
 public:
  explicit Stack(Options options) : options_(std::move(options)) {
    if (options_.simplify || !options_.links.empty())
      throw std::invalid_argument("simplify and links need the whole stack");
  }

  SurfaceChange apply(std::vector<std::pair<double, std::optional<Slice>>> edits);

  [[nodiscard]] const Stations& stations() const { return stations_; }
  [[nodiscard]] Snapshot snapshot() const;
  [[nodiscard]] std::vector<SlabInfo> slabs() const;
  [[nodiscard]] std::vector<Defect> repairs() const;

  Surface surface;

 private:
  Options options_;
  Stations stations_;
  std::map<double, LiveSlab> slabs_;
  std::uint32_t next_number_ = 0;
  std::uint32_t next_id_ = 0;
  cdt::Triangulation memory_;
  TileWorkspace workspace_;
};

Reconstruction::Reconstruction(Options options)
    : stack_(std::make_unique<Stack>(std::move(options))) {}
Reconstruction::~Reconstruction() = default;
Reconstruction::Reconstruction(Reconstruction&&) noexcept = default;
Reconstruction& Reconstruction::operator=(Reconstruction&&) noexcept = default;

SurfaceChange Reconstruction::insert(Slice slice) {
  const double z = slice.z;
  if (const Slice* there = find(z)) {
    Slice both = *there;
    both.contours.insert(both.contours.end(), std::make_move_iterator(slice.contours.begin()),
                         std::make_move_iterator(slice.contours.end()));
    slice = std::move(both);
  }
  return stack_->apply({{z, std::move(slice)}});
}

SurfaceChange Reconstruction::replace(double z, Slice slice) {
  if (find(z) == nullptr) throw wrong(z, "is not there");
  if (slice.z == z) return stack_->apply({{z, std::move(slice)}});
  if (find(slice.z) != nullptr) throw wrong(slice.z, "is there already");
  const double new_z = slice.z;
  return stack_->apply({{z, std::nullopt}, {new_z, std::move(slice)}});
}

SurfaceChange Reconstruction::remove(double z) {
  if (find(z) == nullptr) throw wrong(z, "is not there");
  return stack_->apply({{z, std::nullopt}});
}

SurfaceChange Reconstruction::move_contour(double z, std::size_t contour,
                                           std::vector<cdt::Point> points) {
  const Slice* there = find(z);
  if (there == nullptr) throw wrong(z, "is not there");
  if (contour >= there->contours.size())
    throw wrong(z, "has no contour " + std::to_string(contour));
  Slice slice = *there;
  slice.contours[contour].points = std::move(points);
  return stack_->apply({{z, std::move(slice)}});
}

const Surface& Reconstruction::surface() const { return stack_->surface; }
void Reconstruction::collect_garbage() { stack_->surface.garbage_collection(); }
std::size_t Reconstruction::slice_count() const { return stack_->stations().size(); }

const Slice* Reconstruction::find(double z) const {
  const auto found = stack_->stations().find(z);
  return found == stack_->stations().end() ? nullptr : found->second.slice.get();
}

std::vector<Slice> Reconstruction::slices() const {
  std::vector<Slice> all;
  for (const auto& [z, station] : stack_->stations()) all.push_back(*station.slice);
  return all;
}

std::vector<SlabInfo> Reconstruction::slabs() const { return stack_->slabs(); }
std::vector<Defect> Reconstruction::repairs() const { return stack_->repairs(); }
Snapshot Reconstruction::snapshot() const { return stack_->snapshot(); }

SurfaceChange Reconstruction::Stack::apply(
    std::vector<std::pair<double, std::optional<Slice>>> edits) {
  Stations stations = stations_;
  SurfaceChange change;
  for (auto& [z, slice] : edits) {
    stations.erase(z);
    if (!slice) continue;
    if (auto fatal = find_unusable(*slice, next_number_); !fatal.empty())
      throw InputError(std::move(fatal));
    Station station{std::make_shared<const Slice>(std::move(*slice)), next_number_++, {}, {}, {}};
    const Slice* part = station.slice.get();
    station.region = std::make_shared<const Region>(clean(
        Height{z, {station.number}}, std::span(&part, 1), options_, station.repairs, memory_));
    stations.emplace(z, std::move(station));
  }
  std::vector<Slice> all;
  std::vector<double> heights;
  for (const auto& [z, station] : stations) heights.push_back(z);
  std::vector<Defect> repairs;
  static_cast<void>(find_heights(heights, repairs));
  for (const auto& [z, slab] : slabs_) change.removed.push_back(slab.frozen->info.id);
  std::ranges::sort(change.removed);
  change.faces_removed = surface.n_faces();
  change.vertices_removed = surface.n_vertices();

  std::vector<const Station*> filled;
  for (const auto& [z, station] : stations) filled.push_back(&station);
  while (!filled.empty() && filled.back()->is_empty()) filled.pop_back();
  while (!filled.empty() && filled.front()->is_empty()) filled.erase(filled.begin());
  std::map<double, LiveSlab> slabs;
  const bool is_capped = options_.cap == Cap::flat;
  for (std::size_t i = 0; i + 1 < filled.size(); ++i) {
    const auto& lower = filled[i]->region;
    const auto& upper = filled[i + 1]->region;
    OrderedTiles made = tile_by_orders(*lower, *upper, options_, {}, workspace_);
    auto tiles = std::make_shared<const TileSet>(std::move(made.tiles));
    auto pieces = std::make_shared<const Pieces>(std::move(made.pieces));
    LiveSlab slab;
    slab.frozen =
        std::make_shared<const FrozenSlab>(FrozenSlab{{next_id_++, lower->z, upper->z},
                                                      lower,
                                                      upper,
                                                      tiles,
                                                      tiles,
                                                      pieces,
                                                      is_capped && i == 0,
                                                      is_capped && i + 2 == filled.size()});
    change.added.push_back(slab.frozen->info);
    slabs.emplace(lower->z, std::move(slab));
  }
  stations_ = std::move(stations);
  slabs_ = std::move(slabs);
  surface = snapshot().surface(1);
  change.faces_added = surface.n_faces();
  change.vertices_added = surface.n_vertices();
  return change;
}

Snapshot Reconstruction::Stack::snapshot() const {
  std::vector<std::shared_ptr<const FrozenSlab>> slabs;
  for (const auto& [z, slab] : slabs_) slabs.push_back(slab.frozen);
  std::vector<std::shared_ptr<const Slice>> slices;
  std::vector<std::uint32_t> numbers;
  for (const auto& [z, station] : stations_) {
    slices.push_back(station.slice);
    numbers.push_back(station.number);
  }
  return {std::move(slabs), std::move(slices), numbers, options_.cap};
}

std::vector<SlabInfo> Reconstruction::Stack::slabs() const {
  std::vector<SlabInfo> all;
  for (const auto& [z, slab] : slabs_) all.push_back(slab.frozen->info);
  return all;
}

std::vector<Defect> Reconstruction::Stack::repairs() const {
  std::vector<Defect> all;
  std::uint32_t rank = 0;
  for (const auto& [z, station] : stations_) {
    for (Defect repair : station.repairs) {
      repair.slice = rank;
      all.push_back(std::move(repair));
    }
    ++rank;
  }
  return all;
}

}  // namespace loft
