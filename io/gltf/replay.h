// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "mesh/mesh.h"
#include "reconstruct/live/snapshot.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// Writes how a surface came about as a GLB that any viewer plays: a node for each slab that there
/// ever was, and an animation in which it appears and, if another takes its place, goes again
/// (scale 1 and 0, in steps). Without the animation the nodes show the surface as it is at the end.
/// Otherwise as write_glb(). Memory: that of all slabs.
class Replay {
 public:
  explicit Replay(double metres_per_unit);
  ~Replay();
  Replay(Replay&&) noexcept;
  Replay& operator=(Replay&&) noexcept;

  /// Slab i of a snapshot appears, `time` seconds after the begin. `key` names it from then on.
  /// One that is there already is shaded anew if the slabs beside it, which smooth its normals,
  /// have made a difference. `colour`: that its source gives the label. Throws Error where
  /// coordinates are too large for glTF.
  void add(double time, const std::string& key, const Snapshot& snapshot, std::size_t i,
           const std::string& label, std::optional<Colour> colour = {});
  /// It goes. Nothing happens if it never appeared.
  void remove(double time, const std::string& key);

  /// Throws Error where that is too large for glTF, and where there is nothing to show.
  void write(std::ostream& out) const;

 private:
  class Film;
  std::unique_ptr<Film> film_;
};

}  // namespace loft::io
