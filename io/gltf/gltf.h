// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/grid.h"
#include "io/meshes/labelled_mesh.h"
#include "io/meshes/part.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// Writes binary glTF 2.0 that passes the Khronos validator with no error and no warning.
///
/// One node and mesh a part, named by its label (`surface` without one); +Y up, so that the slices'
/// z points up: (x, y, z) becomes (x, z, -y); metres. POSITION is `float` relative to the centre of
/// all parts, which goes into the nodes' translation in `double`: coordinates far from zero
/// survive. NORMAL as shade() gives it. Not metallic, a colour a part, in linear light,
/// double-sided where it is open; a skin (skin.h) that is not alone is transparent. `asset.extras`
/// holds `metres_per_unit`, `up`, and the sources and settings of the options; a node's those that
/// node_extras.h lists. Parts that are hidden have `KHR_node_visibility` (used, not required).
/// Contours make a second node, `LABEL contours`, of lines.
///
/// With WriteOptions::compression, positions are rounded to one grid for all parts, of 16 bits an
/// axis, so that what was at one place still is (see quantisation_error()); a node's scale is its
/// step. That may turn faces over or let thin parts cross: io::write() mends it. Required then:
/// `KHR_mesh_quantization`, and for meshopt `EXT_meshopt_compression`, without a fallback. Throws
/// Error where the surfaces are too large for `float` coordinates or 4 GiB, and for meshopt in a
/// build without it.
void write_glb(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// The same as glTF JSON, in one file: the buffer is embedded (base64).
void write_gltf(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// The grid that WriteOptions::compression rounds to. Cost: O(n).
[[nodiscard]] Grid compression_grid(std::span<const Part> parts, const WriteOptions& options);

/// The farthest that WriteOptions::compression moves a vertex, in the unit of the parts. Cost:
/// O(n).
[[nodiscard]] double quantisation_error(std::span<const Part> parts);

/// Reads the triangles of a glTF or GLB file, node transforms applied, turned back to z up:
/// (x, y, z) becomes (x, -z, y). Vertices that were doubled at sharp edges become one again (see
/// sew_seams()). From files that loft wrote come one mesh a node, in the unit of the stack; from
/// others one mesh in metres, since there a node need not be a solid.
/// Quantised positions (KHR_mesh_quantization) and packed ones (EXT_meshopt_compression, where the
/// build has meshoptimizer) are read, too.
/// Throws FileError, and InputError that names the file. Not read: sparse positions, those that
/// Draco packed (an error says so), points and lines (left out). Bounded, as gltf_load.h says: what
/// is nested, which files are opened (those of buffers, in the same folder), what repeated meshes
/// make.
[[nodiscard]] std::vector<LabelledMesh> read_gltf(const std::filesystem::path& path);

/// The same from the file's content; files beside it are in `folder`.
[[nodiscard]] std::vector<LabelledMesh> read_gltf(std::string_view content,
                                                  const std::filesystem::path& folder,
                                                  std::string_view name);

/// The contours that write_glb() put beside the surfaces of such a file, as far as they lie in
/// level slices: from low to high, each contour with its label. Throws as read_gltf().
[[nodiscard]] std::vector<Slice> read_gltf_contours(const std::filesystem::path& path);

}  // namespace loft::io
