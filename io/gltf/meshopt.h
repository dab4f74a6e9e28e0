// SPDX-License-Identifier: MIT
// The codec of EXT_meshopt_compression, by meshoptimizer. In a build without it, all but
// is_fit() throws Error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf/shading.h"
#include "mesh/mesh.h"

namespace loft::io {

[[nodiscard]] bool has_meshopt();
/// What to do where there is none.
inline constexpr std::string_view no_meshopt =
    "this build has no codec for it; install libmeshoptimizer-dev (meshoptimizer) and build loft "
    "again";

/// Brings faces and vertices into an order that packs well and is drawn quickly.
void reorder(ShadedMesh& mesh);

/// Four bytes a unit vector, as the filter OCTAHEDRAL wants them.
using OctahedralNormal = std::array<std::int8_t, 4>;
[[nodiscard]] std::vector<OctahedralNormal> octahedral(std::span<const Vec3> normals);

enum class PackedMode { attributes, triangles, indices };
enum class PackedFilter { none, octahedral, quaternion, exponential };

/// How elements of a view are packed: `count` of them, each of `stride` bytes.
struct Packing {
  PackedMode mode = PackedMode::attributes;
  PackedFilter filter = PackedFilter::none;
  std::size_t count = 0;
  std::size_t stride = 0;
};

/// Precondition: is_fit(), and as many bytes as it says.
[[nodiscard]] std::string pack(const Packing& packing, std::string_view bytes);

/// Whether the extension knows such a packing, and so few bytes can be so many elements.
[[nodiscard]] bool is_fit(const Packing& packing, std::size_t packed_size);

/// Elements, their filter applied; nothing where `packed` is none. Safe for bytes of any origin.
/// Precondition: is_fit().
[[nodiscard]] std::vector<unsigned char> unpack(const Packing& packing, std::string_view packed);

}  // namespace loft::io
