// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/box3.h"
#include "reconstruct/live/elements.h"
#include "reconstruct/sew/rim.h"
#include "reconstruct/sew/sewing.h"
#include "reconstruct/surface.h"

namespace loft {

/// Layers to put into a surface in the place of some of its faces.
struct Splice {
  /// The layers that come, from low to high. Where contours of an outer slice touch, so may layers
  /// on both sides of it: then the one beyond comes, too, and the next is there to be looked at.
  std::vector<Layer> layers = {};
  std::size_t first = 0;  ///< from here up to but not `last` they come
  std::size_t last = 0;
  /// Of the layers that come only some faces do; rims of the others are there.
  bool is_partial = false;
  bool has_below = false;  ///< whether the surface goes on below and above them
  bool has_above = false;
  /// The slices below each layer that comes, and that above the last one. The rims of the outer
  /// ones are regular and there already, if the surface goes on beyond them.
  std::vector<RimmedSlice> slices = {};
  /// For each layer that comes, where it is there already with the same tiles, its faces: they stay
  /// as far as sewing joins them as it did. Null otherwise.
  std::vector<const std::vector<Surface::FaceHandle>*> present = {};
  /// All faces that go; those of `present` are among them.
  std::vector<Surface::FaceHandle> removed = {};
  /// All rims, beside those of `slices`, that these faces may be at.
  std::vector<Rim*> rims = {};
};

/// What a splice made.
struct Spliced {
  /// Nothing was done: in an outer slice there is more than its contours. The next layer has to
  /// come, too; of partial layers everything.
  bool needs_below = false;
  bool needs_above = false;
  /// The faces of each layer that came: those of its tiles in their order, then those that sewing
  /// has cut off.
  std::vector<std::vector<Surface::FaceHandle>> faces;
  bool is_sewn_as_tiled = true;  ///< sewing has neither doubled a vertex nor cut an edge
  std::size_t vertices_added = 0;
  std::size_t vertices_removed = 0;
  std::size_t faces_added = 0;
  std::size_t faces_removed = 0;
  std::optional<Box3> bounds;  ///< of the faces that came or went
};

/// A surface that is changed in its place. Elements that go are marked as deleted, and used again
/// for those that come next.
class LiveSurface {
 public:
  /// `is_open`: whether it may have boundaries.
  explicit LiveSurface(bool is_open) : is_open_(is_open) {}
  LiveSurface(const LiveSurface&) = delete;  // its elements refer to its surface
  LiveSurface& operator=(const LiveSurface&) = delete;
  ~LiveSurface() = default;

  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] std::size_t vertex_count() const { return elements_.vertex_count(); }
  [[nodiscard]] std::size_t face_count() const { return elements_.face_count(); }

  /// Whether a splice may bring so many faces: handles are numbered by int.
  [[nodiscard]] bool has_room_for(std::size_t faces) const { return elements_.has_room_for(faces); }

  /// Law: afterwards the surface is the one that sewing all its layers at once would make. Handles
  /// of faces that stay, and of their edges and vertices, stay what they are.
  /// Precondition: room for the faces of the layers that come. Cost: that of sewing the layers.
  Spliced splice(Splice splice);

  /// What faces that stay say of their slab.
  void set_slab(std::span<const Surface::FaceHandle> faces, std::uint32_t slab) {
    for (const Surface::FaceHandle f : faces) surface_.data(f).slab = slab;
  }

  /// Closes the holes in the arrays. The handles given are brought up to date; all others are
  /// invalid afterwards. Cost: O(size of the surface).
  void collect_garbage(std::span<std::vector<Surface::FaceHandle>* const> faces,
                       std::span<Rim* const> rims);

 private:
  class Splicing;

  bool is_open_;
  Surface surface_;
  Elements elements_{surface_};
};

}  // namespace loft
