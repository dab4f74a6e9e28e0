// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "io/meshes/part.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// Writes one binary little-endian PLY: coordinates as `double`, exactly those of the surface.
///
/// Vertex properties tell where a vertex comes from, as Origin does: `uchar kind` (0 contour,
/// 1 cleaning, 2 crossing, 3 steiner), `int slice`, `int contour`, `int point`, -1 for none. Face
/// properties: `uchar kind` (0 sheet, 1 wall, 2 bottom cap, 3 top cap), `int slab`. Where parts
/// have labels, both have `int label`, named by header lines `comment label 0 heart`, and vertices
/// `uchar red, green, blue`, as other programs show them.
void write_ply(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// Reads ASCII and binary PLY of either byte order, any number types and any further elements and
/// properties. Polygons become triangle fans. The labels that write_ply() wrote split the mesh.
/// Throws InputError that names `name` and the place.
[[nodiscard]] std::vector<LabelledMesh> read_ply(const std::string& content, std::string_view name);

/// The contours that the vertices of such a file are points of: slices from low to high, with the
/// contours in the order of their numbers, each with its label. Points that cleaning left out of
/// the surface are not there. Empty where the file does not say where its vertices come from.
/// Throws as read_ply(). Cost: O(n log n).
[[nodiscard]] std::vector<Slice> read_ply_contours(const std::string& content,
                                                   std::string_view name);

}  // namespace loft::io
