// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "io/meshes/neuroglancer.h"
#include "io/meshes/part.h"
#include "io/surfaces.h"

namespace loft::io {

/// The folder that `precomputed://FOLDER` means; none for any other name.
[[nodiscard]] std::optional<std::filesystem::path> precomputed_folder(
    const std::filesystem::path& output);

/// A folder of meshes for Neuroglancer, in its legacy single-resolution format: `info`, the names
/// of the segments in `segment_properties/info`, and for each segment a manifest `ID:0` and a
/// fragment `ID:0:1` (meshes/neuroglancer.h).
///
/// Several processes may write in the same folder at the same time, each its own segments: every
/// file appears whole or not at all, `info` and names are the same bytes whoever writes them, and a
/// manifest is there only after its fragment. Nothing has to be merged.
class Precomputed {
 public:
  /// `segments`: all that the folder is to have, whoever writes them. Touches nothing.
  Precomputed(std::filesystem::path folder, std::vector<Segment> segments);

  /// Makes the folder where there is none, and `info` and the names where they are not so already.
  /// Throws FileError; also where the folder is another thing, or has the meshes of another stack.
  void begin() const;
  /// Whether a label's mesh is there, and so whole.
  [[nodiscard]] bool has(const std::string& label) const;
  /// A label's mesh, coordinates in nanometres as `float`, mended where rounding breaks it (as
  /// write() in surfaces.h). Throws FileError, and Error where a coordinate is too large.
  /// Precondition: the label is one of the segments'. Cost: O(n log n).
  Written write(const Part& part, double metres_per_unit) const;

 private:
  void require_own() const;
  [[nodiscard]] std::uint64_t id_of(const std::string& label) const;

  std::filesystem::path folder_;
  std::vector<Segment> segments_;  // by label
};

/// The meshes in such a folder, by their numbers, in nanometres, under their names in
/// segment_properties, else their numbers. Fragments of a segment are put together as they are.
/// Throws FileError, and InputError that names the file.
[[nodiscard]] std::vector<LabelledMesh> read_precomputed(const std::filesystem::path& folder);

}  // namespace loft::io
