// SPDX-License-Identifier: MIT
// For sources of io/gltf only, as it shows tinygltf.
#pragma once

#include <tiny_gltf.h>

#include <ostream>
#include <set>
#include <string_view>

namespace loft::io {

/// Writes a model packed (EXT_meshopt_compression): each view of its only buffer by itself; those
/// in `octahedral` hold normals as octahedral() gives them. There is no fallback: both extensions
/// are required.
/// Throws Error where that fails, and in a build without the codec.
void write_packed(std::ostream& out, tinygltf::Model model, const std::set<int>& octahedral,
                  bool binary);

/// Unpacks the views of a model that are packed, into buffers of their own. What they take is
/// bounded by what the file has. Throws InputError that names the file as `name`.
void unpack_views(tinygltf::Model& model, std::string_view name);

}  // namespace loft::io
