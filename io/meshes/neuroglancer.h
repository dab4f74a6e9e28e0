// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/part.h"
#include "mesh/mesh.h"

namespace loft::io {

/// A structure as Neuroglancer has it: by a number, 0 excepted, which stands for nothing.
struct Segment {
  std::uint64_t id = 0;
  std::string label;

  friend bool operator==(const Segment&, const Segment&) = default;
};

/// The numbers of some labels, by their names in order. A label takes the number that the source
/// gives it (StackLabel::id: the value in a label volume, the number of a ROI), else that in its
/// name, if there is one only (`dendrite 12`): those that the source gives first, of two with the
/// same one that whose name comes first. All others take the least numbers that are free, from 1
/// on. Depends on the set of labels only: whoever sees the same stack gets the same numbers.
[[nodiscard]] std::vector<Segment> segments_of(std::vector<std::string> labels,
                                               std::span<const StackLabel> known);

/// What a unit of the input is in Neuroglancer's files: nanometres.
[[nodiscard]] inline double nanometres(double metres_per_unit) { return metres_per_unit * 1e9; }

/// A fragment of the legacy format: the number of vertices, then their places as `float`, then the
/// corners of the triangles, all of 4 bytes, least significant byte first. Throws Error where a
/// place is beyond all `float`.
void write_fragment(std::ostream& out, const Part& part, double metres_per_unit);

/// Throws InputError that names `name` where the bytes are no fragment.
[[nodiscard]] Mesh read_fragment(const std::string& content, std::string_view name);

/// Where a folder of meshes keeps what, and the text of its JSON files.
namespace neuroglancer {

inline constexpr std::string_view properties_folder = "segment_properties";
[[nodiscard]] std::string manifest_name(std::uint64_t segment);
[[nodiscard]] std::string fragment_name(std::uint64_t segment);
[[nodiscard]] std::string info();
[[nodiscard]] std::string manifest(std::uint64_t segment);
/// The names of the segments, for the list in the viewer.
[[nodiscard]] std::string properties(std::span<const Segment> segments);

}  // namespace neuroglancer

}  // namespace loft::io
