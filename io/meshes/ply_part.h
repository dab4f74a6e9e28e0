// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reconstruct/out_of_core.h"

namespace loft::io {

/// What a part of a surface says of itself in its PLY file, in comments: `comment part ...`.
struct PlyPartNote {
  SlabRange range;
  std::size_t slab_count = 0;  ///< of the stack
  /// What two parts must have in common to fit, by what messages call it: `stack`, `cap`, ...;
  /// words without a space, values without a line's end.
  std::map<std::string, std::string> origin;
  std::vector<PartSizes> surfaces;  ///< of each label

  friend bool operator==(const PlyPartNote&, const PlyPartNote&) = default;
};

/// The header of a part's file. It says all of its layout.
struct PlyPartHeader {
  PlyPartNote note;
  std::vector<std::string> labels;  ///< a single empty one if there are none

  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool is_labelled() const;
};

/// All vertices of a surface, those that other parts have too among them.
[[nodiscard]] constexpr std::uint64_t vertex_count(const PartSizes& s) {
  return std::uint64_t{s.plain} + s.upper + s.lower_doubled + s.doubled + s.midpoints +
         s.upper_midpoints;
}
[[nodiscard]] constexpr std::uint64_t face_count(const PartSizes& s) {
  return s.faces + s.lower_cuts + s.cuts + s.upper_cuts;
}
/// Faces whose place in a seam is told.
[[nodiscard]] constexpr std::uint64_t seam_face_count(const PartSizes& s) {
  return std::uint64_t{s.lower_cuts} + s.upper_cuts;
}

/// How long such files are: behind the faces come the places of seam faces, then a checksum.
inline constexpr std::size_t ply_seam_face_size = 4;
inline constexpr std::size_t ply_checksum_size = 8;

/// Reads the header of a part, and looks whether the file is as long as it says, before anything
/// takes memory by it. Throws InputError that names the file where it is no part or damaged;
/// FileError where it cannot be read.
[[nodiscard]] PlyPartHeader read_ply_part_header(const std::filesystem::path& path);

}  // namespace loft::io
