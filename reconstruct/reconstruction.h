// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/defect.h"
#include "reconstruct/live/snapshot.h"
#include "reconstruct/live/surface_change.h"
#include "reconstruct/options.h"
#include "reconstruct/slice.h"
#include "reconstruct/surface.h"

namespace loft {

struct LiveStack;

/// The surface through a stack of slices that come, change and go one at a time.
///
/// Law: after any edits in any order the surface is that of reconstruct() for the same slices: the
/// same vertices and the same faces, in another order. All that is promised there holds here after
/// each edit. While fewer than two slices have an area there is no surface.
///
/// An edit of a slice changes the slabs beside it: at most two; at most four with Options::smooth,
/// where tiles fork, and where a part ends or begins. The first and the last slab own the caps, so
/// that a slice beyond the end changes the slab that was the last one; and it makes all the slabs
/// of the empty slices that were beyond the end. Where contours touch, the next slabs may be sewn
/// anew; they stay, with other faces (SurfaceChange::resewn). The mesh is updated in its place:
/// handles of faces, vertices and edges that are not among what an edit removed stay valid. What is
/// removed is marked as deleted (OpenMesh's status) and used again by later edits.
///
/// Strong guarantee: an edit that throws has changed nothing; but for std::bad_alloc once the mesh
/// is being changed, with all that this takes: after that only destroying it is safe.
///
/// Not for several threads at once; snapshots may be used in any thread.
class Reconstruction {
 public:
  /// Throws std::invalid_argument for what needs the whole stack: Options::simplify, its links,
  /// Options::height_tolerance, Cap::extend; InputError for lengths that are not usable (usable.h).
  explicit Reconstruction(Options options = {});
  ~Reconstruction();
  Reconstruction(Reconstruction&&) noexcept;
  Reconstruction& operator=(Reconstruction&&) noexcept;

  /// Adds a slice at any height. At a height that is there already the contours of both are one
  /// slice from then on, as in a stack with two slices of one height; the repairs say so
  /// (DefectKind::merged_slices), until that slice is given anew.
  /// Throws InputError with all that is wrong with the slice: a coordinate that is not finite or of
  /// no usable size, a height too near to another one, a label that is not that of the contours
  /// there (without Options::label).
  /// Cost: that of making the slabs beside it, whatever the number of slices.
  SurfaceChange insert(Slice slice);
  /// The same with a slice that others have, too: such as the surfaces of other labels.
  SurfaceChange insert(std::shared_ptr<const Slice> slice);
  /// Puts a slice into the place of the one at height z; it may have another height.
  /// Only what its contours change is made anew.
  /// Throws as insert(), and where there is no slice at z, or another one at the new height.
  SurfaceChange replace(double z, Slice slice);
  SurfaceChange replace(double z, std::shared_ptr<const Slice> slice);
  /// Puts each slice into the place of the one at its height, all as one edit: a shape that moves.
  /// Each slab is made once, so that this takes about half the time of one after the other.
  /// Throws as replace(), and where two slices have the same height.
  SurfaceChange replace(std::vector<Slice> slices);
  /// Throws InputError where there is no slice at z; it names the nearest height that there is.
  SurfaceChange remove(double z);
  /// Gives a contour of the slice at z other points; it keeps its label.
  /// Throws InputError as replace(), and where there is no such contour.
  SurfaceChange move_contour(double z, std::size_t contour, std::vector<cdt::Point> points);

  /// The live surface. Vertices of deleted status are holes in its arrays. Origin::slice and
  /// FaceTraits::slab do not count from below: they are the slice's number in order of arrival and
  /// the id of the slab. An id is given once; a slab that changes gets a new one.
  [[nodiscard]] const Surface& surface() const;
  [[nodiscard]] std::size_t vertex_count() const;  ///< without what is deleted
  [[nodiscard]] std::size_t face_count() const;
  /// Enclosed; with Cap::open between the slices. Cost: O(number of slabs).
  [[nodiscard]] double volume() const;
  /// Closes the holes that removed elements have left in the mesh, which makes all handles invalid.
  void collect_garbage();

  [[nodiscard]] std::size_t slice_count() const;
  [[nodiscard]] std::size_t slab_count() const;
  /// The slice at a height, or null.
  [[nodiscard]] const Slice* find(double z) const;
  /// All slices, from low to high.
  [[nodiscard]] std::vector<Slice> slices() const;
  /// All slabs, from low to high.
  [[nodiscard]] std::vector<SlabInfo> slabs() const;
  /// What was found in slices and slabs, by height; as Reconstructed::repairs, with slices counted
  /// from below. Cost: O(number of slices).
  [[nodiscard]] std::vector<Defect> repairs() const;

  /// The present state, for other threads and later. Cost: O(number of slabs), whatever their size.
  [[nodiscard]] Snapshot snapshot() const;

 private:
  std::unique_ptr<LiveStack> stack_;
};

}  // namespace loft
