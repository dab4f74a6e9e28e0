// SPDX-License-Identifier: MIT
// In the place of meshopt.cpp where there is no meshoptimizer.
#include "io/gltf/meshopt.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

[[noreturn]] void miss_meshopt() { throw Error("meshopt: " + std::string(no_meshopt)); }

}  // namespace

bool has_meshopt() { return false; }
void reorder(ShadedMesh&) { miss_meshopt(); }
std::vector<OctahedralNormal> octahedral(std::span<const Vec3>) { miss_meshopt(); }
std::string pack(const Packing&, std::string_view) { miss_meshopt(); }
std::vector<unsigned char> unpack(const Packing&, std::string_view) { miss_meshopt(); }

}  // namespace loft::io
