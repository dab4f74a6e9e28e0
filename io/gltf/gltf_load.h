// SPDX-License-Identifier: MIT
// For sources of io/gltf only, as it shows tinygltf.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string_view>

namespace loft::io {

/// What a file of glTF says about shapes: scenes, nodes, meshes, accessors, buffers, and of
/// materials their colours. All else is left out before tinygltf sees it: images are never opened,
/// extensions and their like not built. Bounded before anything is made of it: JSON nested by 100
/// brackets, buffers of 4 GiB in all. A buffer's `uri` may name a regular file in the folder of the
/// file, or be `data:`. Views that are packed (EXT_meshopt_compression) come unpacked. Throws
/// InputError that names the file as `name`.
[[nodiscard]] tinygltf::Model load_gltf(std::string_view content,
                                        const std::filesystem::path& folder, std::string_view name);

}  // namespace loft::io
